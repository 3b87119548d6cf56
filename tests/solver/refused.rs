//! What a solver refuses, and what it reports when it cannot go on.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use crate::support::{circle, everything, pair, paper, small, start};
use relievo::{Camera, Error, Frame, FramePair, Options, Solver, Status, scene};

#[test]
fn bad_curves_and_bad_settings_change_nothing() {
    let (sequence, mut solver) = small();
    for _ in 0..3 {
        solver.step();
    }
    let before = everything(&solver);
    let good = circle(30.0, 20.0, 8.0);
    let bad = [
        (vec![good.clone(); 8], Error::TooManyCurves(8)),
        (
            vec![good.clone(), circle(300.0, 20.0, 8.0)],
            Error::CurveOutside {
                curve: 2,
                width: 64,
                height: 48,
            },
        ),
        (
            vec![good.clone(), good.clone(), circle(30.0, 20.0, 0.0)],
            Error::CurveEmpty { curve: 3 },
        ),
        (
            vec![circle(f64::NAN, 20.0, 8.0)],
            Error::CurveNotFinite { curve: 1 },
        ),
    ];
    for (curves, error) in bad {
        assert_eq!(solver.set_curves(&curves), Err(error.clone()));
        let camera = sequence.truth.camera;
        let fresh = Solver::new(pair(&sequence), camera, &curves, paper());
        assert_eq!(fresh.err(), Some(error));
    }
    let negative = Options {
        mu: Some(-1.0),
        ..paper()
    };
    let error = solver.set_options(negative).unwrap_err();
    assert!(error.to_string().contains("mu is -1"), "{error}");
    assert_eq!(everything(&solver), before);
    let sentence = Error::TooManyCurves(8).to_string();
    assert!(
        sentence.contains('8') && sentence.contains('7'),
        "{sentence}"
    );
    // Nor did the refusals spoil what it goes back to.
    solver.reset();
    let (_, mut fresh) = small();
    solver.step();
    fresh.step();
    assert_eq!(everything(&solver), everything(&fresh));
}

#[test]
fn impossible_cameras_are_refused() {
    let (sequence, _) = small();
    for focal in [0.0, -3.0, f64::INFINITY] {
        let camera = Camera {
            focal,
            ..sequence.truth.camera
        };
        let refused = Solver::new(pair(&sequence), camera, &[], paper());
        assert_eq!(refused.err(), Some(Error::Focal(focal)));
    }
    let camera = Camera {
        cx: f64::NAN,
        ..sequence.truth.camera
    };
    let refused = Solver::new(pair(&sequence), camera, &[], paper());
    assert!(matches!(refused.err(), Some(Error::Centre(..))));
}

#[test]
fn a_curve_that_vanishes_is_reported_and_the_rest_goes_on() {
    let sequence = scene::render("flight", 64, 48).unwrap();
    let short = Options {
        lambda: Some(1e6),
        ..paper()
    };
    let mut solver = start(&sequence, &[circle(30.0, 24.0, 4.0)], short);
    solver.step_motion();
    assert!(solver.report().warnings.is_empty());
    for _ in 0..6 {
        solver.step();
    }
    let report = solver.report();
    assert_eq!(report.regions[1].pixels, 0);
    assert!(report.warnings.iter().any(|w| w.contains("Curve 1")));
    assert!(solver.contours().is_empty());
    let energy = solver.energy();
    assert!(energy.total().is_finite() && energy.length == 0.0);
}

#[test]
fn frames_that_hold_no_numbers_end_as_diverged() {
    let (sequence, _) = small();
    let mut grey = (*sequence.frames[1].grey).clone();
    grey[(20, 20)] = f32::NAN;
    let [first, _] = sequence.frames.clone();
    let broken = FramePair::new(first, Frame::from_grey(grey).unwrap()).unwrap();
    let camera = sequence.truth.camera;
    let mut solver = Solver::new(broken, camera, &sequence.curves, paper()).unwrap();
    assert_eq!(solver.step(), Status::Diverged);
    assert_eq!(solver.step(), Status::Diverged);
    assert_eq!(solver.iterations(), 1);
}
