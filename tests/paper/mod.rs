//! Solvers of built-in sequences with the settings of the paper.
#![allow(dead_code, reason = "each test file uses some of these")]

use relievo::options::Preset;
use relievo::scene::{self, Sequence};
use relievo::{FramePair, Interpretation, Options, Shape, Solver, Status};

pub fn paper() -> Options {
    Options::preset(Preset::Paper)
}

pub fn pair(sequence: &Sequence) -> FramePair {
    let [first, second] = sequence.frames.clone();
    FramePair::new(first, second).unwrap()
}

pub fn start(sequence: &Sequence, curves: &[Shape], options: Options) -> Solver {
    Solver::new(pair(sequence), sequence.truth.camera, curves, options).unwrap()
}

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
