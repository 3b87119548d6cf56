//! Passes of the preset `best` at all its scales, and what may change between them.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::options::{Diffusion, Preset};
use relievo::scene::{self, Sequence};
use relievo::{Grid, Options, Shape, Status};

use crate::support::{best, circle, differing, everything, paper, run, scores, start, whole};

/// The smallest frames that are solved at two scales or so.
const SIZE: [usize; 2] = [208, 156];

fn squares() -> Sequence {
    scene::render("squares", SIZE[0], SIZE[1]).unwrap()
}

#[test]
fn every_pass_at_every_scale_can_be_looked_at() {
    let sequence = squares();
    let mut solver = start(&sequence, &sequence.curves, best());
    let mut levels = Vec::new();
    loop {
        whole(&solver.interpretation(), 3);
        let report = solver.report();
        assert_eq!(report.levels, 2);
        levels.push(report.level);
        // Pixels are counted in those of the frame at every scale.
        let pixels: usize = report.regions.iter().map(|r| r.pixels).sum();
        assert_eq!(pixels, SIZE[0] * SIZE[1]);
        let share: f64 = report.regions.iter().map(|r| r.share).sum();
        assert!((share - 1.0).abs() < 1e-9);
        let [right, bottom] = SIZE.map(|side| side as f32 - 0.5);
        for contour in solver.contours() {
            let on =
                |p: &[f32; 2]| (-0.5..=right).contains(&p[0]) && (-0.5..=bottom).contains(&p[1]);
            assert!(contour.points.iter().all(on));
        }
        if solver.status() != Status::Running {
            break;
        }
        solver.step();
        assert!(solver.energy().total().is_finite());
    }
    // From the coarse scale to the fine one, and not back.
    assert_eq!((levels[0], *levels.last().unwrap()), (1, 0));
    assert!(levels.windows(2).all(|pair| pair[1] <= pair[0]));
    // A finer scale is a break.
    let finer = levels.iter().position(|&level| level == 0).unwrap();
    assert!(solver.report().breaks.contains(&finer));
}

#[test]
fn after_the_first_scale_labels_and_flow_are_useful_already() {
    for name in ["squares", "blocks", "carousel"] {
        let sequence = scene::render(name, SIZE[0], SIZE[1]).unwrap();
        let mut solver = start(&sequence, &sequence.curves, best());
        assert_eq!(solver.report().expected, None);
        while solver.report().level > 0 {
            solver.step();
        }
        let expected = solver.report().expected.unwrap();
        whole(&solver.interpretation(), sequence.truth.regions());
        let early = scores(&solver, &sequence);
        assert!(early.labels_wrong < 0.04, "{name}: {}", early.labels_wrong);
        assert!(early.aee.unwrap() < 0.08, "{name}: {early:?}");
        // What is expected is right to a factor of four.
        let ratio = expected.labels / early.labels_wrong;
        assert!(
            (0.25..4.0).contains(&ratio),
            "{name}: {expected:?}, {early:?}"
        );
        run(&mut solver);
        let last = solver.report().expected.unwrap();
        let late = scores(&solver, &sequence);
        assert!(last.labels <= 1.2 * expected.labels);
        assert!(late.aee.unwrap() <= last.flow, "{name}: {last:?}, {late:?}");
        assert!(
            late.labels_wrong < 1.1 * early.labels_wrong,
            "{name}: {late:?}"
        );
    }
}

#[test]
fn reset_gives_the_first_run_again_and_looking_on_changes_nothing() {
    let sequence = squares();
    let mut solver = start(&sequence, &sequence.curves, best());
    let fresh = everything(&solver);
    for _ in 0..6 {
        solver.step();
    }
    let first = everything(&solver);
    assert!(first != fresh);
    solver.reset();
    assert!(everything(&solver) == fresh);
    for _ in 0..6 {
        solver.step_motion();
        everything(&solver);
        let _ = solver.step_depth();
        everything(&solver);
        solver.step_curves();
    }
    assert!(everything(&solver) == first);
}

#[test]
fn depth_alone_says_that_there_is_none_yet_and_moves_only_depth_later() {
    let sequence = squares();
    let mut solver = start(&sequence, &sequence.curves, best());
    let fresh = everything(&solver);
    let refused = solver.step_depth().unwrap_err().to_string();
    assert!(refused.contains("no depth yet"), "{refused}");
    assert!(everything(&solver) == fresh);
    let mut steps = 0;
    while solver.step() == Status::Running {
        let before = solver.interpretation();
        if solver.step_depth().is_ok() {
            let after = solver.interpretation();
            assert!(after.labels == before.labels);
            // T's length follows depth: ρ has mean 1.
            for (a, b) in after.motions.iter().zip(&before.motions) {
                assert!(a.rotation == b.rotation);
                let [s, t] = [a, b].map(|m| m.translation.normalize_or_zero());
                assert!((s - t).length() < 1e-9);
            }
            steps += 1;
        }
    }
    assert!(steps > 2, "{steps}");
    // After the end as well.
    solver.step_depth().unwrap();
    assert_eq!(solver.status(), Status::Converged);
}

