//! Curves drawn, and read off level sets.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use std::f64::consts::PI;

use relievo::curves::{contours, labels, length};
use relievo::{Contour, Error, Grid, Shape};

/// Width and height of a frame.
const W: usize = 64;
const H: usize = 56;

fn pixels() -> impl Iterator<Item = (usize, usize)> {
    (0..W * H).map(|i| (i % W, i / W))
}

/// The level set of a circle in a frame of that size.
fn ring(x: f64, y: f64, r: f64) -> Grid<f32> {
    Shape::Circle { x, y, r }.level_set(W, H, 0).unwrap()
}

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

#[test]
fn lengths_are_those_of_geometry() {
    for (x, y, r) in [(30.0, 26.0, 8.0), (30.3, 26.8, 12.5), (31.7, 25.9, 20.2)] {
        let (found, exact) = (length(&ring(x, y, r)), 2.0 * PI * r);
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
        ring(20.0, 20.0, 12.0),
        ring(32.0, 24.0, 11.0),
        ring(26.0, 34.0, 8.0),
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
