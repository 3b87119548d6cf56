//! Passes and single steps, and what may change between them.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use std::sync::atomic::{AtomicU32, Ordering};

use crate::support::{circle, everything, paper, small, start};
use relievo::{Options, Shape, Status};

#[test]
fn three_single_steps_are_a_pass() {
    let (_, mut whole) = small();
    let (_, mut parts) = small();
    for _ in 0..3 {
        whole.step();
        parts.step_motion();
        parts.step_depth().unwrap();
        parts.step_curves();
    }
    assert_eq!(everything(&whole), everything(&parts));
    assert_eq!(parts.iterations(), 3);
}

#[test]
fn each_step_moves_only_its_own_unknown_and_motion_and_depth_lower_the_energy() {
    let (_, mut solver) = small();
    for _ in 0..6 {
        let before = (solver.energy().total(), solver.interpretation());
        solver.step_motion();
        let moved = (solver.energy().total(), solver.interpretation());
        assert_eq!(moved.1.labels, before.1.labels);
        // The first motion step is what chooses the weights.
        if solver.iterations() > 0 {
            assert!(moved.0 <= 1.001 * before.0, "{} to {}", before.0, moved.0);
        }
        solver.step_depth().unwrap();
        let deeper = (solver.energy().total(), solver.interpretation());
        assert_eq!(deeper.1.labels, moved.1.labels);
        assert_eq!(deeper.1.motions, moved.1.motions);
        assert!(
            deeper.0 <= 1.000_01 * moved.0,
            "{} to {}",
            moved.0,
            deeper.0
        );
        solver.step_curves();
        let curved = solver.interpretation();
        assert_eq!(curved.depth, deeper.1.depth);
        assert_eq!(curved.motions, deeper.1.motions);
    }
}

#[test]
fn single_steps_may_be_taken_in_any_order_from_the_start() {
    for order in [[2, 1, 0], [1, 0, 2], [2, 0, 1]] {
        let (_, mut solver) = small();
        for step in order {
            match step {
                0 => solver.step_motion(),
                1 => solver.step_depth().unwrap(),
                _ => solver.step_curves(),
            }
        }
        assert!(solver.energy().total().is_finite());
        assert_eq!(solver.step(), Status::Running);
    }
}

#[test]
fn reset_gives_the_first_run_again() {
    let (_, mut solver) = small();
    let fresh = everything(&solver);
    for _ in 0..6 {
        solver.step();
    }
    let first = everything(&solver);
    solver.reset();
    assert_eq!(everything(&solver), fresh);
    for _ in 0..6 {
        solver.step();
    }
    assert_eq!(everything(&solver), first);
}

#[test]
fn reset_starts_from_the_curves_and_settings_given_last() {
    let (sequence, mut solver) = small();
    let curves = [circle(20.0, 20.0, 8.0), circle(45.0, 25.0, 7.0)];
    let options = Options {
        depth_steps: 7,
        smoothing: 0.8,
        ..paper()
    };
    solver.step();
    solver.set_options(options.clone()).unwrap();
    solver.step();
    solver.set_curves(&curves).unwrap();
    solver.step();
    solver.reset();
    let mut fresh = start(&sequence, &curves, options);
    for _ in 0..3 {
        solver.step();
        fresh.step();
    }
    assert_eq!(everything(&solver), everything(&fresh));
}

#[test]
fn weights_may_change_while_it_runs() {
    let (_, mut solver) = small();
    for _ in 0..3 {
        solver.step();
    }
    let automatic = solver.report().weights;
    assert!(automatic.mu > 0.0 && automatic.lambda > 0.0);
    let (energy, found) = (solver.energy(), solver.interpretation());
    let heavier = Options {
        mu: Some(3.0 * automatic.mu),
        lambda: Some(0.5 * automatic.lambda),
        ..paper()
    };
    solver.set_options(heavier).unwrap();
    // Nothing has moved, only the weighing.
    assert_eq!(solver.interpretation(), found);
    let weighed = solver.energy();
    assert_eq!(weighed.data, energy.data);
    assert!((weighed.smoothness / energy.smoothness - 3.0).abs() < 1e-6);
    assert!((weighed.length / energy.length - 0.5).abs() < 1e-6);
    assert!((weighed.total() - weighed.data - weighed.smoothness - weighed.length).abs() < 1e-6);
    assert_eq!(solver.iterations(), 3);
    solver.step();
    assert_eq!(solver.iterations(), 4);
    // Back to automatic is back to the same weights.
    solver.set_options(paper()).unwrap();
    assert_eq!(solver.report().weights, automatic);
}

