//! Files of results: what is written is read again exactly, what is malformed gets a sentence.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::file::motion::{MotionFile, RegionMotion, Seconds};
use relievo::file::{flo, pfm, png};
use relievo::{Error, Flow, Grid};

fn flow() -> Flow {
    Flow {
        u: Grid::from_fn(5, 3, |x, y| x as f32 * 0.37 - y as f32),
        v: Grid::from_fn(5, 3, |x, y| 1.0 / (1.0 + x as f32 + y as f32)),
    }
}

fn refused<T: std::fmt::Debug>(result: Result<T, Error>, reason: &str) {
    match result {
        Err(Error::File { reason: found, .. }) => {
            assert!(
                found.contains(reason),
                "{found:?} says nothing of {reason:?}"
            );
        }
        other => panic!("expected a file error about {reason:?}, not {other:?}"),
    }
}

#[test]
fn flow_returns_exactly_and_unknown_stays_unknown() {
    assert_eq!(flo::read(&flo::write(&flow()), "a.flo").unwrap(), flow());
    let mut holed = flow();
    holed.u[(2, 1)] = f32::NAN;
    holed.v[(0, 0)] = f32::INFINITY;
    let back = flo::read(&flo::write(&holed), "a.flo").unwrap();
    for at in [(2, 1), (0, 0)] {
        assert!(back.u[at].is_nan() && back.v[at].is_nan());
    }
    assert_eq!(back.u[(1, 0)], 0.37);
}

#[test]
fn flo_bytes_are_those_of_the_format() {
    let one = Flow {
        u: Grid::new(1, 1, 1.0),
        v: Grid::new(1, 1, -2.0),
    };
    let bytes = [
        b'P', b'I', b'E', b'H', 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0,
    ];
    assert_eq!(flo::write(&one), bytes);
    // Others mark unknown flow with 1.7e9 or so.
    let mut marked = bytes;
    marked[12..16].copy_from_slice(&1.7e9_f32.to_le_bytes());
    assert!(flo::read(&marked, "a.flo").unwrap().v[(0, 0)].is_nan());
}

#[test]
fn malformed_flow_is_refused() {
    let good = flo::write(&flow());
    refused(flo::read(b"", "a.flo"), "PIEH");
    refused(flo::read(b"PIEX00000000", "a.flo"), "PIEH");
    refused(flo::read(&good[..9], "a.flo"), "ends before its size");
    refused(
        flo::read(&good[..good.len() - 1], "a.flo"),
        "need 132 bytes",
    );
    refused(
        flo::read(&[&good[..], &[0]].concat(), "a.flo"),
        "need 132 bytes",
    );
    for side in [i32::MAX, 4097, 0, -1] {
        let mut huge = good.clone();
        huge[4..8].copy_from_slice(&side.to_le_bytes());
        refused(flo::read(&huge, "a.flo"), "sides must lie");
    }
}

#[test]
fn depth_returns_exactly() {
    let mut depth = Grid::from_fn(4, 3, |x, y| 0.1 + x as f32 * 7.7 + y as f32 / 3.0);
    depth[(1, 2)] = f32::INFINITY;
    assert_eq!(pfm::read(&pfm::write(&depth), "a.pfm").unwrap(), depth);
}

#[test]
fn pfm_is_read_in_either_byte_order_from_the_bottom_row_up() {
    let expected = Grid::from_vec(1, 2, vec![1.0, 2.0]).unwrap();
    let big = [
        b"Pf\n1 2\n1.0\n".as_slice(),
        &[0x40, 0, 0, 0, 0x3f, 0x80, 0, 0],
    ]
    .concat();
    let little = [
        b"Pf 1 2 -2.5\n".as_slice(),
        &[0, 0, 0, 0x40, 0, 0, 0x80, 0x3f],
    ]
    .concat();
    assert_eq!(pfm::read(&big, "a.pfm").unwrap(), expected);
    assert_eq!(pfm::read(&little, "a.pfm").unwrap(), expected);
}

#[test]
fn malformed_pfm_is_refused() {
    let good = pfm::write(&Grid::new(4, 4, 1.0));
    refused(pfm::read(b"", "a.pfm"), "Pf");
    refused(pfm::read(b"PF\n1 1\n-1\n000000000000", "a.pfm"), "colour");
    refused(pfm::read(&good[..good.len() - 1], "a.pfm"), "need 64 bytes");
    refused(pfm::read(b"Pf\n4", "a.pfm"), "width or height");
    refused(pfm::read(b"Pf\nx 4\n-1\n", "a.pfm"), "width or height");
    refused(pfm::read(b"Pf\n4 4\n0\n", "a.pfm"), "scale");
    refused(pfm::read(b"Pf\n4 4\nNaN\n", "a.pfm"), "scale");
    refused(
        pfm::read(b"Pf\n99999999 99999999\n-1\n", "a.pfm"),
        "sides must lie",
    );
    refused(pfm::read(&[b' '; 100_000], "a.pfm"), "Pf");
}

#[test]
fn labels_return_exactly_and_other_pictures_are_refused() {
    let labels = Grid::from_fn(7, 5, |x, y| ((x + 2 * y) % 8) as u8);
    let bytes = png::write_labels(&labels).unwrap();
    assert_eq!(png::read_labels(&bytes, "l.png").unwrap(), labels);
    let coloured = png::write_rgb(&Grid::new(7, 5, [1, 2, 3])).unwrap();
    refused(png::read_labels(&coloured, "l.png"), "8-bit RGB");
    assert!(png::read_labels(&bytes[..bytes.len() / 2], "l.png").is_err());
    assert!(png::read_labels(b"", "l.png").is_err());
    assert!(png::write_labels(&Grid::new(0, 0, 0)).is_err());
}

#[test]
fn pictures_keep_their_colours() {
    let picture = Grid::from_fn(6, 4, |x, y| [x as u8 * 40, y as u8 * 60, 7, 255]);
    let bytes = png::write_rgba(&picture).unwrap();
    let back = image::load_from_memory(&bytes).unwrap().into_rgba8();
    assert_eq!(back.as_raw(), picture.data().as_flattened());
}

#[test]
fn motion_returns_exactly() {
    let motion = MotionFile {
        regions: vec![RegionMotion {
            label: 1,
            translation: [0.1, -0.2, 1e-9],
            rotation: [0.0, 1.0 / 3.0, 0.0],
        }],
        status: "converged".to_owned(),
        iterations: 2,
        energy: vec![3.5, 1.25],
        seconds: Seconds {
            total: 0.3,
            motion: 0.1,
            depth: 0.1,
            curves: 0.1,
        },
    };
    let text = motion.write();
    assert_eq!(MotionFile::read(&text).unwrap(), motion);
    for key in [
        "\"regions\"",
        "\"translation\"",
        "\"seconds\"",
        "\"energy\"",
    ] {
        assert!(text.contains(key), "{key} is missing");
    }
    assert!(matches!(MotionFile::read("{"), Err(Error::Json { .. })));
}

#[test]
fn the_motion_of_a_run_that_diverged_can_be_read() {
    let diverged = MotionFile {
        energy: vec![3.5, f64::INFINITY],
        ..MotionFile::default()
    };
    let back = MotionFile::read(&diverged.write()).unwrap();
    assert!(back.energy[0] == 3.5 && back.energy[1].is_nan());
}
