//! Films: the following pair starts from what is known.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::scene::{Film, render_film};
use relievo::score::compare;
use relievo::{Frame, FramePair, Grid, Solver, Status};

use crate::support::{best, everything, paper, run, whole};

/// A film of three frames, and a solver at the end of its first pair.
fn film(name: &str, width: usize, height: usize) -> (Film, Solver) {
    let film = render_film(name, width, height, 3).unwrap();
    let pair = FramePair::new(film.frames[0].clone(), film.frames[1].clone()).unwrap();
    let mut solver = Solver::new(pair, film.truths[0].camera, &film.curves, best()).unwrap();
    run(&mut solver);
    (film, solver)
}

#[test]
fn the_following_pair_takes_fewer_passes_and_is_found_as_well() {
    for (name, width, height) in [
        ("blocks", 160, 120),
        ("carousel", 160, 120),
        ("squares", 224, 168),
    ] {
        let (film, mut solver) = film(name, width, height);
        let first = solver.iterations();
        solver.next(film.frames[2].clone()).unwrap();
        assert_eq!(solver.status(), Status::Running);
        assert!(solver.report().breaks.contains(&first));
        let found = run(&mut solver);
        assert_eq!(solver.status(), Status::Converged);
        let second = solver.iterations() - first;
        assert!(
            3 * second <= 2 * first,
            "{name}: {first} passes, then {second}"
        );
        whole(&found, film.truths[1].regions());
        let scores = compare(&found, &film.truths[1]).unwrap();
        let (wrong, aee) = (scores.labels_wrong, scores.aee.unwrap());
        assert!(wrong < 0.025, "{name}: {wrong} of all labels are wrong");
        assert!(aee < 0.03, "{name}: AEE {aee}");
    }
}

#[test]
fn the_next_frame_may_come_before_the_end() {
    for passes in [0, 1, 3, 7] {
        let film = render_film("blocks", 160, 120, 3).unwrap();
        let pair = FramePair::new(film.frames[0].clone(), film.frames[1].clone()).unwrap();
        let camera = film.truths[0].camera;
        let mut solver = Solver::new(pair, camera, &film.curves, best()).unwrap();
        for _ in 0..passes {
            solver.step();
        }
        solver.next(film.frames[2].clone()).unwrap();
        whole(&solver.interpretation(), 3);
        let found = run(&mut solver);
        let wrong = compare(&found, &film.truths[1]).unwrap().labels_wrong;
        assert!(
            wrong < 0.03,
            "after {passes}: {wrong} of all labels are wrong"
        );
    }
}

#[test]
fn a_frame_of_another_size_or_the_same_frame_changes_nothing() {
    let (film, mut solver) = film("blocks", 96, 72);
    let before = everything(&solver);
    let other = Frame::from_grey(Grid::from_fn(80, 60, |x, y| (x * y % 97) as f32)).unwrap();
    assert!(solver.next(other).is_err());
    assert!(solver.next(film.frames[1].clone()).is_err());
    assert!(everything(&solver) == before);
    assert_eq!(solver.status(), Status::Converged);
}

#[test]
fn the_paper_goes_on_too() {
    let film = render_film("squares", 64, 48, 3).unwrap();
    let pair = FramePair::new(film.frames[0].clone(), film.frames[1].clone()).unwrap();
    let mut solver = Solver::new(pair, film.truths[0].camera, &film.curves, paper()).unwrap();
    for _ in 0..3 {
        solver.step();
    }
    solver.next(film.frames[2].clone()).unwrap();
    assert_eq!(solver.step(), Status::Running);
    whole(&solver.interpretation(), 3);
}