#[test]
fn a_stopped_solver_stands_still_until_it_is_allowed_more() {
    let (sequence, _) = small();
    let two = Options {
        max_passes: 2,
        ..paper()
    };
    let mut solver = start(&sequence, &sequence.curves, two);
    assert_eq!(solver.status(), Status::Running);
    assert_eq!(solver.step(), Status::Running);
    assert_eq!(solver.step(), Status::Exhausted);
    let stopped = everything(&solver);
    assert_eq!(solver.step(), Status::Exhausted);
    assert_eq!(everything(&solver), stopped);
    assert_eq!(solver.iterations(), 2);
    solver.set_options(paper()).unwrap();
    assert_eq!(solver.status(), Status::Running);
    solver.step();
    assert_eq!(solver.iterations(), 3);
    // And as if it had never stopped.
    let mut through = start(&sequence, &sequence.curves, paper());
    for _ in 0..3 {
        through.step();
    }
    assert_eq!(everything(&solver), everything(&through));
}

#[test]
fn curves_may_be_put_elsewhere_while_it_runs() {
    let (_, mut solver) = small();
    for _ in 0..3 {
        solver.step();
    }
    let before = solver.interpretation();
    for curves in [
        vec![circle(20.0, 20.0, 6.0), circle(45.0, 25.0, 7.0)],
        vec![circle(30.0, 24.0, 9.0)],
        vec![],
        vec![
            circle(12.0, 12.0, 6.0),
            circle(32.0, 24.0, 6.0),
            circle(52.0, 36.0, 6.0),
        ],
    ] {
        solver.set_curves(&curves).unwrap();
        let found = solver.interpretation();
        assert_eq!(found.regions(), curves.len() + 1);
        for y in 0..48 {
            for x in 0..64 {
                let inside = |c: &Shape| c.signed_distance(x as f64, y as f64) > 0.0;
                let label = curves.iter().position(inside).map_or(0, |k| k + 1);
                assert_eq!(usize::from(found.labels[(x, y)]), label);
            }
        }
        if curves.len() == 2 {
            assert_eq!(found.depth, before.depth);
        }
        assert_eq!(solver.step(), Status::Running);
        assert!(solver.energy().total().is_finite());
    }
}

static TICKS: AtomicU32 = AtomicU32::new(0);

#[test]
fn the_report_has_every_number_and_time_comes_from_the_clock() {
    let (_, mut solver) = small();
    // Each reading is a second later than the one before.
    solver.set_clock(|| f64::from(TICKS.fetch_add(1, Ordering::Relaxed)));
    for _ in 0..3 {
        solver.step();
    }
    let report = serde_json::to_value(solver.report()).unwrap();
    let number = |path: &str| {
        let value = report.pointer(path).unwrap_or_else(|| panic!("no {path}"));
        value
            .as_f64()
            .unwrap_or_else(|| panic!("{path} is {value}"))
    };
    assert_eq!(number("/iterations"), 3.0);
    assert_eq!(report["status"], "running");
    assert!(number("/level") < number("/levels"));
    let terms = ["data", "smoothness", "length"].map(|term| number(&format!("/energy/{term}")));
    assert!(terms.iter().all(|t| *t > 0.0), "{terms:?}");
    let total = number("/energy/total");
    assert!((terms.iter().sum::<f64>() - total).abs() < 1e-9 * total);
    assert_eq!(report["history"].as_array().unwrap().len(), 3);
    assert_eq!(number("/history/2"), total);
    for k in 0..3 {
        assert_eq!(number(&format!("/regions/{k}/label")), f64::from(k));
        for axis in 0..3 {
            number(&format!("/regions/{k}/translation/{axis}"));
            number(&format!("/regions/{k}/rotation/{axis}"));
        }
        let model = report["regions"][k as usize]["model"].as_str().unwrap();
        assert!(["still", "rotation", "translation", "full"].contains(&model));
    }
    assert!(number("/weights/mu") > 0.0 && number("/weights/lambda") > 0.0);
    assert!(report["warnings"].as_array().unwrap().is_empty());
    let times = ["motion", "depth", "curves"].map(|step| number(&format!("/seconds/{step}")));
    assert!(times.iter().all(|t| *t >= 3.0), "{times:?}");
    assert_eq!(number("/seconds/total"), times.iter().sum::<f64>());
}
