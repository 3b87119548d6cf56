//! Motion with depth eliminated: the search over all directions.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use glam::DVec3;
use relievo::motion::{Blocks, Candidate};
use relievo::warp::{Linearisation, RESIDUAL};
use relievo::{Camera, Grid, RigidMotion, Window};

const W: usize = 72;
const H: usize = 56;
/// Side of a block.
const SIDE: usize = 8;

fn camera() -> Camera {
    Camera::centred(60.0, W, H).unwrap()
}

fn motion(t: [f64; 3], w: [f64; 3]) -> RigidMotion {
    RigidMotion {
        translation: DVec3::from_array(t),
        rotation: DVec3::from_array(w),
    }
}

/// Numbers from 0 to 1 that look like noise.
fn hash(x: usize, y: usize, salt: usize) -> f64 {
    ((x * 7919 + y * 104_729 + x * y * 13 + salt * 3_001) % 1009) as f64 / 1008.0
}

fn degrees(a: DVec3, b: DVec3) -> f64 {
    a.angle_between(b).to_degrees()
}

/// Constraints around no motion that (1) obeys exactly, every block with a depth of its own.
fn constraints(motion: &RigidMotion) -> Linearisation {
    let camera = camera();
    let mut rows = Grid::new(W, H, [0.0; 8]);
    let mut gradient = Grid::new(W, H, [0.0f32; 2]);
    for y in 0..H {
        for x in 0..W {
            let [ix, iy] = [1, 2].map(|salt| 40.0 * hash(x, y, salt) - 20.0);
            let rho = 0.4 + 1.5 * hash(x / SIDE, y / SIDE, 3);
            let (u, v) = camera.image_motion(motion, x as f64, y as f64, rho);
            gradient[(x, y)] = [ix as f32, iy as f32];
            rows[(x, y)][RESIDUAL] = -(ix * u + iy * v) as f32;
        }
    }
    Linearisation {
        window: Window::whole(W, H),
        rows,
        gradient,
        flow: Grid::new(W, H, [0.0; 2]),
        inside: Grid::new(W, H, true),
    }
}

fn search(motion: &RigidMotion, rotates: bool) -> Candidate {
    let weight = Grid::new(W, H, 1.0f32);
    let blocks = Blocks::gather(&camera(), &constraints(motion), &weight, SIDE, 0.0);
    assert!(blocks.enough());
    blocks.search(rotates).unwrap()
}

#[test]
fn the_search_needs_no_depth_to_start_from() {
    for (t, w) in [
        ([0.01, 0.02, 0.06], [-0.01, 0.006, 0.012]),
        ([0.01, 0.02, -0.06], [-0.01, 0.006, 0.012]),
        ([-0.02, 0.01, 0.05], [0.0, 0.0, 0.0]),
    ] {
        let truth = motion(t, w);
        let found = search(&truth, true).motion;
        // Sign included: depth lies in front of the camera.
        let off = degrees(found.translation, truth.translation);
        assert!(off < 2.0, "T of {t:?} is off by {off}°");
        assert!((found.translation.length() - 1.0).abs() < 1e-6);
        let turn = (found.rotation - truth.rotation).length();
        assert!(turn < 2e-3, "ω of {w:?} is off by {turn}");
    }
}

#[test]
fn sideways_motion_is_found_though_a_turn_looks_nearly_the_same() {
    for (t, w) in [
        ([0.05, 0.0, 0.0], [0.004, 0.01, -0.008]),
        ([-0.05, 0.01, 0.0], [0.0, 0.0, 0.0]),
        ([-0.02, -0.05, 0.03], [0.02, -0.03, 0.0]),
    ] {
        let truth = motion(t, w);
        let found = search(&truth, true).motion;
        let off = degrees(found.translation, truth.translation);
        assert!(off < 8.0, "T of {t:?} is off by {off}°");
        // The turn about the axis of sight does not: it is found as it is.
        let roll = (found.rotation.z - truth.rotation.z).abs();
        assert!(roll < 4e-3, "w3 of {w:?} is off by {roll}");
    }
}

#[test]
fn a_search_without_rotation_finds_none() {
    let truth = motion([0.03, -0.04, 0.02], [0.0; 3]);
    let found = search(&truth, false).motion;
    assert_eq!(found.rotation, DVec3::ZERO);
    assert!(degrees(found.translation, truth.translation) < 1.5);
}

#[test]
fn the_true_direction_costs_least_and_its_opposite_more() {
    let truth = motion([0.03, -0.04, 0.02], [0.01, 0.0, -0.01]);
    let weight = Grid::new(W, H, 1.0f32);
    let blocks = Blocks::gather(&camera(), &constraints(&truth), &weight, SIDE, 0.0);
    let along = blocks.judge(truth.translation, true).unwrap();
    // The sign is the search's to find: both ways are the same question.
    let against = blocks.judge(-truth.translation, true).unwrap();
    assert!(degrees(against.motion.translation, truth.translation) < 1e-3);
    assert!((against.cost - along.cost).abs() <= 1e-9 * along.cost.abs());
    for across in [DVec3::X, DVec3::Y, DVec3::Z] {
        assert!(blocks.judge(across, true).unwrap().cost > 10.0 * along.cost);
    }
}

#[test]
fn too_few_pixels_are_no_region_to_search() {
    let line = constraints(&motion([0.05, 0.0, 0.0], [0.0; 3]));
    let none = Grid::new(W, H, 0.0f32);
    assert!(!Blocks::gather(&camera(), &line, &none, SIDE, 0.0).enough());
    let corner = Grid::from_fn(W, H, |x, y| f32::from(x < SIDE && y < SIDE));
    assert!(!Blocks::gather(&camera(), &line, &corner, SIDE, 0.0).enough());
}
