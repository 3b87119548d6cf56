//! Step 3: curves that move as (17) says.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::curves::{contours, labels, length};
use relievo::paper::{CurveEvolution, Residuals};
use relievo::{Grid, Shape};

/// Width and height of a frame.
const W: usize = 64;
const H: usize = 56;

fn pixels() -> impl Iterator<Item = (usize, usize)> {
    (0..W * H).map(|i| (i % W, i / W))
}

/// The level set of a circle in a frame of that size.
fn circle(x: f64, y: f64, r: f64) -> Grid<f32> {
    Shape::Circle { x, y, r }.level_set(W, H, 0).unwrap()
}

/// ξ of each region, the background's first.
struct Given(Vec<Grid<f32>>);

impl Residuals for Given {
    fn write(&self, k: usize, y: usize, first: usize, xi: &mut [f32]) {
        xi.copy_from_slice(&self.0[k].row(y)[first..first + xi.len()]);
    }
}

fn evolve(phi: &mut [Grid<f32>], xi: &[Grid<f32>], lambda: f32, steps: usize) {
    CurveEvolution::new(W, H).run(phi, &Given(xi.to_vec()), lambda, steps);
}

/// Residuals of 1 that drop to 0 inside `shapes[k − 1]` for region k, and outside all for region 0.
fn residuals(shapes: &[Grid<f32>]) -> Vec<Grid<f32>> {
    let truth = labels(shapes, W, H);
    let own = |k: usize| truth.map(|l| if usize::from(l) == k { 0.0 } else { 1.0 });
    (0..=shapes.len()).map(own).collect()
}

/// The share of the frame that is labelled otherwise than in truth.
fn wrong(found: &[Grid<f32>], truth: &[Grid<f32>]) -> f64 {
    let (found, truth) = (labels(found, W, H), labels(truth, W, H));
    let pairs = found.data().iter().zip(truth.data());
    pairs.filter(|(a, b)| a != b).count() as f64 / (W * H) as f64
}

/// Least, mean and greatest distance from `(x, y)` to the points of the only curve.
fn radii(phi: &Grid<f32>, x: f64, y: f64) -> (f64, f64, f64) {
    let curves = contours(phi, 1);
    assert_eq!(curves.len(), 1, "the curve has come apart");
    let points = &curves[0].points;
    let r = points
        .iter()
        .map(|p| (f64::from(p[0]) - x).hypot(f64::from(p[1]) - y));
    let (least, sum, most) = r.fold(
        (f64::INFINITY, 0.0, 0.0),
        |(a, s, b): (f64, f64, f64), r| (a.min(r), s + r, b.max(r)),
    );
    (least, sum / points.len() as f64, most)
}

/// Area inside in pixels, sub-pixel by a ramp across the zero line.
fn area(phi: &Grid<f32>) -> f64 {
    let share = phi.data().iter().map(|&p| (p + 0.5).clamp(0.0, 1.0));
    share.map(f64::from).sum()
}

#[test]
fn no_curve_leaves_the_background_alone() {
    evolve(&mut [], &[Grid::new(W, H, 1.0f32)], 1.0, 20);
    assert!(labels(&[], W, H).data().iter().all(|&l| l == 0));
}

#[test]
fn length_alone_shrinks_a_circle_by_its_curvature() {
    let mut phi = [circle(30.3, 26.8, 14.0)];
    let same = Grid::new(W, H, 4.0f32);
    // dA/dt = −2πλ whatever the radius, so that equal steps take equal areas.
    let mut lost = Vec::new();
    for _ in 0..5 {
        let before = area(&phi[0]);
        evolve(&mut phi, &[same.clone(), same.clone()], 3.0, 20);
        lost.push(before - area(&phi[0]));
    }
    let mean = lost.iter().sum::<f64>() / 5.0;
    assert!(mean > 5.0, "{lost:?}");
    assert!(
        lost.iter().all(|l| (l / mean - 1.0).abs() < 0.12),
        "{lost:?}"
    );
    let (least, _, most) = radii(&phi[0], 30.3, 26.8);
    assert!(most - least < 0.5, "no longer round: {least} to {most}");
}

#[test]
fn a_straight_edge_has_no_curvature_and_stays() {
    let line = Grid::from_fn(W, H, |x, _| 20.6 - x as f32);
    let mut phi = [line.clone()];
    let same = Grid::new(W, H, 4.0f32);
    evolve(&mut phi, &[same.clone(), same], 3.0, 40);
    let moved = pixels().map(|at| (phi[0][at] - line[at]).abs());
    assert!(moved.fold(0.0, f32::max) < 0.05);
}

