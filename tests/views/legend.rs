//! Numbers beside the pictures: what colours stand for, and what is found at a pixel.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::probe::probe;
use relievo::view::{self, Form, Legend, ViewParams, draw, legend};
use relievo::{Error, FramePair, scene};

fn hex([r, g, b, _]: [u8; 4]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[test]
fn the_marks_of_depth_are_the_depths_of_their_colours() {
    let columns = scene::render("columns", 64, 48).unwrap();
    let params = ViewParams::default();
    let legend = legend("depth", &columns.truth, &params).unwrap().unwrap();
    assert_eq!(legend.form, Form::Ramp);
    let mut nearest = columns.truth.clone();
    for (mark, end) in [(0, 0), (4, legend.colours.len() - 1)] {
        // All of the frame at that depth, in the same range.
        nearest.depth.data_mut().fill(legend.marks[mark].value);
        nearest.confidence.data_mut().fill(1.0);
        let held = ViewParams {
            span: legend.hold.unwrap().span,
            ..params.clone()
        };
        let picture = draw("depth", &columns.frames[0], &nearest, &[], &held).unwrap();
        assert_eq!(hex(picture[(5, 5)]), legend.colours[end]);
    }
    assert!(legend.marks.is_sorted_by(|a, b| a.value > b.value));
}

#[test]
fn motion_is_told_in_pixels_and_a_picture_that_is_no_measure_has_no_legend() {
    let blocks = scene::render("blocks", 64, 48).unwrap();
    let fixed = ViewParams {
        speed: Some(3.0),
        ..ViewParams::default()
    };
    let of = |kind| legend(kind, &blocks.truth, &fixed);
    let wheel = of("flow").unwrap().unwrap();
    assert_eq!((wheel.form, wheel.marks[0].value), (Form::Wheel, 3.0));
    assert_eq!(wheel.unit, "px/frame");
    let keys = of("labels").unwrap().unwrap();
    assert_eq!(keys.colours.len(), blocks.truth.regions());
    for kind in view::KINDS {
        let measured = ["depth", "flow", "arrows", "confidence", "labels"].contains(&kind);
        assert_eq!(of(kind).unwrap().is_some(), measured, "{kind}");
    }
    let wrong = ViewParams {
        palette: "mud".to_owned(),
        ..ViewParams::default()
    };
    let refused = legend("depth", &blocks.truth, &wrong).unwrap_err();
    assert!(matches!(refused, Error::Choice { .. }));
}

#[test]
fn the_truth_leaves_no_brightness_unexplained() {
    let columns = scene::render("columns", 96, 72).unwrap();
    let [first, second] = columns.frames.clone();
    let pair = FramePair::new(first, second).unwrap();
    let truth = &columns.truth;
    let mut left = Vec::new();
    for y in 8..64 {
        for x in 8..88 {
            let found = probe(&pair, truth, &[2.0], (x, y)).unwrap();
            assert_eq!(found.depth, 2.0 * truth.depth[(x, y)]);
            assert_eq!(
                (found.u, found.v),
                (truth.flow.u[(x, y)], truth.flow.v[(x, y)])
            );
            if !found.occluded {
                left.push(found.psi.abs());
            }
        }
    }
    left.sort_unstable_by(f32::total_cmp);
    assert!(left[left.len() / 2] < 3.0, "{}", left[left.len() / 2]);
    // Where no motion is known, none can be subtracted.
    let mut unknown = truth.clone();
    unknown.flow.u[(3, 3)] = f32::NAN;
    assert!(probe(&pair, &unknown, &[], (3, 3)).unwrap().psi.is_nan());
    assert_eq!(probe(&pair, truth, &[], (96, 0)), None);
}

#[test]
fn the_legend_of_a_smaller_picture_is_in_the_pixels_of_the_frames() {
    let made = scene::render("squares", 192, 144).unwrap();
    let params = ViewParams::default();
    for kind in ["flow", "arrows", "depth"] {
        let whole = legend(kind, &made.truth, &params).unwrap().unwrap();
        let small = legend(kind, &made.truth.shrunk(3), &params)
            .unwrap()
            .unwrap();
        let small = small.enlarged(3);
        for (a, b) in whole.marks.iter().zip(&small.marks) {
            assert!(
                (a.value / b.value - 1.0).abs() < 0.02,
                "{kind}: {a:?} {b:?}"
            );
        }
        let speed = |of: &Legend| of.hold.and_then(|hold| hold.speed);
        assert_eq!(speed(&small).is_some(), speed(&whole).is_some());
        if let Some((a, b)) = speed(&whole).zip(speed(&small)) {
            assert!((a / b - 1.0).abs() < 0.02, "{kind}: {a} {b}");
        }
    }
}
