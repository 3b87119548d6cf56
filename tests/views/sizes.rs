//! What was found, drawn smaller: the same picture, and outlines as sharp as its pixels.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::scene;
use relievo::view::{Picture, ViewParams, draw, mesh};
use relievo::{Frame, Grid, Interpretation};

const W: usize = 240;
const H: usize = 180;

fn rendered(name: &str) -> (Frame, Interpretation) {
    let made = scene::render(name, W, H).unwrap();
    (made.frames[0].clone(), made.truth)
}

fn drawn(kind: &str, frame: &Frame, found: &Interpretation) -> Picture {
    let params = ViewParams {
        legend: false,
        ..ViewParams::default()
    };
    draw(kind, frame, found, &[], &params).unwrap()
}

/// The mean of each 2 × 2 pixels.
fn halved(picture: &Picture) -> Picture {
    Grid::from_fn(picture.width() / 2, picture.height() / 2, |x, y| {
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)];
        let four = four.map(|(i, j)| picture[(2 * x + i, 2 * y + j)]);
        std::array::from_fn(|c| (four.iter().map(|p| u32::from(p[c])).sum::<u32>() / 4) as u8)
    })
}

#[test]
fn a_small_picture_is_the_large_one_shrunk() {
    for name in ["squares", "columns"] {
        let (frame, found) = rendered(name);
        let (small, fewer) = (frame.shrunk(2), found.shrunk(2));
        // Grey levels apart in the mean. The eyes' outlines are rounded by a pixel of each, and textures are fine.
        for (kind, most) in [
            ("labels", 2.0),
            ("depth", 2.0),
            ("flow", 2.0),
            ("confidence", 2.0),
            ("anaglyph", 8.0),
            ("stereo", 8.0),
        ] {
            let [ours, theirs] = [
                drawn(kind, &small, &fewer),
                halved(&drawn(kind, &frame, &found)),
            ];
            assert!(ours.same_size(&theirs), "{kind}");
            let pairs = ours.data().as_flattened().iter();
            let pairs = pairs.zip(theirs.data().as_flattened());
            let apart: f64 = pairs.map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
            let apart = apart / (4 * ours.len()) as f64;
            assert!(apart < most, "{name} {kind}: {apart}");
        }
    }
}

#[test]
fn a_silhouette_stays_sharp_and_nothing_is_mixed_across_it() {
    let (_, found) = rendered("squares");
    let small = found.shrunk(3);
    assert_eq!(
        (small.labels.width(), small.labels.height()),
        (W / 3, H / 3)
    );
    for y in 0..H / 3 {
        for x in 0..W / 3 {
            let nine = || (0..9).map(|i| (3 * x + i % 3, 3 * y + i / 3));
            let label = small.labels[(x, y)];
            let count = |k: u8| nine().filter(|&at| found.labels[at] == k).count();
            assert!((0..=2).all(|k| count(k) <= count(label)));
            let own = || nine().filter(|&at| found.labels[at] == label);
            let near = own()
                .map(|at| found.depth[at])
                .fold(f32::INFINITY, f32::min);
            let far = own().map(|at| found.depth[at]).fold(0.0, f32::max);
            let depth = small.depth[(x, y)];
            assert!(
                depth > 0.9999 * near && depth < 1.0001 * far,
                "{near} {depth} {far}"
            );
        }
    }
}

#[test]
fn motion_and_camera_are_in_the_pixels_of_the_small_frame() {
    let (_, found) = rendered("flight");
    let small = found.shrunk(2);
    assert!((small.camera.focal - found.camera.focal / 2.0).abs() < 1e-9);
    for y in 0..H / 2 {
        for x in 0..W / 2 {
            let (at, there) = ((x, y), (2 * x, 2 * y));
            let ray = small.camera.ray(x as f64, y as f64);
            let same = found.camera.ray(2.0 * x as f64 + 0.5, 2.0 * y as f64 + 0.5);
            assert!((ray - same).length() < 1e-9);
            let apart = (2.0 * small.flow.u[at] - found.flow.u[there]).abs();
            assert!(apart < 0.2, "{apart} at {at:?}");
        }
    }
}

#[test]
fn what_is_known_nowhere_stays_unknown() {
    let (_, mut found) = rendered("squares");
    for y in 0..H {
        for x in 0..W / 2 {
            found.flow.u[(x, y)] = f32::NAN;
            found.depth[(x, y)] = f32::NAN;
        }
    }
    let small = found.shrunk(2);
    for y in 0..H / 2 {
        assert!((0..W / 4).all(|x| small.flow.u[(x, y)].is_nan() && small.depth[(x, y)].is_nan()));
        assert!((W / 4..W / 2).all(|x| small.flow.u[(x, y)].is_finite()));
    }
}

#[test]
fn a_relief_of_fewer_pixels_is_the_same_surface() {
    let (frame, found) = rendered("blocks");
    let whole = mesh(&frame, &found, &ViewParams::default());
    let small = mesh(&frame.shrunk(2), &found.shrunk(2), &ViewParams::default());
    let ends = |positions: &[f32], axis: usize| {
        let all = || positions.chunks_exact(3).map(|p| p[axis]);
        [
            all().fold(f32::INFINITY, f32::min),
            all().fold(f32::NEG_INFINITY, f32::max),
        ]
    };
    for axis in 0..3 {
        let [a, b] = [&whole, &small].map(|m| ends(&m.positions, axis));
        assert!(
            (a[0] - b[0]).abs() < 0.1 && (a[1] - b[1]).abs() < 0.1,
            "{a:?} {b:?}"
        );
    }
}
