//! Interlaced frames and their fields.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::{Error, Frame, FramePair, Grid, scene};

/// Even rows of the first frame, odd rows of the second.
fn woven(name: &str, width: usize, height: usize) -> Frame {
    let [first, second] = scene::render(name, width, height).unwrap().frames;
    let bytes = Grid::from_fn(width, height, |x, y| {
        let [r, g, b] = [&first, &second][y % 2].rgb[(x, y)];
        [r, g, b, 255]
    });
    Frame::from_rgba8(width, height, bytes.data().as_flattened()).unwrap()
}

#[test]
fn a_woven_frame_is_told_from_whole_ones() {
    for name in scene::names() {
        let [first, second] = scene::render(name, 160, 120).unwrap().frames;
        assert!(!first.interlaced() && !second.interlaced(), "{name}");
        let pair = FramePair::new(first, second).unwrap();
        assert_eq!(pair.notes(), [], "{name}");
    }
    for name in ["blocks", "columns", "squares"] {
        assert!(woven(name, 160, 120).interlaced(), "{name}");
    }
}

#[test]
fn stripes_and_lettering_in_a_whole_frame_are_no_combs() {
    // A wave of less than four rows: shifted by half a wave, a row lies between its neighbours.
    for slant in [0.5f32, 1.0, 1.5] {
        let stripes = |x, y| 120.0 + 60.0 * (slant * x as f32 + 2.2 * y as f32).sin();
        let frame = Frame::from_grey(Grid::from_fn(160, 120, stripes)).unwrap();
        assert!(!frame.interlaced(), "{slant}");
    }
}

#[test]
fn fields_show_the_two_moments_at_the_same_height() {
    // A slope is the same in both fields, if their rows are where they are said to be.
    let slope = Grid::from_fn(64, 64, |x, y| (x + 2 * y) as f32);
    let bytes = slope.map(|v| [v as u8, v as u8, v as u8, 255]);
    let frame = Frame::from_rgba8(64, 64, bytes.data().as_flattened()).unwrap();
    let [even, odd] = frame.fields().unwrap();
    assert_eq!((even.width(), even.height()), (32, 32));
    for y in 1..31 {
        for x in 0..32 {
            // Pixel (x, y) of a field is at (2x + ½, 2y + ½) of the frame.
            let expected = (2 * x) as f32 + 0.5 + 2.0 * (2.0 * y as f32 + 0.5);
            for field in [&even, &odd] {
                assert!((field.grey[(x, y)] - expected).abs() < 1e-3);
            }
        }
    }
    let [even, odd] = woven("columns", 160, 120).fields().unwrap();
    assert!(FramePair::new(even, odd).is_ok());
    let small = Frame::from_grey(Grid::from_fn(20, 40, |x, _| x as f32)).unwrap();
    assert!(matches!(
        small.fields(),
        Err(Error::Size {
            width: 10,
            height: 20,
            ..
        })
    ));
}
