//! Step 1: rigid motion by least squares.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use glam::DVec3;
use relievo::constraint::Coefficients;
use relievo::frames::Derivatives;
use relievo::paper;
use relievo::{Camera, Grid, RigidMotion};

const W: usize = 72;
const H: usize = 60;

/// Numbers from −1 to 1 that look like noise.
fn noise(x: usize, y: usize, salt: usize) -> f64 {
    ((x * 7919 + y * 104_729 + x * y * 13 + salt * 31) % 2001) as f64 / 1000.0 - 1.0
}

/// Depth with relief of its own at every pixel.
fn relief() -> Grid<f32> {
    Grid::from_fn(W, H, |x, y| {
        (1.0 + 0.3 * noise(x, y, 3) + 0.004 * x as f64) as f32
    })
}

/// Derivatives that obey ψ = 0 for `motions[label]`, but for rounding; gradients `contrast` times noise.
fn obeying(
    camera: &Camera,
    motions: &[RigidMotion],
    labels: &Grid<u8>,
    rho: &Grid<f32>,
    contrast: f64,
) -> Derivatives {
    let gradient = |salt| Grid::from_fn(W, H, |x, y| (contrast * noise(x, y, salt)) as f32);
    let (ix, iy) = (gradient(1), gradient(2));
    let it = Grid::from_fn(W, H, |x, y| {
        let at = (x, y);
        let (gx, gy) = (f64::from(ix[at]), f64::from(iy[at]));
        let c = Coefficients::at(camera, x as f64, y as f64, gx, gy);
        let motion = &motions[usize::from(labels[at])];
        -c.psi(0.0, motion, f64::from(rho[at])) as f32
    });
    Derivatives { ix, iy, it }
}

fn motion(t: [f64; 3], w: [f64; 3]) -> RigidMotion {
    RigidMotion {
        translation: DVec3::from_array(t),
        rotation: DVec3::from_array(w),
    }
}

/// The motion of region `label`, for inverse depth `rho`.
fn least_squares(
    camera: &Camera,
    derivatives: &Derivatives,
    rho: &Grid<f32>,
    labels: &Grid<u8>,
    label: usize,
    ridge: f64,
) -> Option<RigidMotion> {
    let z = rho.map(f32::recip);
    paper::least_squares(camera, derivatives, &z, labels, label + 1, ridge)[label]
}

fn one_region() -> Grid<u8> {
    Grid::new(W, H, 0)
}

#[test]
fn the_motion_of_exact_constraints_is_recovered() {
    let camera = Camera::centred(60.0, W, H).unwrap();
    let rho = relief();
    for truth in [
        motion([0.02, -0.01, 0.03], [0.004, -0.006, 0.008]),
        motion([0.03, 0.0, 0.0], [0.0; 3]),
        motion([0.0; 3], [0.0, 0.01, -0.02]),
        motion([0.0; 3], [0.0; 3]),
    ] {
        let labels = one_region();
        let derivatives = obeying(&camera, &[truth], &labels, &rho, 20.0);
        let found = least_squares(&camera, &derivatives, &rho, &labels, 0, 0.0).unwrap();
        let dt = (found.translation - truth.translation).length();
        let dw = (found.rotation - truth.rotation).length();
        assert!(dt < 1e-6 && dw < 1e-6, "off by {dt:e} and {dw:e}");
    }
}

#[test]
fn each_region_has_the_motion_of_its_own_pixels() {
    let camera = Camera::centred(60.0, W, H).unwrap();
    let rho = relief();
    let labels = Grid::from_fn(W, H, |x, y| ((x / 8 + y / 8) % 3) as u8);
    let truth = [
        motion([0.02, -0.01, 0.03], [0.004, -0.006, 0.008]),
        motion([-0.03, 0.0, 0.01], [0.0, 0.002, 0.0]),
        motion([0.0, 0.04, -0.02], [-0.003, 0.0, 0.01]),
    ];
    let derivatives = obeying(&camera, &truth, &labels, &rho, 20.0);
    for (k, truth) in truth.iter().enumerate() {
        let found = least_squares(&camera, &derivatives, &rho, &labels, k, 0.0).unwrap();
        assert!((found.translation - truth.translation).length() < 1e-6);
        assert!((found.rotation - truth.rotation).length() < 1e-6);
    }
}

