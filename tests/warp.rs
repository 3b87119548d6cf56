//! The constraint linearised around a motion that is known already.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use glam::{DQuat, DVec3};
use relievo::warp::{Linearisation, RESIDUAL, Scale};
use relievo::{Camera, Grid, RigidMotion};

const W: usize = 64;
const H: usize = 48;

/// A texture that is known between its pixels, in grey levels.
fn texture(x: f64, y: f64) -> f64 {
    120.0 + 45.0 * (0.23 * x + 0.06 * y).sin() + 35.0 * (0.19 * y - 0.04 * x + 0.7).cos()
}

fn rho() -> Grid<f32> {
    Grid::from_fn(W, H, |x, y| {
        (1.0 + 0.2 * (x as f64 / 11.0).sin() + 0.005 * y as f64) as f32
    })
}

fn motion() -> RigidMotion {
    RigidMotion {
        translation: DVec3::new(0.03, -0.02, 0.05),
        rotation: DVec3::new(0.015, -0.02, 0.03),
    }
}

/// Frames in which every point keeps its brightness: the second is the texture, the first what comes
/// to each pixel's target.
fn exact() -> Scale {
    let camera = Camera::new(60.0, 30.0, 25.0).unwrap();
    let (rho, motion) = (rho(), motion());
    let first = Grid::from_fn(W, H, |x, y| {
        let (px, py) = (x as f64, y as f64);
        let (u, v) = camera
            .displacement(&motion, px, py, f64::from(rho[(x, y)]))
            .unwrap();
        texture(px + u, py + v) as f32
    });
    let second = Grid::from_fn(W, H, |x, y| texture(x as f64, y as f64) as f32);
    Scale::new(camera, first, second)
}

/// Far enough from the border for interpolation to have all its neighbours.
fn interior(line: &Linearisation) -> impl Iterator<Item = (usize, usize)> {
    (0..W * H).map(|i| (i % W, i / W)).filter(|&(x, y)| {
        let [u, v] = line.flow[(x, y)];
        let (qx, qy) = (x as f32 + u, y as f32 + v);
        let deep = |p: f32, side: usize| p > 4.0 && p < side as f32 - 5.0;
        deep(x as f32, W) && deep(y as f32, H) && deep(qx, W) && deep(qy, H)
    })
}

#[test]
fn true_motion_and_depth_leave_no_residual() {
    let scale = exact();
    let (motion, rho) = (motion(), rho());
    let line = scale.linearise(&motion, &rho, scale.whole());
    for (x, y) in interior(&line) {
        let at = (x, y);
        assert!(line.rows[at][RESIDUAL].abs() < 0.05);
        let (px, py) = (x as f64, y as f64);
        let depth = f64::from(rho[at]);
        let (u, v) = scale.camera.displacement(&motion, px, py, depth).unwrap();
        let [fu, fv] = line.flow[at].map(f64::from);
        assert!((fu - u).abs() < 1e-4 && (fv - v).abs() < 1e-4);
    }
    // And it is not that nothing could leave one.
    let still = scale.linearise(&RigidMotion::default(), &rho, scale.whole());
    let sum: f32 = still.rows.data().iter().map(|r| r[RESIDUAL].abs()).sum();
    assert!(sum / (W * H) as f32 > 5.0);
}

/// The motion with its `j`-th component (T, then a turn after the motion) changed by `step`.
fn changed(motion: &RigidMotion, j: usize, step: f64) -> RigidMotion {
    let mut by = [0.0; 3];
    by[j % 3] = step;
    let by = DVec3::from_array(by);
    if j < 3 {
        return RigidMotion {
            translation: motion.translation + by,
            ..*motion
        };
    }
    let turn = DQuat::from_scaled_axis(by);
    RigidMotion {
        translation: turn * motion.translation,
        rotation: (turn * DQuat::from_scaled_axis(motion.rotation)).to_scaled_axis(),
    }
}

#[test]
fn rows_are_the_derivatives_of_the_residual() {
    let mut scale = exact();
    let (motion, rho) = (motion(), rho());
    let warped = scale.linearise(&motion, &rho, scale.whole()).flow;
    // With frames whose gradients agree where they see the same point, the rows are exact.
    for y in 0..H {
        for x in 0..W {
            let [u, v] = warped[(x, y)];
            let (qx, qy) = (x as f32 + u, y as f32 + v);
            let (gx, gy) = &scale.second_gradient;
            let both = (gx.bilinear(qx, qy), gy.bilinear(qx, qy));
            scale.first_gradient.0[(x, y)] = both.0;
            scale.first_gradient.1[(x, y)] = both.1;
        }
    }
    let line = scale.linearise(&motion, &rho, scale.whole());
    // Steps that move the image by about a tenth of a pixel.
    let step = 0.1 / scale.camera.focal;
    for column in 0..7 {
        let moved = |by: f64| match column {
            0 => scale.linearise(&motion, &rho.map(|r| r + (10.0 * by) as f32), scale.whole()),
            j => scale.linearise(&changed(&motion, j - 1, by), &rho, scale.whole()),
        };
        let (forth, back) = (moved(step), moved(-step));
        let span = 2.0 * step * if column == 0 { 10.0 } else { 1.0 };
        let (mut error, mut size) = (0.0f64, 0.0f64);
        for at in interior(&line) {
            let difference = f64::from(forth.rows[at][RESIDUAL] - back.rows[at][RESIDUAL]) / span;
            let stated = f64::from(line.rows[at][column]);
            error = error.max((stated - difference).abs());
            size = size.max(difference.abs());
        }
        assert!(
            error < 0.01 * size,
            "column {column}: off by {error} of {size}"
        );
    }
}

#[test]
fn what_leaves_the_frame_says_nothing() {
    let scale = exact();
    let right = RigidMotion {
        translation: DVec3::new(0.5, 0.0, 0.0),
        rotation: DVec3::ZERO,
    };
    // f T / Z = 30 pixels to the right.
    let line = scale.linearise(&right, &Grid::new(W, H, 1.0), scale.whole());
    for y in 0..H {
        for x in 0..W {
            let stays = x + 30 < W;
            assert_eq!(line.inside[(x, y)], stays, "({x}, {y})");
            assert_eq!(line.rows[(x, y)] == [0.0; 8], !stays, "({x}, {y})");
        }
    }
    // Behind the camera is outside as well.
    let past = RigidMotion {
        translation: DVec3::new(0.0, 0.0, -2.0),
        rotation: DVec3::ZERO,
    };
    let line = scale.linearise(&past, &Grid::new(W, H, 1.0), scale.whole());
    assert!(line.inside.data().iter().all(|inside| !inside));
    assert!(line.rows.data().iter().all(|row| *row == [0.0; 8]));
}
