//! Level sets: distances, lengths, labels, and curves that move as (17) says.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

mod discs;

use std::f64::consts::PI;

use relievo::curves::{contours, evolve, labels, length, redistance};
use relievo::{Error, Grid, Shape};

use discs::{H, W, circle, everywhere, residuals, wrong};

fn pixels() -> impl Iterator<Item = (usize, usize)> {
    (0..W * H).map(|i| (i % W, i / W))
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
fn redistancing_finds_the_distance_and_leaves_the_curve_where_it_is() {
    let (x, y, r) = (30.3, 26.8, 15.4);
    // Same zero line, but far from a distance.
    let mut phi = Grid::from_fn(W, H, |px, py| {
        let (dx, dy) = (px as f64 - x, py as f64 - y);
        (0.03 * (r * r - dx * dx - dy * dy) * (1.2 + 0.01 * dx)) as f32
    });
    redistance(&mut phi);
    let (least, mean, most) = radii(&phi, x, y);
    assert!((mean - r).abs() < 0.02, "radius {mean}");
    assert!(least > r - 0.1 && most < r + 0.1, "from {least} to {most}");
    for (px, py) in pixels() {
        let exact = r - (px as f64 - x).hypot(py as f64 - y);
        let found = f64::from(phi[(px, py)]);
        let tolerance = if exact.abs() < 3.0 { 0.25 } else { 0.8 };
        assert!(
            (found - exact).abs() < tolerance,
            "{found} for {exact} at ({px}, {py})"
        );
        // Away from the centre and the frame's border, a slope of one.
        if exact < r - 3.0 && px > 0 && py > 0 && px + 1 < W && py + 1 < H {
            let gx = phi[(px + 1, py)] - phi[(px - 1, py)];
            let gy = phi[(px, py + 1)] - phi[(px, py - 1)];
            let norm = 0.5 * gx.hypot(gy);
            assert!((norm - 1.0).abs() < 0.15, "slope {norm} at ({px}, {py})");
        }
    }
}

#[test]
fn redistancing_again_and_again_does_not_creep() {
    let mut phi = circle(30.3, 26.8, 12.4);
    let before = area(&phi);
    for _ in 0..50 {
        redistance(&mut phi);
    }
    let (least, mean, most) = radii(&phi, 30.3, 26.8);
    assert!((mean - 12.4).abs() < 0.1, "radius {mean}");
    assert!(most - least < 0.6, "from {least} to {most}");
    assert!((area(&phi) - before).abs() < 0.02 * before);
}

#[test]
fn without_a_zero_line_a_level_set_is_flat_and_far() {
    let diagonal = (W as f32).hypot(H as f32);
    for sign in [1.0f32, -1.0] {
        let mut phi = Grid::from_fn(W, H, |x, y| sign * (0.1 + (x * y % 7) as f32));
        redistance(&mut phi);
        assert!(phi.data().iter().all(|&p| p == sign * diagonal));
    }
}

#[test]
fn lengths_are_those_of_geometry() {
    for (x, y, r) in [(30.0, 26.0, 8.0), (30.3, 26.8, 12.5), (31.7, 25.9, 20.2)] {
        let (found, exact) = (length(&circle(x, y, r)), 2.0 * PI * r);
        assert!((found / exact - 1.0).abs() < 0.02, "{found} for {exact}");
    }
    // A straight line through the frame, and one across it.
    for (angle, exact) in [(0.0, H as f64), (0.2, H as f64 / 0.2f64.cos())] {
        let (c, s) = (f64::cos(angle), f64::sin(angle));
        let line = Grid::from_fn(W, H, |x, y| {
            ((x as f64 - 31.3) * c + (y as f64 - 27.5) * s) as f32
        });
        let found = length(&line);
        assert!((found / exact - 1.0).abs() < 0.02, "{found} for {exact}");
    }
    assert_eq!(length(&Grid::new(W, H, -9.0f32)), 0.0);
}

#[test]
fn each_pixel_has_the_label_of_the_curve_it_is_deepest_in() {
    let phi = [
        circle(20.0, 20.0, 12.0),
        circle(32.0, 24.0, 11.0),
        circle(26.0, 34.0, 8.0),
    ];
    let labels = labels(&phi, W, H);
    let mut seen = [0; 4];
    for at in pixels() {
        let label = usize::from(labels[at]);
        seen[label] += 1;
        let most = phi.iter().map(|p| p[at]).fold(f32::NEG_INFINITY, f32::max);
        match label {
            0 => assert!(most <= 0.0),
            k => assert!(phi[k - 1][at] > 0.0 && phi[k - 1][at] == most),
        }
    }
    assert!(seen.iter().all(|&n| n > 50), "{seen:?}");
}

#[test]
fn no_curve_leaves_the_background_alone() {
    evolve(&mut [], &[Grid::new(W, H, 1.0f32)], &everywhere(1.0), 20);
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
        evolve(
            &mut phi,
            &[same.clone(), same.clone()],
            &everywhere(3.0),
            20,
        );
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
    evolve(&mut phi, &[same.clone(), same], &everywhere(3.0), 40);
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
            evolve(&mut phi, &residuals(&disc, 1.0), &everywhere(0.05), 20);
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
        evolve(&mut phi, &residuals(&discs, 1.0), &everywhere(0.05), 20);
    }
    let wrong = wrong(&phi, &discs);
    assert!(wrong < 0.01, "{wrong} wrong");
}

