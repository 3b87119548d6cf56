//! Frames to solve, solvers of them, and what can be asked of what they find.
#![allow(dead_code, reason = "each binary uses some of these")]

use relievo::options::Preset;
use relievo::scene::{self, Sequence};
use relievo::score::{Scores, compare};
use relievo::{
    Camera, Flow, Frame, FramePair, Grid, Interpretation, Options, RigidMotion, Shape, Solver,
    Status,
};

pub fn paper() -> Options {
    Options::preset(Preset::Paper)
}

pub fn best() -> Options {
    Options::preset(Preset::Best)
}

pub fn pair(sequence: &Sequence) -> FramePair {
    let [first, second] = sequence.frames.clone();
    FramePair::new(first, second).unwrap()
}

/// A pair of grey frames.
pub fn grey_pair(first: Grid<f32>, second: Grid<f32>) -> FramePair {
    let [first, second] = [first, second].map(|grey| Frame::from_grey(grey).unwrap());
    FramePair::new(first, second).unwrap()
}

/// The sequence with the brightness of frame 0 or 1 at a pixel changed.
pub fn changed(
    mut sequence: Sequence,
    change: impl Fn(usize, (usize, usize), f32) -> f32,
) -> Sequence {
    for (i, frame) in sequence.frames.iter_mut().enumerate() {
        let grey = &frame.grey;
        let new = |x, y| change(i, (x, y), grey[(x, y)]);
        *frame = Frame::from_grey(Grid::from_fn(grey.width(), grey.height(), new)).unwrap();
    }
    sequence
}

/// A texture with detail at several scales and without a period.
pub fn texture(x: f64, y: f64) -> f64 {
    120.0
        + 22.0 * (0.11 * x + 0.05 * y + 2.0 * (0.043 * y).sin()).sin()
        + 22.0 * (0.13 * y - 0.04 * x + 2.0 * (0.037 * x).cos()).cos()
        + 14.0 * (0.5 * x - 0.37 * y + 3.0 * (0.05 * x).sin()).sin()
        + 14.0 * (0.43 * y + 0.41 * x + 3.0 * (0.045 * y).cos()).cos()
}

/// Numbers with mean 0 and standard deviation 1, each the sum of four uniform ones.
pub fn noise(width: usize, height: usize, seed: u64) -> Grid<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mut uniform = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as f64 / f64::from(1u32 << 31) - 0.5
    };
    let normal = |_, _| 3f64.sqrt() * (0..4).map(|_| uniform()).sum::<f64>();
    Grid::from_fn(width, height, normal)
}

/// Two frames of a surface that fills the view of `camera`, of inverse depth ρ(x, y) at a pixel of the first, before and
/// after `motion`, in noise of one grey level; and the truth.
pub fn surface(
    [width, height]: [usize; 2],
    focal: f64,
    motion: RigidMotion,
    rho: impl Fn(f64, f64) -> f64,
) -> Sequence {
    let camera = Camera::centred(focal, width, height).unwrap();
    let go = |x: f64, y: f64| camera.displacement(&motion, x, y, rho(x, y)).unwrap();
    let frame = |i: u64| {
        let noise = noise(width, height, i + 1);
        let seen = |x, y| {
            let (to_x, to_y) = (x as f64, y as f64);
            let (mut from_x, mut from_y) = (to_x, to_y);
            // What is seen here was at `from`: the fixed point of from + go(from) = to.
            for _ in 0..20 * i {
                let (u, v) = go(from_x, from_y);
                (from_x, from_y) = (to_x - u, to_y - v);
            }
            (texture(from_x, from_y) + noise[(x, y)]).round() as f32
        };
        Frame::from_grey(Grid::from_fn(width, height, seen)).unwrap()
    };
    let at = |f: &dyn Fn(f64, f64) -> f64| {
        Grid::from_fn(width, height, |x, y| f(x as f64, y as f64) as f32)
    };
    let shows = motion.translation != glam::DVec3::ZERO;
    Sequence {
        name: "surface".to_owned(),
        title: String::new(),
        lesson: String::new(),
        frames: [frame(0), frame(1)],
        curves: Vec::new(),
        truth: Interpretation {
            camera,
            labels: Grid::new(width, height, 0),
            depth: at(&|x, y| 1.0 / rho(x, y)),
            flow: Flow {
                u: at(&|x, y| go(x, y).0),
                v: at(&|x, y| go(x, y).1),
            },
            confidence: Grid::new(width, height, f32::from(u8::from(shows))),
            occluded: Grid::new(width, height, 0),
            motions: vec![motion],
        },
    }
}

