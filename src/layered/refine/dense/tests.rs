use super::*;
use crate::camera::Camera;
use crate::frames::blur;
use glam::DVec3;

const SIZE: [usize; 2] = [96, 72];

fn texture(x: f64, y: f64) -> f64 {
    let waves = [
        (0.5, 0.2),
        (-0.3, 0.6),
        (0.2, -0.7),
        (0.9, 0.4),
        (0.15, 0.1),
    ];
    let sum: f64 = waves
        .iter()
        .enumerate()
        .map(|(k, (a, b))| (a * x + b * y + k as f64).sin())
        .sum();
    128.0 + 20.0 * sum
}

/// ρ of the second frame's pixel on a slanted plane, with a step of depth at a column or without.
fn plane(x: f64, step: bool) -> f64 {
    let near = if step && x > 50.0 { 0.5 } else { 0.0 };
    0.8 + 0.003 * x + near
}

/// Noise of 2 grey levels.
fn noise(x: usize, y: usize, frame: u64) -> f32 {
    let mut h = ((x * 977 + y) as u64 * 2 + frame).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    h = (h ^ (h >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (((h >> 40) & 1023) as f32 / 511.5 - 1.0) * 3.46
}

/// Frames of a scene under a shift along x, rendered from the first frame's depth: I1(x) = I2(x + u(x)).
fn frames(step: bool, shift: f64) -> [Grid<f32>; 2] {
    let [width, height] = SIZE;
    let second = Grid::from_fn(width, height, |x, y| {
        texture(x as f64, y as f64) as f32 + noise(x, y, 1)
    });
    let first = Grid::from_fn(width, height, |x, y| {
        let moved = x as f64 + shift * plane(x as f64, step);
        texture(moved, y as f64) as f32 + noise(x, y, 0)
    });
    [first, second]
}

fn error(step: bool, wrong: impl Fn(usize, usize) -> f32) -> f32 {
    let [width, height] = SIZE;
    let (shift, focal) = (3.0, 100.0);
    let [first, second] = frames(step, shift).map(|f| blur(&f, 0.7));
    let camera = Camera::centred(focal, width, height).unwrap();
    let motion = RigidMotion {
        translation: DVec3::new(shift / focal, 0.0, 0.0),
        rotation: DVec3::ZERO,
    };
    let support = Grid::new(width, height, true);
    let truth = Grid::from_fn(width, height, |x, _| plane(x as f64, step) as f32);
    let start = Grid::from_fn(width, height, |x, y| truth[(x, y)] + wrong(x, y));
    let scale = Scale::new([first.clone(), second.clone()], [first, second], camera);
    let found = refine(&scale, &motion, &support, start);
    let (mut sum, mut count) = (0.0, 0.0);
    for y in 0..height {
        for x in 0..width - 10 {
            let r = f64::from(found.rho[(x, y)]);
            let (u, v) = camera
                .displacement(&found.motion, x as f64, y as f64, r)
                .unwrap();
            let true_u = shift * f64::from(truth[(x, y)]);
            sum += (u - true_u).hypot(v);
            count += 1.0;
        }
    }
    (sum / count) as f32
}

#[test]
fn a_smooth_surface_has_no_floor_from_its_start() {
    // A start with the staircase of a sweep, 0.2 px high.
    let e = error(false, |x, y| {
        0.07 * if (x / 7 + y / 9) % 2 == 0 { 1.0 } else { -1.0 }
    });
    assert!(e < 0.035, "{e} px");
}

#[test]
fn a_step_two_pixels_off_is_put_right() {
    let e = error(true, |x, _| if x == 51 || x == 52 { -0.5 } else { 0.0 });
    assert!(e < 0.06, "{e} px");
}