#[test]
fn a_curve_grows_and_shrinks_onto_what_its_region_explains() {
    let disc = [circle(34.0, 26.0, 14.0)];
    for start in [
        circle(28.0, 22.0, 7.0),
        circle(34.0, 26.0, 22.0),
        circle(22.0, 30.0, 12.0),
    ] {
        let mut phi = [start];
        for _ in 0..4 {
            evolve(&mut phi, &residuals(&disc), 0.05, 20);
        }
        let wrong = wrong(&phi, &disc);
        assert!(wrong < 0.005, "{wrong} wrong");
    }
}

#[test]
fn several_curves_settle_side_by_side() {
    // Two that touch and one apart; the starts reach into each other.
    let discs = [
        circle(17.0, 18.0, 11.0),
        circle(39.0, 18.0, 11.0),
        circle(30.0, 43.0, 9.0),
    ];
    let mut phi = [
        circle(22.0, 20.0, 10.0),
        circle(36.0, 20.0, 9.0),
        circle(33.0, 40.0, 12.0),
    ];
    for _ in 0..4 {
        evolve(&mut phi, &residuals(&discs), 0.05, 20);
    }
    let wrong = wrong(&phi, &discs);
    assert!(wrong < 0.01, "{wrong} wrong");
}

#[test]
fn what_a_far_region_explains_better_is_not_thrown_to_the_background() {
    // By chance the second region explains part of the first disc even better, but its curve is far away.
    let discs = [circle(20.0, 26.0, 12.0), circle(50.0, 26.0, 7.0)];
    let mut xi = residuals(&discs);
    for (x, y) in pixels() {
        if discs[0][(x, y)] > 0.0 {
            xi[1][(x, y)] = 0.01;
            xi[2][(x, y)] = if x > 20 && x < 30 { 0.0 } else { 1.0 };
        }
    }
    let cost = |phi: &[Grid<f32>]| {
        let owner = labels(phi, W, H);
        let each = pixels().map(|at| xi[usize::from(owner[at])][at]);
        each.sum::<f32>()
    };
    let mut phi = discs.clone();
    for _ in 0..4 {
        let before = cost(&phi);
        evolve(&mut phi, &xi, 1e-3, 20);
        let after = cost(&phi);
        assert!(
            after <= 1.01 * before + 1.0,
            "cost from {before} to {after}"
        );
    }
    let wrong = wrong(&phi, &discs);
    assert!(wrong < 0.01, "{wrong} wrong");
}

#[test]
fn a_larger_length_weight_gives_a_shorter_curve() {
    // A disc whose residuals flicker from pixel to pixel.
    let disc = circle(32.0, 27.0, 15.0);
    let noisy = |k: usize| {
        Grid::from_fn(W, H, |x, y| {
            let own = (disc[(x, y)] > 0.0) == (k == 1);
            let flicker = ((x * 7919 + y * 104_729 + k * 31) % 101) as f32 / 101.0;
            flicker + if own { 0.0 } else { 0.5 }
        })
    };
    let xi = [noisy(0), noisy(1)];
    let lengths = [0.001, 0.3, 3.0].map(|lambda| {
        let mut phi = [circle(32.0, 27.0, 15.0)];
        evolve(&mut phi, &xi, lambda, 40);
        length(&phi[0])
    });
    assert!(lengths.is_sorted_by(|a, b| a > b), "{lengths:?}");
}

#[test]
fn brightness_units_do_not_matter() {
    // ξ and λ scale alike with the square of grey levels.
    let disc = [circle(34.0, 26.0, 14.0)];
    let run = |unit: f32| {
        let mut phi = [circle(28.0, 22.0, 9.0)];
        let xi: Vec<_> = residuals(&disc)
            .iter()
            .map(|x| x.map(|x| unit * x))
            .collect();
        evolve(&mut phi, &xi, unit * 0.1, 15);
        phi
    };
    let [a, b] = [run(1.0), run(256.0)];
    assert_eq!(labels(&a, W, H), labels(&b, W, H));
}

#[test]
fn curves_at_the_frames_border_move_and_stay_whole() {
    // A disc of which half is outside, from starts inside and outside of it.
    let disc = [circle(0.0, 26.0, 14.0)];
    for start in [circle(0.0, 28.0, 8.0), circle(3.0, 26.0, 21.0)] {
        let mut phi = [start];
        for _ in 0..4 {
            evolve(&mut phi, &residuals(&disc), 0.05, 20);
        }
        let wrong = wrong(&phi, &disc);
        assert!(wrong < 0.005, "{wrong} wrong");
        assert_eq!(contours(&phi[0], 1).len(), 1);
    }
}

#[test]
fn a_curve_that_nothing_speaks_for_vanishes() {
    let mut phi = [circle(34.0, 26.0, 9.0)];
    let xi = [Grid::new(W, H, 0.0), Grid::new(W, H, 1.0)];
    for _ in 0..3 {
        evolve(&mut phi, &xi, 0.05, 20);
    }
    assert!(phi[0].data().iter().all(|&p| p < 0.0));
}
