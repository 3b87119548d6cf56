//! What the preset `best` finds: coarse to fine, a depth field per region.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

mod solving;

use relievo::options::Preset;
use relievo::scene::{self, Sequence};
use relievo::score::{compare, compare_flow};
use relievo::{Frame, FramePair, Interpretation, Options, Solver, Status, horn_schunck};
use solving::{best, circle, differing, pair, run, start, whole};

/// Labels wrong and AEE.
fn scores(found: &Interpretation, sequence: &Sequence) -> (f64, f64) {
    let scores = compare(found, &sequence.truth).unwrap();
    (scores.labels_wrong, scores.aee.unwrap())
}

/// Solves a sequence; AEE is to be below `ratio` times that of the preset `paper` and of Horn–Schunck.
fn promise(sequence: &Sequence, wrong: f64, ratio: f64) {
    let name = &sequence.name;
    let mut solver = start(sequence, &sequence.curves, best());
    let found = run(&mut solver);
    whole(&found, sequence, sequence.truth.regions());
    assert_ne!(solver.status(), Status::Diverged, "{name}");
    assert!(solver.history().iter().all(|e| e.is_finite() && *e > 0.0));
    let (labels, aee) = scores(&found, sequence);
    assert!(labels < wrong, "{name}: {labels} of all labels are wrong");
    let paper = Options::preset(Preset::Paper);
    let (paper_labels, paper) = scores(
        &run(&mut start(sequence, &sequence.curves, paper)),
        sequence,
    );
    assert!(
        labels < 0.8 * paper_labels,
        "{name}: {labels}, {paper_labels}"
    );
    assert!(
        aee < ratio * paper,
        "{name}: AEE {aee}, the paper's {paper}"
    );
    let (alpha, sweeps) = (horn_schunck::ALPHA, horn_schunck::SWEEPS);
    let flow = horn_schunck::solve(&pair(sequence), alpha, sweeps);
    let (baseline, _) = compare_flow(&flow, &sequence.truth.flow, None)
        .unwrap()
        .unwrap();
    assert!(
        aee < ratio * baseline,
        "{name}: AEE {aee}, Horn–Schunck {baseline}"
    );
}

#[test]
fn independent_blocks_are_found() {
    promise(&scene::render("blocks", 160, 120).unwrap(), 0.04, 0.6);
}

#[test]
fn a_head_before_its_wall_is_found() {
    promise(&scene::render("head", 160, 120).unwrap(), 0.03, 0.6);
}

#[test]
fn blocks_that_move_by_several_pixels_are_found() {
    let sequence = scene::variant("blocks", 3, 0.0, 13.0, 100, 75).unwrap();
    promise(&sequence, 0.1, 0.5);
}

#[test]
fn no_curve_is_a_lone_background() {
    let sequence = scene::render("flight", 96, 72).unwrap();
    let mut solver = start(&sequence, &[], best());
    let found = run(&mut solver);
    whole(&found, &sequence, 1);
    assert_eq!(solver.energy().length, 0.0);
    assert!(solver.contours().is_empty());
    let flow = horn_schunck::solve(&pair(&sequence), horn_schunck::ALPHA, horn_schunck::SWEEPS);
    let (baseline, _) = compare_flow(&flow, &sequence.truth.flow, None)
        .unwrap()
        .unwrap();
    let (labels, aee) = scores(&found, &sequence);
    assert_eq!(labels, 0.0);
    assert!(aee < 0.9 * baseline, "AEE {aee}, Horn–Schunck {baseline}");
}

#[test]
fn curves_drawn_after_a_run_find_their_objects() {
    let sequence = scene::render("blocks", 96, 72).unwrap();
    let mut solver = start(&sequence, &[], best());
    run(&mut solver);
    solver.set_curves(&sequence.curves).unwrap();
    assert_eq!(solver.status(), Status::Running);
    let (labels, aee) = scores(&run(&mut solver), &sequence);
    assert!(labels < 0.045, "{labels} of all labels are wrong");
    assert!(aee < 0.025, "AEE {aee}");
}

#[test]
fn brightness_has_no_unit() {
    let sequence = scene::render("blocks", 96, 72).unwrap();
    let solve = |gain: f32| {
        let [first, second] = [0, 1].map(|i| {
            let grey = sequence.frames[i].grey.map(|g| gain * g);
            Frame::from_grey(grey).unwrap()
        });
        let pair = FramePair::new(first, second).unwrap();
        let camera = sequence.truth.camera;
        run(&mut Solver::new(pair, camera, &sequence.curves, best()).unwrap()).labels
    };
    let share = differing(&solve(1.0), &solve(0.5));
    assert!(share < 0.02, "{share} of all labels differ");
}

#[test]
fn the_smallest_frames_work() {
    for (width, height) in [(16, 16), (16, 57), (131, 17)] {
        let sequence = scene::render("squares", width, height).unwrap();
        let middle = circle(width as f64 / 2.0, height as f64 / 2.0, 4.0);
        let mut solver = start(&sequence, &[middle], best());
        run(&mut solver);
        assert_ne!(solver.status(), Status::Diverged);
        assert!(solver.history().iter().all(|e| e.is_finite()));
        whole(&solver.interpretation(), &sequence, 2);
    }
}
