//! The solver with the settings of the default preset: coarse to fine, a depth field per region.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::options::Preset;
use relievo::scene::{self, Sequence};
use relievo::score::{compare, compare_flow};
use relievo::{
    Error, Frame, FramePair, Grid, Interpretation, Options, Shape, Solver, Status, horn_schunck,
};

fn best() -> Options {
    Options::preset(Preset::Best)
}

fn pair(sequence: &Sequence) -> FramePair {
    let [first, second] = sequence.frames.clone();
    FramePair::new(first, second).unwrap()
}

fn start(sequence: &Sequence, curves: &[Shape], options: Options) -> Solver {
    Solver::new(pair(sequence), sequence.truth.camera, curves, options).unwrap()
}

/// Small frames that are solved at more than one scale.
fn squares() -> Sequence {
    scene::render("squares", 272, 204).unwrap()
}

fn run(solver: &mut Solver) -> Interpretation {
    while solver.step() == Status::Running {}
    solver.interpretation()
}

fn circle(x: f64, y: f64, r: f64) -> Shape {
    Shape::Circle { x, y, r }
}

fn differing(a: &Grid<u8>, b: &Grid<u8>) -> f64 {
    let pairs = a.data().iter().zip(b.data());
    pairs.filter(|(a, b)| a != b).count() as f64 / a.len() as f64
}

/// All that can be seen of a solver from outside, as one text.
fn everything(solver: &Solver) -> String {
    let parts = (
        solver.report(),
        solver.interpretation(),
        solver.contours(),
        solver.options(),
    );
    format!("{parts:?}")
}

/// That an interpretation is whole: sizes, finite numbers, depth in front of the camera.
fn whole(found: &Interpretation, sequence: &Sequence, regions: usize) {
    let labels = &sequence.truth.labels;
    assert_eq!(found.regions(), regions);
    assert!(found.labels.same_size(labels) && found.depth.same_size(labels));
    assert!(found.flow.u.same_size(labels) && found.flow.v.same_size(labels));
    assert!(found.confidence.same_size(labels) && found.occluded.same_size(labels));
    assert!(
        found
            .labels
            .data()
            .iter()
            .all(|&l| usize::from(l) < regions)
    );
    assert!(found.depth.data().iter().all(|z| z.is_finite() && *z > 0.0));
    assert!(found.flow.u.data().iter().all(|u| u.is_finite()));
    assert!(found.flow.v.data().iter().all(|v| v.is_finite()));
    let shares = found.confidence.data().iter();
    assert!(shares.clone().all(|c| (0.0..=1.0).contains(c)));
    let motions = found.motions.iter();
    assert!(
        motions
            .clone()
            .all(|m| m.translation.is_finite() && m.rotation.is_finite())
    );
}

/// Labels wrong and AEE.
fn scores(found: &Interpretation, sequence: &Sequence) -> (f64, f64) {
    let scores = compare(found, &sequence.truth).unwrap();
    (scores.labels_wrong, scores.aee.unwrap())
}

/// Solves a sequence; AEE is to be below `ratio` times that of the preset `paper` and of Horn–Schunck.
fn promise(sequence: &Sequence, wrong: f64, ratio: f64) {
    let name = &sequence.name;
    let mut solver = start(sequence, &sequence.curves, best());
    let found = run(&mut solver);
    whole(&found, sequence, sequence.truth.regions());
    assert_ne!(solver.status(), Status::Diverged, "{name}");
    assert!(solver.history().iter().all(|e| e.is_finite() && *e > 0.0));
    let (labels, aee) = scores(&found, sequence);
    assert!(labels < wrong, "{name}: {labels} of all labels are wrong");
    let paper = Options::preset(Preset::Paper);
    let (paper_labels, paper) = scores(
        &run(&mut start(sequence, &sequence.curves, paper)),
        sequence,
    );
    assert!(
        labels < 0.8 * paper_labels,
        "{name}: {labels}, {paper_labels}"
    );
    assert!(
        aee < ratio * paper,
        "{name}: AEE {aee}, the paper's {paper}"
    );
    let (alpha, sweeps) = (horn_schunck::ALPHA, horn_schunck::SWEEPS);
    let flow = horn_schunck::solve(&pair(sequence), alpha, sweeps);
    let (baseline, _) = compare_flow(&flow, &sequence.truth.flow, None)
        .unwrap()
        .unwrap();
    assert!(
        aee < ratio * baseline,
        "{name}: AEE {aee}, Horn–Schunck {baseline}"
    );
}

#[test]
fn independent_blocks_are_found() {
    promise(&scene::render("blocks", 160, 120).unwrap(), 0.04, 0.6);
}

#[test]
fn a_head_before_its_wall_is_found() {
    promise(&scene::render("head", 160, 120).unwrap(), 0.03, 0.6);
}

#[test]
fn blocks_that_move_by_several_pixels_are_found() {
    let sequence = scene::variant("blocks", 3, 0.0, 13.0, 100, 75).unwrap();
    promise(&sequence, 0.1, 0.5);
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
fn no_curve_is_a_lone_background() {
    let sequence = scene::render("flight", 96, 72).unwrap();
    let mut solver = start(&sequence, &[], best());
    let found = run(&mut solver);
    whole(&found, &sequence, 1);
    assert_eq!(solver.energy().length, 0.0);
    assert!(solver.contours().is_empty());
    let flow = horn_schunck::solve(&pair(&sequence), horn_schunck::ALPHA, horn_schunck::SWEEPS);
    let (baseline, _) = compare_flow(&flow, &sequence.truth.flow, None)
        .unwrap()
        .unwrap();
    let (labels, aee) = scores(&found, &sequence);
    assert_eq!(labels, 0.0);
    assert!(aee < 0.9 * baseline, "AEE {aee}, Horn–Schunck {baseline}");
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
fn curves_drawn_after_a_run_find_their_objects() {
    let sequence = scene::render("blocks", 96, 72).unwrap();
    let mut solver = start(&sequence, &[], best());
    run(&mut solver);
    solver.set_curves(&sequence.curves).unwrap();
    assert_eq!(solver.status(), Status::Running);
    let (labels, aee) = scores(&run(&mut solver), &sequence);
    assert!(labels < 0.045, "{labels} of all labels are wrong");
    assert!(aee < 0.025, "AEE {aee}");
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
fn the_smallest_frames_work() {
    for (width, height) in [(16, 16), (16, 57), (131, 17)] {
        let sequence = scene::render("squares", width, height).unwrap();
        let middle = circle(width as f64 / 2.0, height as f64 / 2.0, 4.0);
        let mut solver = start(&sequence, &[middle], best());
        run(&mut solver);
        assert_ne!(solver.status(), Status::Diverged);
        assert!(solver.history().iter().all(|e| e.is_finite()));
        whole(&solver.interpretation(), &sequence, 2);
    }
}

#[test]
fn brightness_has_no_unit() {
    let sequence = scene::render("blocks", 96, 72).unwrap();
    let solve = |gain: f32| {
        let [first, second] = [0, 1].map(|i| {
            let grey = sequence.frames[i].grey.map(|g| gain * g);
            Frame::from_grey(grey).unwrap()
        });
        let pair = FramePair::new(first, second).unwrap();
        let camera = sequence.truth.camera;
        run(&mut Solver::new(pair, camera, &sequence.curves, best()).unwrap()).labels
    };
    let share = differing(&solve(1.0), &solve(0.5));
    assert!(share < 0.02, "{share} of all labels differ");
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
