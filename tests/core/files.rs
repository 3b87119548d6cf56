//! Files of results: what is written is read again exactly, what is malformed gets a sentence.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::file::motion::{MotionFile, RegionMotion, Seconds};
use relievo::file::parts::Parts;
use relievo::file::result::{self, ResultFiles};
use relievo::file::{depth16, flo, kitti, pfm, png};
use relievo::{Error, Flow, Grid, Interpretation, MotionModel, scene};

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
    for side in [i32::MAX, 30_001, 0, -1] {
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

/// The values of a 16-bit PNG.
fn levels(bytes: &[u8]) -> Vec<u16> {
    match image::load_from_memory(bytes).unwrap() {
        image::DynamicImage::ImageLuma16(picture) => picture.into_raw(),
        other => panic!("{:?}", other.color()),
    }
}

#[test]
fn depth_of_16_bits_is_depth_but_for_half_a_level() {
    let mut depth = Grid::from_fn(40, 30, |x, y| 0.7 + (x as f32 * 0.7 + y as f32).sin().abs());
    depth[(0, 0)] = f32::INFINITY;
    depth[(1, 0)] = f32::NAN;
    depth[(2, 0)] = -1.0;
    let scale = depth16::scale(&depth);
    let levels_of = levels(&depth16::write(&depth, scale).unwrap());
    assert_eq!(levels_of[..3], [0, 0, 0]);
    assert_eq!(levels_of.iter().copied().max(), Some(u16::MAX));
    for (z, level) in depth.data().iter().zip(&levels_of).skip(3) {
        let back = f64::from(*level) / scale;
        let off = (back - f64::from(*z)).abs() * scale;
        assert!(off <= 0.5 + 1e-6, "{z} came back as {back}");
    }
    // One pixel that is very far takes nothing from the others, and is as far as can be said.
    depth[(3, 0)] = 1e6;
    let scale = depth16::scale(&depth);
    let clipped = levels(&depth16::write(&depth, scale).unwrap());
    assert_eq!(clipped[3], u16::MAX);
    assert!(scale > 1024.0, "{scale} levels per unit");
    let nothing = Grid::new(2, 2, f32::INFINITY);
    assert_eq!(
        levels(&depth16::write(&nothing, depth16::scale(&nothing)).unwrap()),
        [0; 4]
    );
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
            model: Some(MotionModel::Rotation),
            rigid: Some(false),
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
        depth_scale: Some(1.0 / 3.0),
    };
    let text = motion.write();
    assert_eq!(MotionFile::read(&text).unwrap(), motion);
    for key in [
        "\"regions\"",
        "\"translation\"",
        "\"seconds\"",
        "\"energy\"",
        "\"model\": \"rotation\"",
    ] {
        assert!(text.contains(key), "{key} is missing");
    }
    // Files of others may not say what the model is.
    let without = text.replace("\"model\": \"rotation\"", "\"note\": \"\"");
    assert_eq!(MotionFile::read(&without).unwrap().regions[0].model, None);
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

/// A result with motions of its own, and its files by name.
fn saved() -> (Interpretation, MotionFile, Vec<(&'static str, Vec<u8>)>) {
    let truth = scene::render("squares", 40, 30).unwrap().truth;
    let motion = MotionFile {
        regions: RegionMotion::list(&truth.motions, &truth.models()),
        ..MotionFile::default()
    };
    let files = result::write(&truth, &motion).unwrap();
    (truth, motion, files)
}

#[test]
fn files_come_singly_or_together_and_tell_the_scale_of_depth() {
    let (truth, motion, files) = saved();
    assert_eq!(
        files.iter().map(|(name, _)| *name).collect::<Vec<_>>(),
        result::NAMES
    );
    for (name, bytes) in &files {
        assert_eq!(
            &result::file(name, &truth, &motion).unwrap(),
            bytes,
            "{name}"
        );
    }
    assert!(result::file("depth.png", &truth, &motion).is_err());
    let bytes = |wanted: &str| &files.iter().find(|(name, _)| *name == wanted).unwrap().1;
    let told = MotionFile::read(std::str::from_utf8(bytes("motion.json")).unwrap()).unwrap();
    let scale = told.depth_scale.unwrap();
    for (z, level) in truth.depth.data().iter().zip(levels(bytes("depth16.png"))) {
        assert!((f64::from(level) - scale * f64::from(*z)).abs() < 0.51);
    }
}

/// Reads them again, `name` having been replaced by `bytes`.
fn read_with(
    files: &[(&'static str, Vec<u8>)],
    name: &str,
    bytes: &[u8],
) -> Result<Interpretation, Error> {
    let file = |wanted: &str| {
        let own = files.iter().find(|(name, _)| *name == wanted);
        if wanted == name {
            bytes
        } else {
            own.unwrap().1.as_slice()
        }
    };
    ResultFiles {
        labels: file("labels.png"),
        depth: file("depth.pfm"),
        flow: file("flow.flo"),
        motion: std::str::from_utf8(file("motion.json")).unwrap(),
        occlusion: Some(file("occlusion.png")),
    }
    .read()
}

#[test]
fn a_result_returns_exactly() {
    let (truth, _, files) = saved();
    let back = read_with(&files, "", &[]).unwrap();
    assert_eq!(back.labels, truth.labels);
    assert_eq!(back.depth, truth.depth);
    assert_eq!(back.flow, truth.flow);
    assert_eq!(back.motions, truth.motions);
    let hidden = |it: &Interpretation| it.occluded.map(|h| h > 0);
    assert_eq!(hidden(&back), hidden(&truth));
    assert!(back.confidence.data().iter().all(|c| *c == 1.0));
}

#[test]
fn files_of_different_sizes_are_no_result() {
    let (_, _, files) = saved();
    let lying = Grid::new(30, 40, 1.0);
    let nothing = Flow {
        u: lying.clone(),
        v: lying.clone(),
    };
    for (name, bytes) in [
        ("depth.pfm", pfm::write(&lying)),
        ("flow.flo", flo::write(&nothing)),
        (
            "occlusion.png",
            png::write_labels(&lying.map(|_| 0)).unwrap(),
        ),
    ] {
        let error = read_with(&files, name, &bytes).unwrap_err().to_string();
        for told in [name, "30×40", "40×30"] {
            assert!(error.contains(told), "{error}");
        }
    }
}

#[test]
fn motions_go_to_the_regions_that_they_are_labelled_for() {
    let (truth, motion, files) = saved();
    let with = |regions: Vec<RegionMotion>| {
        let other = MotionFile {
            regions,
            ..motion.clone()
        };
        read_with(&files, "motion.json", other.write().as_bytes())
    };
    let mut regions = motion.regions.clone();
    regions.reverse();
    assert_eq!(with(regions.clone()).unwrap().motions, truth.motions);
    // One missing, one twice, none at all.
    for bad in [
        regions[..2].to_vec(),
        vec![regions[0].clone(), regions[0].clone(), regions[1].clone()],
        vec![],
    ] {
        let error = with(bad).unwrap_err();
        assert!(matches!(error, Error::Regions { last: 2, .. }), "{error}");
    }
}

#[test]
fn kittis_flow_is_read_to_a_64th_of_a_pixel() {
    let value = |x: u32, y: u32| {
        [
            32_768 + 96 * x as u16 - 7,
            32_768 - 640 + y as u16,
            u16::from(y > 1),
        ]
    };
    let picture = image::ImageBuffer::<image::Rgb<u16>, Vec<u16>>::from_fn(9, 7, |x, y| {
        image::Rgb(value(x, y))
    });
    let mut bytes = std::io::Cursor::new(Vec::new());
    let png = image::ImageFormat::Png;
    image::DynamicImage::from(picture)
        .write_to(&mut bytes, png)
        .unwrap();
    let flow = kitti::read(bytes.get_ref(), "flow.png").unwrap();
    for y in 0..7 {
        for x in 0..9 {
            let (u, v) = (flow.u[(x, y)], flow.v[(x, y)]);
            if y > 1 {
                assert_eq!(
                    (u, v),
                    (1.5 * x as f32 - 7.0 / 64.0, -10.0 + y as f32 / 64.0)
                );
            } else {
                assert!(u.is_nan() && v.is_nan());
            }
        }
    }
    let grey = png::write_labels(&Grid::new(4, 4, 1)).unwrap();
    let error = kitti::read(&grey, "flow.png").unwrap_err().to_string();
    assert!(error.contains("16-bit"), "{error}");
}

#[test]
fn whatever_there_is_of_a_result_is_read() {
    let (truth, _, files) = saved();
    let only = |names: &[&str]| {
        let named = files.iter().filter(|(name, _)| names.contains(name));
        let named = named.map(|(name, bytes)| ((*name).to_owned(), bytes.clone()));
        Parts::read(&named.collect::<Vec<_>>())
    };
    let flow = only(&["flow.flo"]).unwrap();
    assert_eq!(
        (flow.flow.as_ref(), flow.labels.as_ref()),
        (Some(&truth.flow), None)
    );
    let labels = only(&["labels.png", "motion.json"]).unwrap();
    assert_eq!(labels.labels, Some(truth.labels.clone()));
    assert_eq!(labels.motions, Some(truth.motions.clone()));
    assert_eq!(only(&[]), Err(Error::NothingToScore));
}
