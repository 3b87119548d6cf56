//! Depth that leaps where no curve is drawn, filmed in passing: a pillar before a wall, and scenes drawn by lot.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use glam::{DMat3, DVec3};
use relievo::motion::Kind;
use relievo::{Camera, Frame, FramePair, Grid, Interpretation, Options, Solver, Status, scene};

const W: usize = 160;
const H: usize = 120;
/// Distances of the pillar and of the wall, and half the pillar's width.
const NEAR: f64 = 2.0;
const FAR: f64 = 5.0;
const HALF: f64 = 0.3;
/// How much nearer the wall comes downwards.
const LEAN: f64 = -1.0;

/// Brightness of a surface at (x, y), in units of its own.
fn paint(x: f64, y: f64) -> f64 {
    let wave = |a: f64, b: f64, phase: f64| (a * x + b * y + phase).sin();
    120.0
        + 22.0 * wave(9.1, 3.7, 0.0)
        + 22.0 * wave(-4.3, 8.3, 1.0)
        + 18.0 * wave(15.7, -11.9, 2.0)
        + 18.0 * wave(7.9, 19.1, 3.0)
        + 14.0 * wave(27.3, 6.1, 4.0)
}

/// Brightness and depth of what is seen through a pixel once all has moved by `shift` and been turned by `turn`.
fn seen(camera: &Camera, x: usize, y: usize, shift: DVec3, turn: DMat3) -> (f64, f64) {
    let ray = DVec3::new(
        (x as f64 - camera.cx) / camera.focal,
        (y as f64 - camera.cy) / camera.focal,
        1.0,
    );
    // P' = R P + T, so that the ray through P' was this one.
    let (from, ray) = (turn.transpose() * -shift, turn.transpose() * ray);
    // Where Z = at + lean Y.
    let meets =
        |at: f64, lean: f64| from + ray * ((at + lean * from.y - from.z) / (ray.z - lean * ray.y));
    let pillar = meets(NEAR, 0.0);
    if pillar.x.abs() < HALF {
        (paint(1.7 * pillar.x, 1.7 * pillar.y) + 20.0, pillar.z)
    } else {
        let wall = meets(FAR, LEAN);
        (paint(wall.x + 0.4, wall.y), wall.z)
    }
}

struct Passing {
    camera: Camera,
    shift: DVec3,
    frames: [Frame; 2],
    rho: Vec<f64>,
}

fn passing(shift: DVec3, rotation: DVec3) -> Passing {
    let camera = Camera::centred(W as f64, W, H).unwrap();
    let turn = DMat3::from_quat(glam::DQuat::from_scaled_axis(rotation));
    let frame = |shift: DVec3, turn: DMat3| {
        Frame::from_grey(Grid::from_fn(W, H, |x, y| {
            seen(&camera, x, y, shift, turn).0 as f32
        }))
        .unwrap()
    };
    let rho = (0..W * H).map(|i| 1.0 / seen(&camera, i % W, i / W, DVec3::ZERO, DMat3::IDENTITY).1);
    Passing {
        shift,
        frames: [frame(DVec3::ZERO, DMat3::IDENTITY), frame(shift, turn)],
        rho: rho.collect(),
        camera,
    }
}

fn solved(frames: &[Frame; 2], camera: Camera, options: Options) -> Solver {
    let [first, second] = frames.clone();
    let pair = FramePair::new(first, second).unwrap();
    let mut solver = Solver::new(pair, camera, &[], options).unwrap();
    while solver.step() == Status::Running {}
    solver
}

/// Angle between two translations, in degrees.
fn angle(found: &Interpretation, t: DVec3) -> f64 {
    found.motions[0].translation.angle_between(t).to_degrees()
}

