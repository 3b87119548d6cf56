#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use crate::curves::contours;

const W: usize = 64;
const H: usize = 56;

fn redistanced(phi: &Grid<f32>) -> Grid<f32> {
    let mut level = Padded::new(phi.width(), phi.height());
    level.read(phi);
    // Wherever the zero line may be.
    let row = |y| Span {
        row: y + 1,
        first: 1,
        end: phi.width() + 1,
    };
    level.band = (0..phi.height()).map(row).collect();
    Redistancing::new(phi.width(), phi.height()).run(&mut level);
    let mut found = phi.clone();
    level.write(&mut found);
    found
}

/// Least, mean and greatest distance from `(x, y)` to the points of the only curve.
fn radii(phi: &Grid<f32>, x: f32, y: f32) -> (f32, f32, f32) {
    let curves = contours(phi, 1);
    assert_eq!(curves.len(), 1, "the curve has come apart");
    let points = curves[0].points.iter();
    let r: Vec<f32> = points.map(|p| (p[0] - x).hypot(p[1] - y)).collect();
    let least = r.iter().copied().fold(f32::INFINITY, f32::min);
    let most = r.iter().copied().fold(0.0, f32::max);
    (least, r.iter().sum::<f32>() / r.len() as f32, most)
}

#[test]
fn finds_the_distance_and_leaves_the_curve_where_it_is() {
    let (x, y, r) = (30.3f32, 26.8f32, 15.4f32);
    // The zero line of a circle, but far from a distance.
    let phi = Grid::from_fn(W, H, |px, py| {
        let (dx, dy) = (px as f32 - x, py as f32 - y);
        0.03 * (r * r - dx * dx - dy * dy) * (1.2 + 0.01 * dx)
    });
    let phi = redistanced(&phi);
    let (least, mean, most) = radii(&phi, x, y);
    assert!((mean - r).abs() < 0.02, "radius {mean}");
    assert!(least > r - 0.1 && most < r + 0.1, "from {least} to {most}");
    for py in 1..H - 1 {
        for px in 1..W - 1 {
            let exact = r - (px as f32 - x).hypot(py as f32 - y);
            let found = phi[(px, py)];
            if exact.abs() > REACH - 0.5 {
                assert!(found.abs() >= REACH - 1.0 && (found > 0.0) == (exact > 0.0));
                continue;
            }
            let tolerance = if exact.abs() < 3.0 { 0.25 } else { 0.5 };
            let error = (found - exact).abs();
            assert!(error < tolerance, "{found} for {exact} at ({px}, {py})");
            if exact.abs() < REACH - 2.0 {
                let gx = phi[(px + 1, py)] - phi[(px - 1, py)];
                let gy = phi[(px, py + 1)] - phi[(px, py - 1)];
                let norm = 0.5 * gx.hypot(gy);
                assert!((norm - 1.0).abs() < 0.15, "slope {norm} at ({px}, {py})");
            }
        }
    }
}

#[test]
fn again_and_again_does_not_creep() {
    let mut phi = Grid::from_fn(W, H, |x, y| 12.4 - (x as f32 - 30.3).hypot(y as f32 - 26.8));
    for _ in 0..50 {
        phi = redistanced(&phi);
    }
    let (least, mean, most) = radii(&phi, 30.3, 26.8);
    assert!((mean - 12.4).abs() < 0.1, "radius {mean}");
    assert!(most - least < 0.6, "from {least} to {most}");
}

#[test]
fn straight_lines_keep_their_distance() {
    for angle in [0.0f32, 0.3, 0.785, 1.2, 1.571] {
        let (c, s) = (angle.cos(), angle.sin());
        let line = Grid::from_fn(W, H, |x, y| (x as f32 - 31.3) * c + (y as f32 - 27.6) * s);
        let found = redistanced(&line.map(|p| 3.0 * p));
        // Where the line leaves the frame, distances from what is beyond are not known.
        for at in (8..H - 8).flat_map(|y| (8..W - 8).map(move |x| (x, y))) {
            let (p, d) = (line[at], found[at]);
            if p.abs() < REACH - 1.0 {
                assert!((p - d).abs() < 0.3, "{d} for {p} at {angle}");
            }
        }
    }
}

#[test]
fn without_a_zero_line_all_is_far() {
    for sign in [1.0f32, -1.0] {
        let phi = Grid::from_fn(W, H, |x, y| sign * (0.1 + (x * y % 7) as f32));
        let found = redistanced(&phi);
        assert!(found.data().iter().all(|&p| p * sign >= REACH));
    }
}
