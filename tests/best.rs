//! Passes of the preset `best` at all its scales, and what may change between them.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

mod solving;

use relievo::options::Preset;
use relievo::scene::{self, Sequence};
use relievo::{Error, Frame, FramePair, Grid, Options, Shape, Solver, Status};
use solving::{best, circle, differing, everything, run, start, whole};

/// Small frames that are solved at more than one scale.
fn squares() -> Sequence {
    scene::render("squares", 272, 204).unwrap()
}

#[test]
fn the_energy_settles() {
    let sequence = scene::render("head", 96, 72).unwrap();
    for occlusion in [false, true] {
        let options = Options {
            occlusion,
            ..best()
        };
        let mut solver = start(&sequence, &sequence.curves, options);
        run(&mut solver);
        // Who hides whom is asked anew in every pass: a few pixels may change hands for ever.
        assert!(occlusion || solver.status() == Status::Converged);
        // Only while threshold dynamics moves curves by leaps may it rise.
        let history = &solver.history()[6..];
        let least = history.iter().copied().fold(f64::INFINITY, f64::min);
        let last = &history[history.len() - 6..];
        let most = last.iter().copied().fold(0.0, f64::max);
        assert!(most <= 1.02 * least, "{last:?} at the end, {least} before");
    }
}

#[test]
fn every_pass_at_every_scale_can_be_looked_at() {
    let sequence = squares();
    let mut solver = start(&sequence, &sequence.curves, best());
    let mut levels = Vec::new();
    for _ in 0..12 {
        let found = solver.interpretation();
        whole(&found, &sequence, 3);
        let report = serde_json::to_value(solver.report()).unwrap();
        let (level, of) = (report["level"].as_u64(), report["levels"].as_u64());
        assert_eq!(of, Some(2));
        levels.push(level.unwrap());
        // Pixels are counted in those of the frame at every scale.
        let regions = report["regions"].as_array().unwrap();
        let pixels: u64 = regions.iter().map(|r| r["pixels"].as_u64().unwrap()).sum();
        assert_eq!(pixels, 272 * 204);
        let share: f64 = regions.iter().map(|r| r["share"].as_f64().unwrap()).sum();
        assert!((share - 1.0).abs() < 1e-9);
        for contour in solver.contours() {
            let [right, bottom] = [271.5, 203.5];
            let on =
                |p: &[f32; 2]| (-0.5..=right).contains(&p[0]) && (-0.5..=bottom).contains(&p[1]);
            assert!(contour.points.iter().all(on));
        }
        assert_eq!(solver.step(), Status::Running);
        assert!(solver.energy().total().is_finite());
    }
    // From the coarse scale to the fine one, and not back.
    assert_eq!((levels[0], levels[11]), (1, 0));
    assert!(levels.windows(2).all(|pair| pair[1] <= pair[0]));
}

#[test]
fn reset_gives_the_first_run_again() {
    let sequence = squares();
    let mut solver = start(&sequence, &sequence.curves, best());
    let fresh = everything(&solver);
    for _ in 0..11 {
        solver.step();
    }
    let first = everything(&solver);
    assert_ne!(first, fresh);
    solver.reset();
    assert_eq!(everything(&solver), fresh);
    for _ in 0..11 {
        solver.step();
    }
    assert_eq!(everything(&solver), first);
    let mut other = start(&sequence, &sequence.curves, best());
    for _ in 0..11 {
        other.step();
    }
    assert_eq!(everything(&other), first);
}

#[test]
fn three_single_steps_are_a_pass_at_whatever_scale() {
    let sequence = squares();
    let mut whole = start(&sequence, &sequence.curves, best());
    let mut parts = start(&sequence, &sequence.curves, best());
    assert!(parts.report().flat);
    while whole.report().level > 0 {
        whole.step();
        parts.step_motion();
        parts.step_depth();
        parts.step_curves();
    }
    assert_eq!(everything(&whole), everything(&parts));
    assert!(!parts.report().flat);
}

