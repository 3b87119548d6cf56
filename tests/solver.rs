//! The solver on the built-in sequences, with the settings of the paper.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use std::sync::atomic::{AtomicU32, Ordering};

use relievo::options::Preset;
use relievo::scene::{self, Sequence};
use relievo::score::{compare, compare_flow};
use relievo::{
    Camera, Error, Frame, FramePair, Grid, Interpretation, Options, Shape, Solver, Status,
    horn_schunck,
};

fn paper() -> Options {
    Options::preset(Preset::Paper)
}

fn pair(sequence: &Sequence) -> FramePair {
    let [first, second] = sequence.frames.clone();
    FramePair::new(first, second).unwrap()
}

fn start(sequence: &Sequence, curves: &[Shape], options: Options) -> Solver {
    Solver::new(pair(sequence), sequence.truth.camera, curves, options).unwrap()
}

fn small() -> (Sequence, Solver) {
    let sequence = scene::render("squares", 64, 48).unwrap();
    let solver = start(&sequence, &sequence.curves, paper());
    (sequence, solver)
}

fn run(solver: &mut Solver) -> Interpretation {
    while solver.step() == Status::Running {}
    solver.interpretation()
}

fn differing(a: &Grid<u8>, b: &Grid<u8>) -> f64 {
    let pairs = a.data().iter().zip(b.data());
    pairs.filter(|(a, b)| a != b).count() as f64 / a.len() as f64
}

