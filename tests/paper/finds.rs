//! What the preset `paper` finds on the built-in sequences.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use crate::support::{circle, differing, pair, paper, run, small, start};
use relievo::scene::{self, Sequence};
use relievo::score::{compare, compare_flow};
use relievo::{Frame, FramePair, Interpretation, Shape, Solver, Status, horn_schunck};

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
        solver.step_depth().unwrap();
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
