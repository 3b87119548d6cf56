//! What regions compete with, threshold dynamics, and which pixels are hidden afterwards.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::Grid;
use relievo::curves::{labels, misfit, residual_in_units, threshold};
use relievo::occlusion::occluded;
use relievo::warp::{Linearisation, RESIDUAL};

const W: usize = 60;
const H: usize = 44;

/// A linearisation that holds residuals and one gradient only.
fn residuals(r: &[f32], gradient: [f32; 2]) -> Linearisation {
    let n = r.len();
    let mut rows = Grid::new(n, 1, [0.0f32; 8]);
    for (row, &r) in rows.data_mut().iter_mut().zip(r) {
        row[RESIDUAL] = r;
    }
    Linearisation {
        rows,
        gradient: Grid::new(n, 1, gradient),
        flow: Grid::new(n, 1, [0.0; 2]),
        inside: Grid::new(n, 1, true),
    }
}

#[test]
fn small_residuals_count_by_their_square_and_large_ones_alike() {
    let r = [0.0, 0.1, -0.1, 0.2, 8.0, 1e3, 1e6];
    let xi = residual_in_units(&residuals(&r, [0.0, 0.0]), 2.0, true);
    let xi = xi.data();
    assert_eq!(xi[0], 0.0);
    assert_eq!(xi[1], xi[2]);
    // Without texture r² itself, in grey levels².
    assert!((xi[1] - 0.01).abs() < 1e-4 && (xi[3] / xi[1] - 4.0).abs() < 0.01);
    // r = τσ, four standard deviations, pays half of the most there is: τ²σ² = 64.
    assert!((xi[4] - 32.0).abs() < 1e-3);
    assert!(xi[5] < 64.0 && xi[5] > 63.9 && xi[6] <= 64.0 && xi[6] > 63.9);
    assert!(xi.windows(2).skip(2).all(|pair| pair[0] < pair[1] + 1e-4));
}

#[test]
fn strong_texture_does_not_out_vote_weak() {
    // The same error of position, a quarter of a pixel, on faint and on strong texture.
    let (faint, strong) = (
        residuals(&[1.0], [4.0, 0.0]),
        residuals(&[20.0], [0.0, 80.0]),
    );
    let sigma = 0.5;
    let of = |line: &Linearisation, normalised| misfit(line, 0, sigma, normalised);
    assert!(of(&strong, true) < 1.5 * of(&faint, true));
    assert!(of(&strong, false) > 100.0 * of(&faint, false));
    // r = √(σ² + (δ‖∇I‖)²) is one standard deviation.
    let line = residuals(&[(0.25f32 + 1.0).sqrt()], [2.4, 3.2]);
    assert!((of(&line, true) - 1.0).abs() < 1e-5);
}

#[test]
fn what_leaves_the_frame_is_neither_confirmed_nor_refuted() {
    let mut line = residuals(&[0.0, 0.0, 100.0], [0.0, 0.0]);
    line.inside.data_mut()[0] = false;
    let xi = residual_in_units(&line, 1.5, true);
    assert!(xi.data()[1] < xi.data()[0] && xi.data()[0] < xi.data()[2]);
}

/// ξ of a background and of a disc that each fit where they are, with noise of either sign.
fn disc(cx: f32, cy: f32, r: f32) -> Vec<Grid<f32>> {
    let inside = |x: usize, y: usize| (x as f32 - cx).hypot(y as f32 - cy) < r;
    let noise = |x: usize, y: usize| ((x * 7919 + y * 104_729) % 101) as f32 / 101.0;
    [false, true]
        .map(|own| {
            Grid::from_fn(W, H, |x, y| {
                let fits = inside(x, y) == own;
                if fits {
                    1.4 * noise(x, y)
                } else {
                    1.0 + 0.6 * noise(y, x)
                }
            })
        })
        .into()
}

