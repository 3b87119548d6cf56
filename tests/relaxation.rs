//! The least partition: known minima of the functional (7), from any start.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

mod discs;

use relievo::Grid;
use relievo::curves::{evolve, labels, least_partition, length, redistance};

use discs::{H, W, circle, everywhere, residuals, wrong};

/// Pixels inside the only curve.
fn owned(phi: &[Grid<f32>]) -> usize {
    labels(phi, W, H).data().iter().filter(|l| **l == 1).count()
}

/// (7) with ξ given.
fn energy(phi: &[Grid<f32>], xi: &[Grid<f32>], lambda: f64) -> f64 {
    let owners = labels(phi, W, H);
    let each = owners.data().iter().enumerate();
    let data: f64 = each
        .map(|(i, &k)| f64::from(xi[usize::from(k)].data()[i]))
        .sum();
    data + lambda * phi.iter().map(length).sum::<f64>()
}

fn partition(phi: &[Grid<f32>], xi: &[Grid<f32>], lambda: f64) -> Vec<Grid<f32>> {
    least_partition(phi, xi, &everywhere(lambda as f32), f32::INFINITY)
}

#[test]
fn a_disc_stays_or_goes_as_its_length_and_its_area_say_from_any_start() {
    // Kept, it costs 2πr λ; given up, πr² c: it is worth its outline while λ < c r/2.
    let (disc, contrast) = ([circle(35.4, 29.2, 14.0)], 1.0);
    let xi = residuals(&disc, contrast);
    for start in [
        circle(35.4, 29.2, 40.0),
        circle(-30.0, 0.0, 5.0),
        circle(20.0, 20.0, 9.0),
    ] {
        let kept = partition(std::slice::from_ref(&start), &xi, 5.0);
        assert!(wrong(&kept, &disc) < 0.003);
        let gone = partition(&[start], &xi, 9.0);
        assert_eq!(owned(&gone), 0);
    }
}

#[test]
fn a_lobe_with_little_in_it_is_drawn_in_at_once() {
    let body = circle(24.0, 30.0, 15.0);
    let mut xi = residuals(std::slice::from_ref(&body), 10.0);
    let lobe = |x: usize, y: usize| (38..60).contains(&x) && (20..40).contains(&y);
    for y in 0..H {
        for x in 0..W {
            if lobe(x, y) && body[(x, y)] < 0.0 {
                xi[0][(x, y)] = 1.03;
                xi[1][(x, y)] = 1.0;
            }
        }
    }
    let grown = Grid::from_fn(W, H, |x, y| {
        if lobe(x, y) || body[(x, y)] > 0.0 {
            1.0
        } else {
            -1.0
        }
    });
    let left = |phi: &[Grid<f32>]| {
        let owners = labels(phi, W, H);
        let outside = (0..W * H).filter(|&i| body.data()[i] < -1.5);
        outside.filter(|&i| owners.data()[i] == 1).count()
    };
    let mut walked = [grown.clone()];
    redistance(&mut walked[0]);
    let before = left(&walked);
    evolve(&mut walked, &xi, &everywhere(2.0), 20);
    let at_once = partition(&[grown], &xi, 2.0);
    assert!(
        before > 400 && left(&walked) > before / 2,
        "a lobe that (17) draws in, too"
    );
    assert!(left(&at_once) < 8, "{} left", left(&at_once));
    assert!(energy(&at_once, &xi, 2.0) < energy(&walked, &xi, 2.0));
}

#[test]
fn several_regions_part_the_frame_between_them() {
    let discs = [
        circle(18.0, 20.0, 12.0),
        circle(43.0, 20.0, 12.0),
        circle(32.0, 44.0, 9.0),
    ];
    let xi = residuals(&discs, 4.0);
    let nothing = vec![circle(-30.0, 0.0, 5.0); 3];
    let found = partition(&nothing, &xi, 1.0);
    assert!(wrong(&found, &discs) < 0.01);
    for i in 0..W * H {
        let inside = found.iter().filter(|phi| phi.data()[i] > 0.0).count();
        assert!(inside <= 1, "a pixel inside two curves");
    }
}

#[test]
fn without_length_every_pixel_goes_to_the_least_residual() {
    let ragged = |x: usize, y: usize| (x * 7 + y * 13).is_multiple_of(5);
    let own = Grid::from_fn(W, H, |x, y| if ragged(x, y) { 0.0 } else { 2.0f32 });
    let xi = [Grid::new(W, H, 1.0f32), own];
    let found = labels(&partition(&[circle(30.0, 30.0, 9.0)], &xi, 0.0), W, H);
    for y in 0..H {
        for x in 0..W {
            assert_eq!(found[(x, y)] == 1, ragged(x, y), "({x}, {y})");
        }
    }
}

#[test]
fn a_region_grows_no_farther_than_its_reach_and_gives_up_any_distance() {
    let (start, reach) = (circle(30.0, 30.0, 9.0), 2.0);
    let [free, taken] = [0.0f32, 3.0].map(|own| [Grid::new(W, H, 1.0f32), Grid::new(W, H, own)]);
    let grown = least_partition(std::slice::from_ref(&start), &free, &everywhere(0.1), reach);
    let radius = (owned(&grown) as f64 / std::f64::consts::PI).sqrt();
    assert!((radius - 11.0).abs() < 0.4, "radius {radius}");
    let left = least_partition(&[start], &taken, &everywhere(0.1), reach);
    assert_eq!(owned(&left), 0);
    // What is gone does not come back.
    assert_eq!(
        owned(&least_partition(&left, &free, &everywhere(0.1), reach)),
        0
    );
}

#[test]
fn brightness_units_do_not_matter() {
    let disc = [circle(34.0, 26.0, 14.0)];
    let run = |unit: f32| {
        let xi = residuals(&disc, unit);
        let found = partition(&[circle(28.0, 22.0, 9.0)], &xi, 2.0 * f64::from(unit));
        labels(&found, W, H)
    };
    assert_eq!(run(1.0), run(1024.0));
}
