//! ψ is zero exactly where brightness moves as (1) says.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use glam::DVec3;
use relievo::constraint::{Coefficients, RowMotion};
use relievo::frames::Derivatives;
use relievo::{Camera, Grid, RigidMotion};

const W: usize = 64;
const H: usize = 48;

fn camera() -> Camera {
    Camera::new(70.0, 30.2, 25.1).unwrap()
}

fn motion(scale: f64) -> RigidMotion {
    RigidMotion {
        translation: scale * DVec3::new(0.006, -0.004, 0.01),
        rotation: scale * DVec3::new(0.002, -0.003, 0.005),
    }
}

/// ψ at every pixel.
fn residual(
    camera: &Camera,
    derivatives: &Derivatives,
    motion: &RigidMotion,
    rho: &Grid<f32>,
) -> Grid<f32> {
    let mut psi = Grid::new(W, H, 0.0);
    for y in 0..H {
        let z: Vec<f32> = rho.row(y).iter().map(|r| r.recip()).collect();
        let row = RowMotion::new(camera, motion, y);
        // In two stretches, as a curve may cut a row.
        for pixels in [0..13, 13..W] {
            let out = &mut psi.row_mut(y)[pixels.clone()];
            row.residual(derivatives, y, pixels.clone(), &z[pixels], out);
        }
    }
    psi
}

/// Inverse depth of a slanted plane.
fn rho(x: f64, y: f64) -> f64 {
    1.0 + 0.004 * (x - 30.0) - 0.006 * (y - 25.0)
}

fn brightness(x: f64, y: f64) -> f64 {
    128.0 + 50.0 * (0.21 * x + 0.13 * y).sin() + 40.0 * (0.11 * x - 0.19 * y).cos()
}

fn slope(x: f64, y: f64) -> (f64, f64) {
    let (a, b) = ((0.21 * x + 0.13 * y).cos(), (0.11 * x - 0.19 * y).sin());
    (
        50.0 * 0.21 * a - 40.0 * 0.11 * b,
        50.0 * 0.13 * a + 40.0 * 0.19 * b,
    )
}

fn pixels() -> impl Iterator<Item = (usize, usize)> {
    (0..W * H).map(|i| (i % W, i / W))
}

#[test]
fn psi_is_zero_where_brightness_is_carried_along() {
    let (camera, motion) = (camera(), motion(1.0));
    for (px, py) in pixels() {
        let (x, y) = (px as f64, py as f64);
        let (ix, iy) = slope(x, y);
        let (u, v) = camera.image_motion(&motion, x, y, rho(x, y));
        let c = Coefficients::at(&camera, x, y, ix, iy);
        let psi = c.psi(-(ix * u + iy * v), &motion, rho(x, y));
        assert!(psi.abs() < 1e-9, "{psi:e} at ({px}, {py})");
        // And by as much as brightness changes otherwise.
        let psi = c.psi(2.5 - (ix * u + iy * v), &motion, rho(x, y));
        assert!((psi - 2.5).abs() < 1e-9);
    }
}

#[test]
fn psi_knows_no_scale() {
    let (camera, motion) = (camera(), motion(1.0));
    for scale in [0.1, 3.0, 250.0] {
        let mut scaled = motion;
        scaled.translation *= scale;
        for (px, py) in pixels().step_by(37) {
            let (x, y) = (px as f64, py as f64);
            let (ix, iy) = slope(x, y);
            let c = Coefficients::at(&camera, x, y, ix, iy);
            let (a, b) = (
                c.psi(0.7, &motion, rho(x, y)),
                c.psi(0.7, &scaled, rho(x, y) / scale),
            );
            assert!((a - b).abs() < 1e-12 * (1.0 + a.abs()), "{a} and {b}");
        }
    }
}

