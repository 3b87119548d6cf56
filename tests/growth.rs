//! Growth: a region wins back what another has bent its depth after, and leaves alone what is not its own.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::scene::{self, Sequence};
#[cfg(not(target_arch = "wasm32"))]
use relievo::score::compare;
use relievo::{FramePair, Options, Solver, Status};

fn solved(sequence: &Sequence, growth: bool) -> Solver {
    let options = Options {
        growth,
        ..Options::default()
    };
    let [first, second] = sequence.frames.clone();
    let pair = FramePair::new(first, second).unwrap();
    let camera = sequence.truth.camera;
    let mut solver = Solver::new(pair, camera, &sequence.curves, options).unwrap();
    while solver.step() == Status::Running {}
    solver
}

#[cfg(not(target_arch = "wasm32"))]
fn wrong(solver: &Solver, sequence: &Sequence) -> f64 {
    let scores = compare(&solver.interpretation(), &sequence.truth).unwrap();
    scores.labels_wrong
}

// Two solves of a whole scene: natively is enough.
#[cfg(not(target_arch = "wasm32"))]
#[test]
fn a_body_gets_back_what_the_background_has_bent_its_depth_after() {
    // The background moves by little, is faint, and holds a third of the drum when curves have settled.
    let drum = scene::variant("carousel", 1017, 3.8, 2.0, 320, 240).unwrap();
    let (without, with) = (solved(&drum, false), solved(&drum, true));
    assert!(wrong(&without, &drum) > 0.03);
    assert!(wrong(&with, &drum) < 0.8 * wrong(&without, &drum));
    assert!(with.energy().total() < without.energy().total());
}

#[cfg(not(target_arch = "wasm32"))]
#[test]
fn a_body_gets_back_what_lies_beyond_a_fold() {
    // A drum's lid, a seventh of it, is held by a background that comes nearer.
    let drum = scene::variant("carousel", 9015, 3.0, 6.0, 320, 240).unwrap();
    let (without, with) = (solved(&drum, false), solved(&drum, true));
    assert!(wrong(&without, &drum) > 0.015);
    assert!(wrong(&with, &drum) < 0.01);
}

#[cfg(not(target_arch = "wasm32"))]
#[test]
fn a_narrow_lid_is_won_back_from_a_wall_that_stands_still() {
    // Front and back of a turning lid move against each other: depth carried on level fits neither.
    let bodies = scene::render("carousel", 320, 240).unwrap();
    let found = solved(&bodies, true).interpretation();
    let scores = compare(&found, &bodies.truth).unwrap();
    let drum = 3;
    assert!(scores.iou[drum].unwrap() > 0.92);
}

#[test]
fn bodies_that_lack_nothing_stay_as_they_are() {
    let blocks = scene::render("blocks", 160, 120).unwrap();
    let (without, with) = (solved(&blocks, false), solved(&blocks, true));
    let labels = |solver: &Solver| solver.interpretation().labels;
    assert_eq!(labels(&without), labels(&with));
}