fn circle(x: f64, y: f64, r: f64) -> Shape {
    Shape::Circle { x, y, r }
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

/// Solves a sequence from its circles; checks what the method promises.
fn promise(name: &str, wrong: f64) -> (Sequence, Interpretation) {
    let sequence = scene::render(name, 160, 120).unwrap();
    let mut solver = start(&sequence, &sequence.curves, paper());
    let found = run(&mut solver);
    let scores = compare(&found, &sequence.truth).unwrap();
    let labels = scores.labels_wrong;
    assert!(labels <= wrong, "{name}: {labels} of all labels are wrong");
    assert_eq!(solver.status(), Status::Converged, "{name}");
    falls(name, solver.history());
    (sequence, found)
}

fn falls(name: &str, history: &[f64]) {
    assert!(history.iter().all(|e| e.is_finite() && *e > 0.0));
    for (i, pass) in history.windows(11).enumerate() {
        let ratio = pass[10] / pass[0];
        assert!(
            ratio <= 1.01,
            "{name}: energy grew by {ratio} from pass {i}"
        );
    }
    assert!(history[history.len() - 1] < 0.97 * history[0], "{name}");
}

#[test]
fn squares_are_found() {
    let (sequence, found) = promise("squares", 0.04);
    let (alpha, sweeps) = (horn_schunck::ALPHA, horn_schunck::SWEEPS);
    let baseline = horn_schunck::solve(&pair(&sequence), alpha, sweeps);
    let aee = |flow| {
        compare_flow(flow, &sequence.truth.flow, None)
            .unwrap()
            .unwrap()
            .0
    };
    let (own, baseline) = (aee(&found.flow), aee(&baseline));
    assert!(own <= baseline, "AEE {own}, Horn–Schunck {baseline}");
}

#[test]
fn blocks_are_found() {
    promise("blocks", 0.08);
}

#[test]
fn turning_bodies_are_found() {
    promise("carousel", 0.08);
}

#[test]
fn it_does_not_matter_where_the_circles_are_put() {
    let sequence = scene::render("squares", 120, 90).unwrap();
    // Each circle moved by a share of its radius, one curve one way, the next the other.
    let placements = [
        (0.0, 0.0, 1.0),
        (0.5, 0.0, 0.9),
        (-0.35, 0.35, 1.1),
        (0.0, -0.5, 1.0),
        (-0.3, -0.4, 0.95),
    ];
    let found = placements.map(|(dx, dy, size)| {
        let moved = sequence.curves.iter().zip([1.0, -1.0]);
        let curves: Vec<Shape> = moved
            .map(|(curve, way)| match curve {
                Shape::Circle { x, y, r } => circle(x + way * dx * r, y + dy * r, size * r),
                Shape::Polygon { .. } => curve.clone(),
            })
            .collect();
        run(&mut start(&sequence, &curves, paper())).labels
    });
    for (i, a) in found.iter().enumerate() {
        for (j, b) in found.iter().enumerate().skip(i + 1) {
            let share = differing(a, b);
            assert!(share <= 0.02, "{share} differ between starts {i} and {j}");
        }
    }
}

#[test]
fn brightness_has_no_unit() {
    let sequence = scene::render("squares", 96, 72).unwrap();
    let solve = |gain: f32| {
        let [first, second] = [0, 1].map(|i| {
            let grey = sequence.frames[i].grey.map(|g| gain * g);
            Frame::from_grey(grey).unwrap()
        });
        let pair = FramePair::new(first, second).unwrap();
        let camera = sequence.truth.camera;
        run(&mut Solver::new(pair, camera, &sequence.curves, paper()).unwrap())
    };
    let (whole, half) = (solve(1.0), solve(0.5));
    assert!(differing(&whole.labels, &half.labels) < 0.005);
}

#[test]
fn the_order_of_the_curves_only_names_them() {
    let sequence = scene::render("squares", 96, 72).unwrap();
    let mut reversed = sequence.curves.clone();
    reversed.reverse();
    let forth = run(&mut start(&sequence, &sequence.curves, paper())).labels;
    let back = run(&mut start(&sequence, &reversed, paper())).labels;
    let renamed = back.map(|label| [0, 2, 1][usize::from(label)]);
    assert!(differing(&forth, &renamed) < 0.005);
}

#[test]
fn no_curve_is_a_lone_background() {
    let sequence = scene::render("flight", 96, 72).unwrap();
    let mut solver = start(&sequence, &[], paper());
    for _ in 0..30 {
        solver.step();
    }
    falls("flight", solver.history());
    let found = solver.interpretation();
    assert_eq!(found.regions(), 1);
    assert!(found.labels.data().iter().all(|&label| label == 0));
    assert!(solver.contours().is_empty());
    assert_eq!(solver.energy().length, 0.0);
    let scores = compare(&found, &sequence.truth).unwrap();
    let truth = &sequence.truth.flow;
    let lengths = truth.u.data().iter().zip(truth.v.data());
    let still = lengths.map(|(u, v)| f64::from(u.hypot(*v))).sum::<f64>() / truth.u.len() as f64;
    let aee = scores.aee.unwrap();
    assert!(aee < 0.4 * still, "AEE {aee}, no motion {still}");
}

#[test]
fn seven_curves_make_eight_regions() {
    let sequence = scene::render("carousel", 96, 72).unwrap();
    let curves: Vec<Shape> = (0..7)
        .map(|i| {
            circle(
                14.0 + f64::from(i % 4) * 22.0,
                18.0 + f64::from(i / 4) * 36.0,
                8.0,
            )
        })
        .collect();
    let mut solver = start(&sequence, &curves, paper());
    for _ in 0..5 {
        assert_eq!(solver.step(), Status::Running);
    }
    let report = solver.report();
    assert_eq!(report.regions.len(), 8);
    let (pixels, shares) = report
        .regions
        .iter()
        .fold((0, 0.0), |(p, s), r| (p + r.pixels, s + r.share));
    assert_eq!(pixels, 96 * 72);
    assert!((shares - 1.0).abs() < 1e-12);
    let found = solver.interpretation();
    for (k, region) in report.regions.iter().enumerate() {
        let labels = found.labels.data().iter();
        assert_eq!(region.label, k);
        assert_eq!(
            labels.filter(|&&l| usize::from(l) == k).count(),
            region.pixels
        );
    }
}

#[test]
fn mean_inverse_depth_is_one_in_every_region_after_a_motion_step() {
    let (_, mut solver) = small();
    for _ in 0..4 {
        solver.step_motion();
        let found = solver.interpretation();
        for k in 0..3 {
            let all = found.labels.data().iter().zip(found.depth.data());
            let own = all
                .filter(|(l, _)| **l == k)
                .map(|(_, z)| f64::from(z.recip()));
            let (sum, n) = own.fold((0.0, 0), |(s, n), rho| (s + rho, n + 1));
            let mean = sum / f64::from(n);
            assert!((mean - 1.0).abs() < 1e-4, "{mean} in region {k}");
        }
        solver.step_depth();
        solver.step_curves();
    }
}

#[test]
fn depth_is_positive_and_flow_is_what_depth_and_motion_give() {
    let (sequence, mut solver) = small();
    let found = run(&mut solver);
    for y in 0..48 {
        for x in 0..64 {
            let at = (x, y);
            let z = f64::from(found.depth[at]);
            assert!(z.is_finite() && z > 0.0);
            let motion = &found.motions[usize::from(found.labels[at])];
            let camera = &sequence.truth.camera;
            let (u, v) = camera.image_motion(motion, x as f64, y as f64, z.recip());
            let error = (f64::from(found.flow.u[at]) - u).hypot(f64::from(found.flow.v[at]) - v);
            assert!(error < 0.05, "{error} px at {at:?}");
            assert!((0.0..=1.0).contains(&found.confidence[at]));
        }
    }
}

#[test]
fn three_single_steps_are_a_pass() {
    let (_, mut whole) = small();
    let (_, mut parts) = small();
    for _ in 0..3 {
        whole.step();
        parts.step_motion();
        parts.step_depth();
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
        solver.step_depth();
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
                1 => solver.step_depth(),
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
    assert!(report.warnings.iter().any(|w| w.contains("curve 1")));
    assert!(solver.contours().is_empty());
    let energy = solver.energy();
    assert!(energy.total().is_finite() && energy.length == 0.0);
}

#[test]
fn frames_that_hold_no_numbers_end_as_diverged() {
    let (sequence, _) = small();
    let mut grey = sequence.frames[1].grey.clone();
    grey[(20, 20)] = f32::NAN;
    let [first, _] = sequence.frames.clone();
    let broken = FramePair::new(first, Frame::from_grey(grey).unwrap()).unwrap();
    let camera = sequence.truth.camera;
    let mut solver = Solver::new(broken, camera, &sequence.curves, paper()).unwrap();
    assert_eq!(solver.step(), Status::Diverged);
    assert_eq!(solver.step(), Status::Diverged);
    assert_eq!(solver.iterations(), 1);
}

#[test]
fn curves_enclose_the_pixels_that_they_label() {
    let (_, mut solver) = small();
    let found = run(&mut solver);
    for k in 1..3u8 {
        let pixels = found.labels.data().iter().filter(|&&l| l == k).count() as f64;
        let mut area = 0.0;
        for curve in solver.contours().iter().filter(|c| c.label == k) {
            assert!(curve.closed && curve.points.len() > 2);
            for (i, p) in curve.points.iter().enumerate() {
                assert!((-0.5..=63.5).contains(&p[0]) && (-0.5..=47.5).contains(&p[1]));
                let q = curve.points[(i + 1) % curve.points.len()];
                area += 0.5 * f64::from(p[0] * q[1] - q[0] * p[1]);
            }
        }
        assert!((area / pixels - 1.0).abs() < 0.05, "{area} and {pixels} px");
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
        let kind = report["regions"][k as usize]["kind"].as_str().unwrap();
        assert!(["still", "rotation", "translation", "full"].contains(&kind));
    }
    assert!(number("/weights/mu") > 0.0 && number("/weights/lambda") > 0.0);
    assert!(report["warnings"].as_array().unwrap().is_empty());
    let times = ["motion", "depth", "curves"].map(|step| number(&format!("/seconds/{step}")));
    assert!(times.iter().all(|t| *t >= 3.0), "{times:?}");
    assert_eq!(number("/seconds/total"), times.iter().sum::<f64>());
}

/// Natively there is memory enough.
#[cfg(target_arch = "wasm32")]
#[test]
fn frames_beyond_the_memory_of_wasm_are_refused_before_anything_is_done() {
    let (width, height) = (2400, 1800);
    let frame = |shift: usize| {
        let grey = Grid::from_fn(width, height, |x, y| ((x + shift) * (y + 3) % 251) as f32);
        Frame::from_grey(grey).unwrap()
    };
    let pair = FramePair::new(frame(0), frame(1)).unwrap();
    let camera = Camera::centred(2400.0, width, height).unwrap();
    let solver = |options| Solver::new(pair.clone(), camera, &[], options);
    let Err(error) = solver(Options::default()) else {
        panic!("taken on");
    };
    let sentence = error.to_string();
    assert!(sentence.contains("2400×1800") && sentence.contains("4 megapixels"));
    assert!(solver(Options::preset(Preset::Paper)).is_ok());
}