#[test]
fn the_report_says_after_which_pass_a_finer_scale_began() {
    let sequence = squares();
    let mut solver = start(&sequence, &sequence.curves, best());
    assert_eq!(solver.report().levels, 2);
    while solver.report().level > 0 {
        assert!(solver.report().refined.is_empty());
        solver.step();
    }
    assert_eq!(solver.report().refined, [solver.iterations()]);
    solver.reset();
    assert!(solver.report().refined.is_empty());
}

#[test]
fn the_report_says_after_which_pass_energy_became_another_sum() {
    let sequence = squares();
    let mut solver = start(&sequence, &sequence.curves, best());
    while solver.report().settled.is_empty() {
        solver.step();
    }
    assert_eq!(solver.report().settled, [solver.iterations()]);
    assert!(
        solver
            .report()
            .refined
            .iter()
            .all(|&p| p < solver.iterations())
    );
    let before = solver.report().weights.mu;
    solver.step();
    let report = solver.report();
    assert!(report.weights.mu < 0.5 * before);
    assert_eq!(report.settled.len(), 1);
    solver.reset();
    assert!(solver.report().settled.is_empty());
}

#[test]
fn looking_on_changes_nothing() {
    let sequence = squares();
    let mut watched = start(&sequence, &sequence.curves, best());
    let mut alone = start(&sequence, &sequence.curves, best());
    for _ in 0..7 {
        watched.step();
        everything(&watched);
        alone.step_motion();
        alone.step_depth();
        alone.step_curves();
        alone.reset();
    }
    for _ in 0..7 {
        alone.step();
    }
    assert_eq!(everything(&watched), everything(&alone));
}

#[test]
fn curves_may_be_put_elsewhere_at_any_scale() {
    let sequence = squares();
    for passes in [0, 8, 11] {
        let mut solver = start(&sequence, &sequence.curves, best());
        for _ in 0..passes {
            solver.step();
        }
        for curves in [
            vec![circle(80.0, 80.0, 24.0), circle(190.0, 110.0, 28.0)],
            vec![circle(120.0, 96.0, 36.0)],
            vec![],
            vec![
                circle(50.0, 50.0, 24.0),
                circle(136.0, 100.0, 24.0),
                circle(220.0, 150.0, 24.0),
            ],
        ] {
            solver.set_curves(&curves).unwrap();
            let found = solver.interpretation();
            whole(&found, &sequence, curves.len() + 1);
            // Where they were put, to a pixel or so of the scale at work.
            let drawn = Grid::from_fn(272, 204, |x, y| {
                let inside = |c: &Shape| c.signed_distance(x as f64, y as f64) > 0.0;
                curves.iter().position(inside).map_or(0, |k| k as u8 + 1)
            });
            assert!(differing(&found.labels, &drawn) < 0.01, "after {passes}");
            assert_eq!(solver.step(), Status::Running);
            assert!(solver.energy().total().is_finite());
            whole(&solver.interpretation(), &sequence, curves.len() + 1);
        }
    }
}

#[test]
fn new_curves_are_allowed_all_their_passes() {
    let sequence = scene::render("squares", 64, 48).unwrap();
    for &preset in Preset::ALL {
        let two = Options {
            max_passes: 2,
            ..Options::preset(preset)
        };
        let mut solver = start(&sequence, &sequence.curves, two);
        for _ in 0..2 {
            run(&mut solver);
            assert_eq!(solver.status(), Status::Exhausted);
            solver.set_curves(&sequence.curves).unwrap();
            assert_eq!(solver.status(), Status::Running);
        }
        run(&mut solver);
        assert_eq!(solver.iterations(), 6);
    }
}

