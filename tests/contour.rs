//! Curves read off level sets.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::curves::contours;
use relievo::{Contour, Grid};

/// Twice the signed area in pixels; above 0 when it runs clockwise on screen.
fn area2(c: &Contour) -> f32 {
    let n = c.points.len();
    (0..n)
        .map(|i| {
            let (a, b) = (c.points[i], c.points[(i + 1) % n]);
            a[0] * b[1] - a[1] * b[0]
        })
        .sum()
}

fn circle(width: usize, height: usize, cx: f32, cy: f32, r: f32) -> Grid<f32> {
    Grid::from_fn(width, height, |x, y| {
        r - (x as f32 - cx).hypot(y as f32 - cy)
    })
}

#[test]
fn a_circle_comes_out_at_its_radius_and_closed() {
    let found = contours(&circle(64, 48, 30.3, 22.7, 15.4), 3);
    assert_eq!(found.len(), 1);
    assert!(found[0].closed && found[0].label == 3);
    for p in &found[0].points {
        let r = (p[0] - 30.3).hypot(p[1] - 22.7);
        assert!((r - 15.4).abs() < 0.05, "radius {r} at {p:?}");
    }
    let n = found[0].points.len();
    for i in 0..n {
        let (a, b) = (found[0].points[i], found[0].points[(i + 1) % n]);
        assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1.5, "a gap after {a:?}");
    }
    let disc = std::f32::consts::PI * 15.4 * 15.4;
    assert!((area2(&found[0]) / 2.0 - disc).abs() < 0.01 * disc);
}

#[test]
fn a_ring_has_a_clockwise_outer_and_a_counter_clockwise_inner_curve() {
    let phi = Grid::from_fn(40, 40, |x, y| {
        4.0 - ((x as f32 - 20.0).hypot(y as f32 - 20.0) - 10.0).abs()
    });
    let found = contours(&phi, 1);
    assert_eq!(found.len(), 2);
    assert!(area2(&found[0]) > 0.0 && area2(&found[1]) < 0.0);
}

#[test]
fn the_border_of_the_frame_closes_the_curve() {
    // All inside: the frame's own outline, half a pixel out, corners cut.
    let found = contours(&Grid::new(5, 4, 2.0), 1);
    assert_eq!(found.len(), 1);
    for p in &found[0].points {
        let on_x = p[0] == -0.5 || p[0] == 4.5;
        let on_y = p[1] == -0.5 || p[1] == 3.5;
        assert!(on_x || on_y, "{p:?}");
    }
    // Half inside.
    let found = contours(&circle(30, 20, -2.0, 9.5, 8.0), 1);
    assert_eq!(found.len(), 1);
    assert!(found[0].points.iter().any(|p| p[0] == -0.5));
    assert!(found[0].points.iter().all(|p| p[0] >= -0.5));
}

#[test]
fn one_sign_gives_no_curve_and_numbers_that_are_none_are_outside() {
    assert!(contours(&Grid::new(8, 8, -1.0), 1).is_empty());
    assert!(contours(&Grid::new(8, 8, f32::NAN), 1).is_empty());
    let mut phi = Grid::new(8, 8, f32::NEG_INFINITY);
    phi[(3, 3)] = f32::INFINITY;
    phi[(4, 3)] = f32::NAN;
    let found = contours(&phi, 1);
    assert_eq!(found.len(), 1);
    assert!(found[0].points.iter().flatten().all(|c| c.is_finite()));
}

/// Whether curves enclose a pixel's centre, by the even–odd rule along the ray to the right.
fn enclosed(curves: &[Contour], x: f32, y: f32) -> bool {
    let mut odd = false;
    for c in curves {
        for (i, a) in c.points.iter().enumerate() {
            let b = c.points[(i + 1) % c.points.len()];
            let at = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            odd ^= (a[1] > y) != (b[1] > y) && x < at;
        }
    }
    odd
}

#[test]
fn curves_part_inside_from_outside_whatever_the_signs() {
    let check = |phi: &Grid<f32>| {
        let curves = contours(phi, 1);
        for y in 0..phi.height() {
            for x in 0..phi.width() {
                let inside = enclosed(&curves, x as f32, y as f32);
                assert_eq!(inside, phi[(x, y)] > 0.0, "({x}, {y}) of {phi:?}");
            }
        }
    };
    for pattern in 0..16_u32 {
        check(&Grid::from_fn(2, 2, |x, y| {
            if pattern >> (2 * y + x) & 1 == 1 {
                1.0
            } else {
                -1.5
            }
        }));
    }
    let mut state = 7_u32;
    check(&Grid::from_fn(33, 21, |_, _| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 16) as f32 / 32768.0 - 1.0
    }));
}
