//! Smoothing frames and differentiating them.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::Grid;
use relievo::frames::{Derivatives, blur, gradient};

const W: usize = 24;
const H: usize = 18;

fn pixels() -> impl Iterator<Item = (usize, usize)> {
    (0..W * H).map(|i| (i % W, i / W))
}

#[test]
fn smoothing_keeps_constants_and_sums() {
    let flat = Grid::new(W, H, 77.0f32);
    let mut peak = Grid::new(41, 37, 0.0f32);
    peak[(20, 18)] = 100.0;
    for sigma in [0.3, 1.0, 2.5] {
        let smooth = blur(&flat, sigma);
        assert!(smooth.data().iter().all(|g| (g - 77.0).abs() < 1e-3));
        let spread = blur(&peak, sigma);
        let total: f32 = spread.data().iter().sum();
        assert!((total - 100.0).abs() < 1e-2, "{total} at σ = {sigma}");
        // As wide in both directions as asked for, but for what lies beyond 3σ.
        for along in [|x: usize, _: usize| x as f32 - 20.0, |_, y| y as f32 - 18.0] {
            let moment = Grid::from_fn(41, 37, |x, y| along(x, y).powi(2) * spread[(x, y)]);
            let deviation = (moment.data().iter().sum::<f32>() / 100.0).sqrt();
            // Sampled at whole pixels, one narrower than a pixel comes out narrower still.
            let ratio = f64::from(deviation) / sigma;
            let narrow = sigma < 0.5 && ratio < 1.0;
            assert!(
                narrow || (ratio - 1.0).abs() < 0.03,
                "σ {deviation} for {sigma}"
            );
        }
    }
    assert_eq!(blur(&peak, 0.0), peak);
}

#[test]
fn smoothing_twice_is_smoothing_once_by_more() {
    let picture = Grid::from_fn(W, H, |x, y| ((x * 7919 + y * 104_729) % 200) as f32);
    let twice = blur(&blur(&picture, 1.2), 1.6);
    let once = blur(&picture, 2.0);
    for (x, y) in pixels() {
        if x > 8 && y > 8 && x + 8 < W && y + 8 < H {
            assert!((twice[(x, y)] - once[(x, y)]).abs() < 1.0);
        }
    }
}

#[test]
fn derivatives_of_polynomials_are_exact() {
    let p = |x: f64, y: f64| 3.0 + 2.0 * x - y + 0.25 * x * y - 0.1 * x.powi(3) + 0.02 * y.powi(4);
    let px = |x: f64, y: f64| 2.0 + 0.25 * y - 0.3 * x * x;
    let py = |x: f64, y: f64| -1.0 + 0.25 * x + 0.08 * y.powi(3);
    // Small coordinates, so that single precision is fine enough.
    let real = |x: usize, y: usize| (x as f64 - 8.0, y as f64 - 6.0);
    let picture = Grid::from_fn(17, 13, |x, y| {
        let (x, y) = real(x, y);
        p(x, y) as f32
    });
    let [ix, iy] = gradient(&picture);
    for y in 2..11 {
        for x in 2..15 {
            let at = (x, y);
            let (rx, ry) = real(x, y);
            assert!((f64::from(ix[at]) - px(rx, ry)).abs() < 1e-4);
            assert!((f64::from(iy[at]) - py(rx, ry)).abs() < 1e-4);
        }
    }
}

#[test]
fn derivatives_belong_to_the_moment_between_the_frames() {
    // I = x² − 3xy + t (2x + y) + 5t: at t = 1/2, Ix = 2x − 3y + 1, Iy = −3x + 1/2, It = 2x + y + 5.
    let frame = |t: f32| {
        Grid::from_fn(W, H, |x, y| {
            let (x, y) = (x as f32, y as f32);
            x * x - 3.0 * x * y + t * (2.0 * x + y) + 5.0 * t
        })
    };
    let found = Derivatives::between(&frame(0.0), &frame(1.0));
    for (x, y) in pixels() {
        let (rx, ry) = (x as f32, y as f32);
        assert!((found.it[(x, y)] - (2.0 * rx + ry + 5.0)).abs() < 1e-3);
        if x >= 2 && y >= 2 && x + 2 < W && y + 2 < H {
            assert!((found.ix[(x, y)] - (2.0 * rx - 3.0 * ry + 1.0)).abs() < 1e-3);
            assert!((found.iy[(x, y)] - (0.5 - 3.0 * rx)).abs() < 1e-3);
        }
    }
}

#[test]
fn between_pixels_linear_pictures_are_exact_and_beyond_the_border_is_the_border() {
    let plane = Grid::from_fn(W, H, |x, y| 2.0 * x as f32 - 0.5 * y as f32 + 1.0);
    for (x, y) in [(3.0f32, 4.0f32), (3.25, 4.75), (10.5, 9.1), (20.9, 15.9)] {
        assert!((plane.bilinear(x, y) - (2.0 * x - 0.5 * y + 1.0)).abs() < 1e-4);
    }
    for (x, y, border) in [(-7.5, -3.0, (0, 0)), (99.0, 99.5, (W - 1, H - 1))] {
        assert_eq!(plane.bilinear(x, y), plane[border]);
    }
}