/// Share of pixels whose ρ is off by more than a fifth of the leap, and the least-squares slope of ρ found on ρ true;
/// both in units of mean ρ.
fn compared(found: &Interpretation, scene: &Passing) -> (f64, f64) {
    let n = (W * H) as f64;
    let mean = |rho: &[f64]| rho.iter().sum::<f64>() / n;
    let rho: Vec<f64> = found
        .depth
        .data()
        .iter()
        .map(|z| 1.0 / f64::from(*z))
        .collect();
    let (of_found, of_true) = (mean(&rho), mean(&scene.rho));
    let pairs = || {
        rho.iter()
            .zip(&scene.rho)
            .map(|(a, b)| (a / of_found, b / of_true))
    };
    let leap = (1.0 / NEAR - 1.0 / FAR) / of_true;
    let off = pairs().filter(|(a, b)| (a - b).abs() > 0.2 * leap).count() as f64 / n;
    let along: f64 = pairs().map(|(a, b)| (a - 1.0) * (b - 1.0)).sum();
    let square: f64 = pairs().map(|(_, b)| (b - 1.0).powi(2)).sum();
    (off, along / square)
}

#[test]
fn a_pillar_stands_before_its_wall_once_depths_are_swept() {
    let scene = passing(DVec3::new(-0.06, 0.01, 0.04), DVec3::new(0.0, 0.004, 0.002));
    let with = |sweep| {
        let options = Options {
            sweep,
            ..Options::default()
        };
        solved(&scene.frames, scene.camera, options)
    };
    // The pillar moves by more than half a period of its paint otherwise than the wall's depth says.
    let (off, relief) = compared(&with(false).interpretation(), &scene);
    assert!(off > 0.5 && relief < 0.5, "{off}, {relief} without a sweep");
    let found = with(true).interpretation();
    let (off, relief) = compared(&found, &scene);
    assert!(off < 0.05, "{off} of the pixels are off by much");
    assert!((relief - 1.0).abs() < 0.1, "{relief} of the relief");
    let angle = angle(&found, scene.shift);
    assert!(angle < 1.0, "T is off by {angle}°");
}

#[test]
fn what_a_sweep_leaves_rough_is_smoothed_in_the_same_pass() {
    let drawn = scene::passing("carousel", 9, 2.0, 8.0, W, H).unwrap();
    let solver = solved(&drawn.frames, drawn.truth.camera, Options::default());
    let finest = *solver.report().refined.last().unwrap();
    let energies = &solver.history()[finest..];
    let most = energies.iter().copied().fold(0.0, f64::max);
    assert!(most < 4.0 * energies[0], "{energies:?}");
}

#[test]
fn a_camera_that_turns_a_little_in_passing_is_not_said_to_shift_alone() {
    for noise in [1.0, 3.0] {
        let drawn = scene::passing("carousel", 7, noise, 4.0, W, H).unwrap();
        let solver = solved(&drawn.frames, drawn.truth.camera, Options::default());
        assert_eq!(solver.report().regions[0].kind, Kind::Full, "{noise}");
        let off = angle(&solver.interpretation(), drawn.truth.motions[0].translation);
        assert!(off < 4.0, "T is {off}° off in noise of {noise}");
    }
}

#[test]
fn the_camera_s_way_does_not_turn_for_the_sake_of_smaller_leaps() {
    for (base, seed) in [("carousel", 4), ("blocks", 7)] {
        let drawn = scene::passing(base, seed, 2.0, 4.0, W, H).unwrap();
        let solver = solved(&drawn.frames, drawn.truth.camera, Options::default());
        let off = angle(&solver.interpretation(), drawn.truth.motions[0].translation);
        assert!(off < 3.0, "T of {base} {seed} is {off}° off");
    }
}

#[test]
fn pixels_that_step_to_and_fro_do_not_use_up_all_passes() {
    let drawn = scene::passing("blocks", 16, 2.0, 4.0, W, H).unwrap();
    let solver = solved(&drawn.frames, drawn.truth.camera, Options::default());
    assert_eq!(solver.status(), Status::Converged);
    let held = &solver.history()[*solver.report().rested.last().unwrap()..];
    let least = held.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(held[held.len() - 1] < 1.01 * least, "{held:?}");
}