#[test]
fn what_a_far_region_explains_better_is_not_thrown_to_the_background() {
    // By chance the second region explains part of the first disc even better, but its curve is far away.
    let discs = [circle(20.0, 26.0, 12.0), circle(50.0, 26.0, 7.0)];
    let mut xi = residuals(&discs, 1.0);
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
        evolve(&mut phi, &xi, &everywhere(1e-3), 20);
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
        evolve(&mut phi, &xi, &everywhere(lambda), 40);
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
        let xi: Vec<_> = residuals(&disc, 1.0)
            .iter()
            .map(|x| x.map(|x| unit * x))
            .collect();
        evolve(&mut phi, &xi, &everywhere(unit * 0.1), 15);
        phi
    };
    let [a, b] = [run(1.0), run(256.0)];
    assert_eq!(labels(&a, W, H), labels(&b, W, H));
}

#[test]
fn a_polygon_with_many_corners_is_a_circle() {
    let points = (0..200)
        .map(|i| f64::from(i) * 2.0 * PI / 200.0)
        .map(|a| [30.0 + 12.0 * a.cos(), 26.0 + 12.0 * a.sin()])
        .collect();
    let polygon = Shape::Polygon { points };
    let round = Shape::Circle {
        x: 30.0,
        y: 26.0,
        r: 12.0,
    };
    for (x, y) in pixels() {
        let (x, y) = (x as f64, y as f64);
        let (a, b) = (polygon.signed_distance(x, y), round.signed_distance(x, y));
        assert!((a - b).abs() < 0.01, "{a} and {b} at ({x}, {y})");
    }
}

#[test]
fn a_polygons_level_set_is_its_distance_at_every_pixel() {
    let star: Vec<[f64; 2]> = (0..300)
        .map(|i| (f64::from(i) * 2.0 * PI / 300.0, 9.0 + f64::from(i * i % 17)))
        .map(|(a, r)| [30.2 + r * a.cos(), 26.7 + r * a.sin()])
        .collect();
    let on_pixels = vec![[10.0, 10.0], [40.0, 10.0], [40.0, 30.0], [10.0, 30.0]];
    let crossing_itself = vec![[5.0, 5.0], [50.0, 45.0], [50.0, 5.0], [5.0, 45.0]];
    let half_outside = vec![[-400.0, 20.0], [30.0, -300.0], [30.5, 900.0], [30.5, 900.0]];
    for points in [star, on_pixels, crossing_itself, half_outside] {
        let shape = Shape::Polygon { points };
        let phi = shape.level_set(W, H, 0).unwrap();
        for (x, y) in pixels() {
            let there = shape.signed_distance(x as f64, y as f64) as f32;
            assert_eq!(phi[(x, y)], there, "({x}, {y}) of {shape:?}");
        }
    }
}

#[test]
fn what_is_no_curve_is_refused_by_number() {
    let circle = |x, y, r| Shape::Circle { x, y, r };
    let polygon = |points: &[[f64; 2]]| Shape::Polygon {
        points: points.to_vec(),
    };
    let refused = |shape: Shape, error: Error| {
        assert_eq!(shape.level_set(W, H, 2), Err(error), "{shape:?}");
    };
    let outside = Error::CurveOutside {
        curve: 3,
        width: W,
        height: H,
    };
    refused(circle(-30.0, 20.0, 10.0), outside.clone());
    refused(circle(30.0, 500.0, 10.0), outside.clone());
    refused(
        polygon(&[[70.0, 5.0], [90.0, 5.0], [80.0, 30.0]]),
        outside.clone(),
    );
    let empty = Error::CurveEmpty { curve: 3 };
    refused(circle(20.0, 20.0, 0.0), empty.clone());
    refused(circle(20.0, 20.0, -5.0), empty.clone());
    refused(circle(20.5, 20.5, 0.3), empty.clone());
    refused(polygon(&[]), empty.clone());
    refused(polygon(&[[20.0, 20.0]]), empty.clone());
    refused(polygon(&[[10.0, 10.0], [30.0, 30.0]]), empty.clone());
    refused(
        polygon(&[[10.0, 10.0], [30.0, 10.0], [20.0, 10.0]]),
        empty.clone(),
    );
    let not_finite = Error::CurveNotFinite { curve: 3 };
    refused(circle(f64::NAN, 20.0, 5.0), not_finite.clone());
    refused(circle(20.0, 20.0, f64::INFINITY), not_finite.clone());
    refused(
        polygon(&[[10.0, 10.0], [30.0, f64::NAN], [20.0, 30.0]]),
        not_finite.clone(),
    );
    assert!(outside.to_string().contains("curve 3") && outside.to_string().contains("64×56"));
    assert!(empty.to_string().contains("curve 3"));
    assert!(not_finite.to_string().contains("curve 3"));
    // Partly outside is fine.
    assert!(circle(-3.0, 20.0, 10.0).level_set(W, H, 0).is_ok());
}