/// Root mean square of ψ and of It, in frames of which the second is the first carried along by the exact
/// displacement of `scale` times the motion.
fn carried(scale: f64) -> (f64, f64) {
    let (camera, motion) = (camera(), motion(scale));
    let first = Grid::from_fn(W, H, |x, y| brightness(x as f64, y as f64) as f32);
    let second = Grid::from_fn(W, H, |x, y| {
        // Where what is seen here came from.
        let (mut fx, mut fy) = (x as f64, y as f64);
        for _ in 0..30 {
            let (u, v) = camera.displacement(&motion, fx, fy, rho(fx, fy)).unwrap();
            (fx, fy) = (x as f64 - u, y as f64 - v);
        }
        brightness(fx, fy) as f32
    });
    let derivatives = Derivatives::between(&first, &second);
    let depth = Grid::from_fn(W, H, |x, y| rho(x as f64, y as f64) as f32);
    let psi = residual(&camera, &derivatives, &motion, &depth);
    let rms = |grid: &Grid<f32>| {
        let inner = pixels().filter(|&(x, y)| x > 2 && y > 2 && x < W - 3 && y < H - 3);
        let (sum, n) = inner.fold((0.0, 0), |(s, n), at| {
            (s + f64::from(grid[at]).powi(2), n + 1)
        });
        (sum / f64::from(n)).sqrt()
    };
    (rms(&psi), rms(&derivatives.it))
}

#[test]
fn psi_vanishes_to_first_order_between_two_frames() {
    let (psi, it) = carried(1.0);
    assert!(it > 3.0, "the frames differ by only {it} grey levels");
    assert!(psi < 0.03 * it, "ψ {psi}, It {it}");
    let (half, _) = carried(0.5);
    assert!(half < 0.3 * psi, "ψ {psi}, at half the motion {half}");
}

#[test]
fn the_residual_of_a_frame_is_psi_at_every_pixel() {
    let (camera, motion) = (camera(), motion(1.0));
    let first = Grid::from_fn(W, H, |x, y| brightness(x as f64, y as f64) as f32);
    let second = Grid::from_fn(W, H, |x, y| {
        brightness(x as f64 - 0.4, y as f64 + 0.3) as f32
    });
    let derivatives = Derivatives::between(&first, &second);
    let depth = Grid::from_fn(W, H, |x, y| rho(x as f64, y as f64) as f32);
    let psi = residual(&camera, &derivatives, &motion, &depth);
    for at in pixels() {
        let c = Coefficients::at(
            &camera,
            at.0 as f64,
            at.1 as f64,
            derivatives.ix[at].into(),
            derivatives.iy[at].into(),
        );
        let expected = c.psi(derivatives.it[at].into(), &motion, depth[at].into());
        let error = (f64::from(psi[at]) - expected).abs();
        assert!(error < 2e-4, "{} and {expected} at {at:?}", psi[at]);
    }
}

#[test]
fn slope_and_offset_are_psi_as_a_line_in_inverse_depth() {
    let (camera, motion) = (camera(), motion(1.0));
    let picture = |shift| Grid::from_fn(W, H, |x, y| brightness(x as f64 - shift, y as f64) as f32);
    let d = Derivatives::between(&picture(0.0), &picture(0.4));
    let (mut slope, mut offset) = ([0.0; 30], [0.0; 30]);
    for y in [0, 17, H - 1] {
        let row = RowMotion::new(&camera, &motion, y);
        row.along_depth(&d, y, 11..41, &mut slope, &mut offset);
        for (i, (a, b)) in slope.iter().zip(&offset).enumerate() {
            let at = (11 + i, y);
            let (ix, iy) = (d.ix[at].into(), d.iy[at].into());
            let c = Coefficients::at(&camera, at.0 as f64, y as f64, ix, iy);
            for rho in [0.0, 0.7, 3.0] {
                let expected = c.psi(d.it[at].into(), &motion, rho);
                let found = f64::from(*a) * rho + f64::from(*b);
                assert!(
                    (found - expected).abs() < 2e-4,
                    "{found} and {expected} at {at:?}"
                );
            }
        }
    }
}
