//! Solvers of built-in sequences, and what can be asked of them.
#![allow(dead_code, reason = "each test file uses some of these")]

use relievo::options::Preset;
use relievo::scene::{self, Sequence};
use relievo::{FramePair, Grid, Interpretation, Options, Shape, Solver, Status};

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
pub fn whole(found: &Interpretation, sequence: &Sequence, regions: usize) {
    let labels = &sequence.truth.labels;
    assert_eq!(found.regions(), regions);
    assert!(found.labels.same_size(labels) && found.depth.same_size(labels));
    assert!(found.flow.u.same_size(labels) && found.flow.v.same_size(labels));
    assert!(found.confidence.same_size(labels) && found.occluded.same_size(labels));
    assert!(
        found
            .labels
            .data()
            .iter()
            .all(|&l| usize::from(l) < regions)
    );
    assert!(found.depth.data().iter().all(|z| z.is_finite() && *z > 0.0));
    assert!(found.flow.u.data().iter().all(|u| u.is_finite()));
    assert!(found.flow.v.data().iter().all(|v| v.is_finite()));
    let shares = found.confidence.data().iter();
    assert!(shares.clone().all(|c| (0.0..=1.0).contains(c)));
    let motions = found.motions.iter();
    assert!(
        motions
            .clone()
            .all(|m| m.translation.is_finite() && m.rotation.is_finite())
    );
}
