//! Where a solver stands, as bytes: looked at again, and gone on from.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::options::Diffusion;
use relievo::scene::{self, Sequence};
use relievo::{Error, Options, Solver, Status};

use crate::support::{best, paper, start};

fn blocks() -> Sequence {
    scene::render("blocks", 208, 156).unwrap()
}

fn of(sequence: &Sequence, options: Options) -> Solver {
    start(sequence, &sequence.curves, options)
}

/// The state after every pass, the start first.
fn states(solver: &mut Solver) -> Vec<Vec<u8>> {
    let mut states = vec![solver.state()];
    while solver.status() == Status::Running {
        solver.step();
        states.push(solver.state());
    }
    states
}

#[test]
fn the_next_pass_is_the_one_that_would_have_followed() {
    for name in ["blocks", "head"] {
        let sequence = scene::render(name, 208, 156).unwrap();
        let mut live = of(&sequence, best());
        let mut looked = of(&sequence, best());
        let mut state = live.state();
        while live.status() == Status::Running {
            looked.set_state(&state).unwrap();
            live.step();
            looked.step();
            assert_eq!(looked.history(), live.history());
            assert_eq!(looked.status(), live.status());
            assert!(looked.interpretation() == live.interpretation());
            assert_eq!(looked.contours(), live.contours());
            assert_eq!(looked.report().last, live.report().last);
            state = live.state();
            assert!(looked.state() == state, "{name}: {}", live.iterations());
        }
        looked.set_state(&state).unwrap();
        assert!(looked.interpretation() == live.interpretation());
    }
}

#[test]
fn a_pass_tells_what_it_did() {
    let sequence = blocks();
    let mut solver = of(&sequence, best());
    assert_eq!(solver.report().last, None);
    while solver.status() == Status::Running {
        let before = solver.interpretation().labels;
        solver.step();
        let last = solver.report().last.unwrap();
        let after = solver.interpretation().labels;
        let pairs = before.data().iter().zip(after.data());
        let changed = pairs.filter(|(a, b)| a != b).count();
        // At the finest scale as counted; the border of a coarser one may stand for less than whole pixels.
        let off = changed.abs_diff(last.changed);
        assert!(
            off * 20 <= changed * last.level.min(1),
            "{off} of {changed}"
        );
        assert!(!last.taken_back || changed == 0);
    }
}

#[test]
fn under_paper_it_is_what_an_eye_sees() {
    let sequence = scene::render("blocks", 64, 48).unwrap();
    let mut live = of(&sequence, paper());
    let mut looked = of(&sequence, paper());
    for _ in 0..5 {
        live.step();
        looked.set_state(&live.state()).unwrap();
        let (a, b) = (looked.interpretation(), live.interpretation());
        assert_eq!(a.labels, b.labels);
        assert_eq!(a.motions, b.motions);
        for (z, true_z) in a.depth.data().iter().zip(b.depth.data()) {
            assert!((z / true_z - 1.0).abs() < 6e-4);
        }
        assert_eq!(looked.report().weights, live.report().weights);
    }
    let (e, after) = (looked.step(), live.step());
    assert_eq!(e, after);
    let [e, after] = [&looked, &live].map(|s| s.energy().total());
    assert!((e / after - 1.0).abs() < 1e-2);
}

#[test]
fn it_goes_on_under_other_settings() {
    let sequence = blocks();
    let kept = states(&mut of(&sequence, best()));
    let mut other = of(&sequence, best());
    let state = &kept[kept.len() - 3];
    other.set_state(state).unwrap();
    let passes = other.iterations();
    let options = Options {
        diffusion: Diffusion::Isotropic,
        ..best()
    };
    other.set_options(options).unwrap();
    assert_eq!(other.iterations(), passes);
    while other.step() == Status::Running {}
    assert!(other.iterations() > passes);
}

#[test]
fn what_does_not_fit_is_refused_and_changes_nothing() {
    let sequence = blocks();
    let mut solver = of(&sequence, best());
    solver.step();
    let state = solver.state();
    let small = scene::render("blocks", 64, 48).unwrap();
    let refused = [
        of(&sequence, paper()).state(),
        of(&small, best()).state(),
        start(&sequence, &sequence.curves[..1], best()).state(),
        b"RLV1".to_vec(),
        Vec::new(),
    ];
    for bytes in refused {
        let error = solver.set_state(&bytes).unwrap_err();
        assert!(matches!(error, Error::File { .. }), "{error}");
        assert!(solver.state() == state);
    }
}

#[test]
fn bytes_that_were_cut_or_altered_do_no_harm() {
    for options in [best(), paper()] {
        let sequence = scene::render("squares", 64, 48).unwrap();
        let mut solver = of(&sequence, options);
        let kept = states_of(&mut solver, 9);
        for state in &kept {
            for end in [0, 3, 5, 9, 30, 60, state.len() / 2, state.len() - 1] {
                assert!(solver.set_state(&state[..end]).is_err(), "{end}");
            }
            let longer = [state.as_slice(), &[0]].concat();
            assert!(solver.set_state(&longer).is_err());
            for n in 0..60 {
                let mut other = state.clone();
                let at = (n * n * 977 + n) % other.len();
                other[at] ^= 1 << (n % 8);
                if solver.set_state(&other).is_ok() {
                    solver.step();
                    solver.interpretation();
                }
            }
        }
    }
}

fn states_of(solver: &mut Solver, passes: usize) -> Vec<Vec<u8>> {
    let mut states = Vec::new();
    for _ in 0..passes {
        solver.step();
        states.push(solver.state());
    }
    states
}