#[test]
fn threshold_dynamics_finds_a_disc_wherever_it_started() {
    let (cx, cy, r) = (38.0, 20.0, 10.0);
    let phi = threshold(&disc(cx, cy, r), 1.2);
    assert_eq!(phi.len(), 1);
    let found = labels(&phi, W, H);
    let (mut wrong, mut border) = (0, 0);
    for y in 0..H {
        for x in 0..W {
            let distance = r - (x as f32 - cx).hypot(y as f32 - cy);
            wrong += usize::from((found[(x, y)] == 1) != (distance > 0.0));
            // Signed distances, φ > 0 inside.
            if distance.abs() < 4.0 {
                assert!((phi[0][(x, y)] - distance).abs() < 2.0, "({x}, {y})");
                border += 1;
            }
        }
    }
    assert!(border > 100 && wrong < 25, "{wrong} pixels wrong");
}

#[test]
fn a_large_window_closes_what_is_small() {
    let xi = disc(30.0, 20.0, 2.0);
    let pixels = |sigma| {
        let found = labels(&threshold(&xi, sigma), W, H);
        found.data().iter().filter(|&&l| l == 1).count()
    };
    assert!(pixels(0.5) >= 5);
    assert_eq!(pixels(5.0), 0);
    assert!(threshold(&xi[..1], 1.0).is_empty());
}

#[test]
fn each_pixel_goes_to_the_least_of_several() {
    let xi: Vec<Grid<f32>> = (0..4)
        .map(|k| Grid::from_fn(W, H, |x, _| if x / 15 == k { 0.0 } else { 1.0 }))
        .collect();
    let found = labels(&threshold(&xi, 1.0), W, H);
    for y in 0..H {
        for x in 0..W {
            // Exactly on a border either side may have it.
            if (1..14).contains(&(x % 15)) {
                assert_eq!(usize::from(found[(x, y)]), x / 15);
            }
        }
    }
}

/// A square of side 12 at (20, 15) that slides by (`u`, `v`) over a background at rest: labels, targets
/// and χ² as they are when motions are right.
fn sliding(u: isize, v: isize) -> (Grid<u8>, Vec<[f32; 2]>, Vec<f32>) {
    let square = |x: isize, y: isize| (20..32).contains(&x) && (15..27).contains(&y);
    let pixels = (0..W * H).map(|i| ((i % W) as isize, (i / W) as isize));
    let labels = Grid::from_fn(W, H, |x, y| u8::from(square(x as isize, y as isize)));
    let target = pixels.clone().map(|(x, y)| {
        if square(x, y) {
            [(x + u) as f32, (y + v) as f32]
        } else {
            [x as f32, y as f32]
        }
    });
    // What is covered shows something else in the second frame.
    let chi2 = pixels.map(|(x, y)| {
        if !square(x, y) && square(x - u, y - v) {
            40.0
        } else {
            0.5
        }
    });
    (labels.clone(), target.collect(), chi2.collect())
}

#[test]
fn a_sliding_square_hides_the_strip_in_front_of_it() {
    for (u, v) in [(4, 0), (-3, 0), (0, 5), (2, -2), (0, 0)] {
        let (labels, target, chi2) = sliding(u, v);
        let hidden = occluded(&labels, &target, &chi2);
        for y in 0..H as isize {
            for x in 0..W as isize {
                let square = |x, y| (20..32).contains(&x) && (15..27).contains(&y);
                let covered = !square(x, y) && square(x - u, y - v);
                let found = hidden[(x as usize, y as usize)];
                assert_eq!(found, u8::from(covered), "({x}, {y}) by ({u}, {v})");
            }
        }
    }
}

#[test]
fn a_bad_pixel_alone_is_not_hidden_and_what_leaves_is() {
    let (labels, target, mut chi2) = sliding(4, 0);
    // Nobody lands on it: it only fits badly.
    chi2[5 * W + 5] = 100.0;
    assert_eq!(occluded(&labels, &target, &chi2)[(5, 5)], 0);
    let (labels, target, chi2) = sliding(0, 24);
    let hidden = occluded(&labels, &target, &chi2);
    for y in 15..27 {
        for x in 20..32 {
            assert_eq!(hidden[(x, y)], u8::from(y + 24 >= H), "({x}, {y})");
        }
    }
}