#[test]
fn curves_may_be_put_elsewhere_at_any_scale() {
    let sequence = squares();
    for passes in [0, 5, 30] {
        let mut solver = start(&sequence, &sequence.curves, best());
        for _ in 0..passes {
            solver.step();
        }
        for curves in [
            vec![circle(60.0, 60.0, 18.0), circle(150.0, 84.0, 22.0)],
            vec![],
            [40.0, 104.0, 168.0]
                .map(|x| circle(x, 0.7 * x, 18.0))
                .to_vec(),
        ] {
            solver.set_curves(&curves).unwrap();
            let found = solver.interpretation();
            whole(&found, curves.len() + 1);
            // Where they were put, to a pixel of the scale at work.
            let drawn = Grid::from_fn(SIZE[0], SIZE[1], |x, y| {
                let inside = |c: &Shape| c.signed_distance(x as f64, y as f64) > 0.0;
                curves.iter().position(inside).map_or(0, |k| k as u8 + 1)
            });
            assert!(differing(&found.labels, &drawn) < 0.01, "after {passes}");
            assert_eq!(solver.step(), Status::Running);
            whole(&solver.interpretation(), curves.len() + 1);
        }
    }
}

#[test]
fn curves_drawn_after_a_run_find_their_objects() {
    let sequence = scene::render("blocks", 160, 120).unwrap();
    let mut solver = start(&sequence, &[], best());
    run(&mut solver);
    solver.set_curves(&sequence.curves).unwrap();
    assert_eq!(solver.status(), Status::Running);
    let late = run(&mut solver).labels;
    let fresh = run(&mut start(&sequence, &sequence.curves, best())).labels;
    assert_eq!(differing(&late, &fresh), 0.0);
}

#[test]
fn presets_and_light_start_anew_from_the_curves_drawn_last() {
    let sequence = squares();
    let dark = || Options {
        lighting: false,
        ..best()
    };
    for options in [paper(), dark()] {
        let mut solver = start(&sequence, &sequence.curves, best());
        for _ in 0..5 {
            solver.step();
        }
        solver.set_options(options.clone()).unwrap();
        assert!(everything(&solver) == everything(&start(&sequence, &sequence.curves, options)));
        assert_eq!(solver.step(), Status::Running);
        solver.set_options(best()).unwrap();
        assert!(everything(&solver) == everything(&start(&sequence, &sequence.curves, best())));
    }
}

#[test]
fn every_other_setting_may_change_at_any_time() {
    let sequence = squares();
    let changes: [fn(&mut Options); 7] = [
        |o| o.smoothing = 1.5,
        |o| o.model_selection = false,
        |o| o.occlusion = false,
        |o| o.discontinuities = false,
        |o| o.diffusion = Diffusion::Isotropic,
        |o| (o.mu, o.lambda) = (Some(0.0), Some(0.0)),
        |o| (o.mu, o.lambda) = (Some(1e9), Some(1e6)),
    ];
    for passes in [0, 4, 8, 40] {
        let mut solver = start(&sequence, &sequence.curves, best());
        for _ in 0..passes {
            solver.step();
        }
        for change in changes {
            let mut options = best();
            change(&mut options);
            let (before, found) = (solver.iterations(), solver.interpretation());
            solver.set_options(options).unwrap();
            // Who owns what stays.
            assert_eq!(solver.interpretation().labels, found.labels);
            solver.step();
            assert_eq!(solver.iterations(), before + 1);
            assert!(solver.energy().total().is_finite());
            whole(&solver.interpretation(), 3);
        }
    }
}

#[test]
fn a_solver_that_had_stopped_goes_on_and_stops_again() {
    let sequence = scene::render("blocks", 160, 120).unwrap();
    let mut solver = start(&sequence, &sequence.curves, best());
    let first = run(&mut solver);
    let passes = solver.iterations();
    assert_eq!(solver.step(), Status::Converged);
    assert_eq!(solver.iterations(), passes);
    let longer = Options {
        lambda: Some(2.0 * solver.report().weights.lambda),
        ..best()
    };
    solver.set_options(longer).unwrap();
    assert_eq!(solver.status(), Status::Running);
    let second = run(&mut solver);
    assert_eq!(solver.status(), Status::Converged);
    assert!(solver.iterations() <= passes + 6);
    assert!(differing(&first.labels, &second.labels) < 0.02);
}

#[test]
fn passes_allowed_are_counted_from_the_curves_drawn_last() {
    let sequence = scene::render("squares", 64, 48).unwrap();
    for &preset in Preset::ALL {
        let two = Options {
            max_passes: 2,
            ..Options::preset(preset)
        };
        let mut solver = start(&sequence, &sequence.curves, two);
        for _ in 0..2 {
            whole(&run(&mut solver), 3);
            assert_eq!(solver.status(), Status::Exhausted);
            solver.set_curves(&sequence.curves).unwrap();
            assert_eq!(solver.status(), Status::Running);
        }
        run(&mut solver);
        assert_eq!(solver.iterations(), 6);
    }
}

#[test]
fn weights_given_are_the_weights_in_force() {
    let sequence = scene::render("blocks", 96, 72).unwrap();
    let given = Options {
        mu: Some(1234.0),
        lambda: Some(56.0),
        ..best()
    };
    let mut solver = start(&sequence, &sequence.curves, given);
    run(&mut solver);
    let weights = solver.report().weights;
    assert!((weights.mu - 1234.0).abs() < 1e-6);
    assert!((weights.lambda - 56.0).abs() < 1e-3, "{weights:?}");
}