#[test]
fn no_texture_and_no_pixels_give_no_motion() {
    let camera = Camera::centred(60.0, W, H).unwrap();
    let flat = Grid::new(W, H, 0.0f32);
    // Even if brightness as a whole changes.
    let derivatives = Derivatives {
        ix: flat.clone(),
        iy: flat.clone(),
        it: Grid::new(W, H, 3.0f32),
    };
    let still = |m: RigidMotion| m == RigidMotion::default();
    let rho = Grid::new(W, H, 1.0f32);
    for (label, ridge) in [(0, 0.0), (0, 1e-3), (5, 0.0), (5, 1e-3)] {
        let found = least_squares(&camera, &derivatives, &rho, &one_region(), label, ridge);
        assert!(found.is_none_or(still), "{found:?}");
    }
}

#[test]
fn one_direction_of_texture_stays_finite_and_explains_it() {
    // Stripes: only motion across them shows.
    let camera = Camera::centred(60.0, W, H).unwrap();
    let truth = [motion([0.02, 0.05, 0.0], [0.0; 3])];
    let (labels, rho) = (one_region(), Grid::new(W, H, 1.0f32));
    let mut derivatives = obeying(&camera, &truth, &labels, &rho, 20.0);
    derivatives.iy = Grid::new(W, H, 0.0);
    derivatives.it = derivatives.ix.map(|gx| -60.0 * 0.02 * gx);
    let found = least_squares(&camera, &derivatives, &rho, &labels, 0, 1e-3).unwrap();
    assert!(found.translation.is_finite() && found.rotation.is_finite());
    let (u, _) = camera.image_motion(&found, 30.0, 20.0, 1.0);
    assert!((u - 1.2).abs() < 0.02, "{u} px across the stripes");
}

#[test]
fn the_ridge_shrinks_rotation() {
    let camera = Camera::centred(60.0, W, H).unwrap();
    let rho = relief();
    let truth = [motion([0.02, -0.01, 0.0], [0.004, -0.006, 0.0])];
    let labels = one_region();
    let derivatives = obeying(&camera, &truth, &labels, &rho, 20.0);
    let turns = [0.0, 1e-3, 1e-2, 0.1, 1.0].map(|ridge| {
        let found = least_squares(&camera, &derivatives, &rho, &labels, 0, ridge).unwrap();
        found.rotation.length()
    });
    assert!(turns.is_sorted_by(|a, b| a > b), "{turns:?}");
    // The brightness of the frames is no part of it.
    let bright = obeying(&camera, &truth, &labels, &rho, 80.0);
    let a = least_squares(&camera, &derivatives, &rho, &labels, 0, 0.05).unwrap();
    let b = least_squares(&camera, &bright, &rho, &labels, 0, 0.05).unwrap();
    assert!((a.rotation - b.rotation).length() < 1e-6);
    assert!((a.translation - b.translation).length() < 1e-6);
}

#[test]
fn the_scale_of_depth_is_the_scale_of_translation() {
    let camera = Camera::centred(60.0, W, H).unwrap();
    let rho = relief();
    let truth = [motion([0.02, -0.01, 0.03], [0.004, -0.006, 0.008])];
    let labels = one_region();
    let derivatives = obeying(&camera, &truth, &labels, &rho, 20.0);
    let nearer = rho.map(|r| 4.0 * r);
    let found = least_squares(&camera, &derivatives, &nearer, &labels, 0, 0.0).unwrap();
    assert!((4.0 * found.translation - truth[0].translation).length() < 1e-6);
    assert!((found.rotation - truth[0].rotation).length() < 1e-6);
}