pub fn start(sequence: &Sequence, curves: &[Shape], options: Options) -> Solver {
    Solver::new(pair(sequence), sequence.truth.camera, curves, options).unwrap()
}

/// Small frames and a solver with the settings of the paper.
pub fn small() -> (Sequence, Solver) {
    let sequence = scene::render("squares", 64, 48).unwrap();
    let solver = start(&sequence, &sequence.curves, paper());
    (sequence, solver)
}

pub fn run(solver: &mut Solver) -> Interpretation {
    while solver.step() == Status::Running {}
    solver.interpretation()
}

/// A solver of the preset `best` at its end, from the sequence's own curves.
pub fn solved(sequence: &Sequence) -> Solver {
    let mut solver = start(sequence, &sequence.curves, best());
    run(&mut solver);
    solver
}

/// How far a solver is from the truth.
pub fn scores(solver: &Solver, sequence: &Sequence) -> Scores {
    compare(&solver.interpretation(), &sequence.truth).unwrap()
}

pub fn circle(x: f64, y: f64, r: f64) -> Shape {
    Shape::Circle { x, y, r }
}

/// All that can be seen of a solver from outside, as one text.
pub fn everything(solver: &Solver) -> String {
    let parts = (
        solver.report(),
        solver.interpretation(),
        solver.contours(),
        solver.options(),
    );
    format!("{parts:?}")
}

/// The share of labels that differ.
pub fn differing(a: &Grid<u8>, b: &Grid<u8>) -> f64 {
    let pairs = a.data().iter().zip(b.data());
    pairs.filter(|(a, b)| a != b).count() as f64 / a.len() as f64
}

/// That an interpretation is whole: sizes, finite numbers, depth in front of the camera.
pub fn whole(found: &Interpretation, regions: usize) {
    let labels = &found.labels;
    assert_eq!(found.regions(), regions);
    assert!(found.depth.same_size(labels));
    assert!(found.flow.u.same_size(labels) && found.flow.v.same_size(labels));
    assert!(found.confidence.same_size(labels) && found.occluded.same_size(labels));
    assert!(labels.data().iter().all(|&l| usize::from(l) < regions));
    assert!(found.depth.data().iter().all(|z| z.is_finite() && *z > 0.0));
    assert!(found.flow.u.data().iter().all(|u| u.is_finite()));
    assert!(found.flow.v.data().iter().all(|v| v.is_finite()));
    let shares = found.confidence.data();
    assert!(shares.iter().all(|c| (0.0..=1.0).contains(c)));
    let finite = |m: &relievo::RigidMotion| m.translation.is_finite() && m.rotation.is_finite();
    assert!(found.motions.iter().all(finite));
}

/// Runs it to its end; no pass may leave a greater energy than the one before, but where a break says that the two do not
/// compare.
pub fn falls(solver: &mut Solver) {
    let mut before = f64::INFINITY;
    while solver.step() == Status::Running {
        let (energy, report) = (solver.energy().total(), solver.report());
        assert!(energy.is_finite() && energy >= 0.0);
        if report.breaks.contains(&(report.iterations - 1)) {
            before = f64::INFINITY;
        }
        let pass = report.iterations;
        assert!(
            energy <= before * (1.0 + 1e-9),
            "pass {pass}: {energy} after {before}"
        );
        before = energy;
    }
}