#[test]
fn presets_may_change_while_it_runs() {
    let sequence = squares();
    let paper = || Options::preset(Preset::Paper);
    for passes in [6, 11] {
        let mut solver = start(&sequence, &sequence.curves, best());
        for _ in 0..passes {
            solver.step();
        }
        solver.set_options(paper()).unwrap();
        // From the curves drawn last, as a solver of that kind would.
        let fresh = start(&sequence, &sequence.curves, paper());
        assert_eq!(everything(&solver), everything(&fresh));
        assert_eq!(solver.step(), Status::Running);
        whole(&solver.interpretation(), &sequence, 3);
        solver.set_options(best()).unwrap();
        let fresh = start(&sequence, &sequence.curves, best());
        assert_eq!(everything(&solver), everything(&fresh));
        for _ in 0..2 {
            assert_eq!(solver.step(), Status::Running);
        }
        whole(&solver.interpretation(), &sequence, 3);
        for k in [1, 2] {
            assert!(solver.contours().iter().any(|c| c.label == k));
        }
    }
}

#[test]
fn every_setting_may_change_at_a_coarse_scale() {
    let sequence = squares();
    let mut solver = start(&sequence, &sequence.curves, best());
    for _ in 0..6 {
        solver.step();
    }
    let changes: [fn(&mut Options); 8] = [
        |o| o.smoothing = 1.5,
        |o| o.motion = relievo::options::MotionMethod::LeastSquares,
        |o| o.search = false,
        |o| o.choose_kind = false,
        |o| o.robust = false,
        |o| o.normalised = false,
        |o| o.diffusion = relievo::options::Diffusion::Isotropic,
        |o| (o.mu, o.lambda) = (Some(0.0), Some(0.0)),
    ];
    for change in changes {
        let mut options = best();
        change(&mut options);
        let before = solver.iterations();
        solver.set_options(options).unwrap();
        assert_eq!(solver.step(), Status::Running);
        assert_eq!(solver.iterations(), before + 1);
        assert!(solver.energy().total().is_finite());
        whole(&solver.interpretation(), &sequence, 3);
    }
}

#[test]
fn it_ends_when_its_passes_are_used_up_at_whatever_scale() {
    let sequence = squares();
    let two = Options {
        max_passes: 2,
        ..best()
    };
    let mut solver = start(&sequence, &sequence.curves, two);
    assert_eq!(solver.step(), Status::Running);
    assert_eq!(solver.step(), Status::Exhausted);
    assert_eq!(solver.report().level, 1);
    let stopped = everything(&solver);
    assert_eq!(solver.step(), Status::Exhausted);
    assert_eq!(everything(&solver), stopped);
    whole(&solver.interpretation(), &sequence, 3);
    solver.set_options(best()).unwrap();
    assert_eq!(solver.step(), Status::Running);
}

#[test]
fn bad_curves_and_bad_settings_change_nothing() {
    let sequence = squares();
    let mut solver = start(&sequence, &sequence.curves, best());
    solver.step();
    let before = everything(&solver);
    let far = circle(900.0, 20.0, 8.0);
    let refused = solver.set_curves(&[far]);
    assert!(matches!(refused, Err(Error::CurveOutside { curve: 1, .. })));
    let negative = Options {
        mu: Some(-1.0),
        ..best()
    };
    assert!(solver.set_options(negative).is_err());
    assert_eq!(everything(&solver), before);
}

#[test]
fn frames_that_hold_no_numbers_end_as_diverged() {
    let sequence = scene::render("squares", 64, 48).unwrap();
    let mut grey = sequence.frames[1].grey.clone();
    grey[(20, 20)] = f32::NAN;
    let [first, _] = sequence.frames.clone();
    let broken = FramePair::new(first, Frame::from_grey(grey).unwrap()).unwrap();
    let camera = sequence.truth.camera;
    let mut solver = Solver::new(broken, camera, &sequence.curves, best()).unwrap();
    run(&mut solver);
    assert_eq!(solver.status(), Status::Diverged);
}
