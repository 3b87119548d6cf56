//! Curves start on the bodies that they are drawn on.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

mod solving;

use relievo::scene::{Sequence, render};
#[cfg(not(target_arch = "wasm32"))]
use relievo::start::Look;
use relievo::{Options, Shape, Solver};
use solving::{circle, differing, pair, start};

fn wrong(solver: &Solver, sequence: &Sequence) -> f64 {
    differing(&solver.interpretation().labels, &sequence.truth.labels)
}

fn circles(sequence: &Sequence) -> Vec<[f64; 3]> {
    let each = sequence.curves.iter().map(|curve| match *curve {
        Shape::Circle { x, y, r } => [x, y, r],
        Shape::Polygon { .. } => panic!("circles come with a sequence"),
    });
    each.collect()
}

/// Each circle put some way towards the next one's place.
fn towards_the_next(sequence: &Sequence, way: f64) -> Vec<Shape> {
    let own = circles(sequence);
    let next = own.iter().cycle().skip(1);
    own.iter()
        .zip(next)
        .map(|(a, b)| circle(a[0] + way * (b[0] - a[0]), a[1] + way * (b[1] - a[1]), a[2]))
        .collect()
}

#[test]
fn a_pass_takes_curves_to_where_their_bodies_end() {
    let sequence = render("carousel", 320, 240).unwrap();
    for way in [0.0, 0.15, -0.15] {
        let curves = towards_the_next(&sequence, way);
        let mut solver = start(&sequence, &curves, Options::default());
        let before = wrong(&solver, &sequence);
        assert!(before > 0.08, "{way}: {before} before");
        solver.step();
        let after = wrong(&solver, &sequence);
        assert!(after < 0.04, "{way}: {after} after");
    }
}

#[test]
fn until_the_first_step_curves_are_as_drawn_and_may_be_drawn_again() {
    let sequence = render("blocks", 320, 240).unwrap();
    let mut solver = start(&sequence, &[circle(20.0, 20.0, 9.0)], Options::default());
    solver.set_curves(&sequence.curves).unwrap();
    let mut other = start(&sequence, &sequence.curves, Options::default());
    let drawn = other.interpretation().labels;
    assert_eq!(solver.interpretation().labels, drawn);
    // Motion is found first; curves stay until their own step.
    other.step_motion();
    assert_eq!(other.interpretation().labels, drawn);
    solver.step();
    other.step_depth();
    other.step_curves();
    assert!(wrong(&solver, &sequence) < 0.02);
    assert_eq!(
        solver.interpretation().labels,
        other.interpretation().labels
    );
}

#[test]
fn curves_drawn_before_the_first_step_might_have_been_there_from_the_start() {
    let sequence = render("blocks", 320, 240).unwrap();
    let mut solver = start(&sequence, &[], Options::default());
    solver.set_curves(&sequence.curves).unwrap();
    let mut other = start(&sequence, &sequence.curves, Options::default());
    for _ in 0..2 {
        solver.step();
        other.step();
    }
    assert_eq!(solver.report().level, other.report().level);
    assert_eq!(solver.interpretation(), other.interpretation());
}

#[test]
fn curves_drawn_between_the_first_steps_count() {
    let sequence = render("blocks", 320, 240).unwrap();
    let mut solver = start(&sequence, &sequence.curves[..1], Options::default());
    solver.step_motion();
    solver.set_curves(&sequence.curves).unwrap();
    solver.step();
    assert!(wrong(&solver, &sequence) < 0.02);
}

#[test]
fn a_curve_drawn_later_is_where_it_is_drawn() {
    let sequence = render("blocks", 320, 240).unwrap();
    let mut solver = start(&sequence, &sequence.curves, Options::default());
    for _ in 0..4 {
        solver.step();
    }
    let small: Vec<Shape> = circles(&sequence)
        .iter()
        .map(|[x, y, r]| circle(*x, *y, 0.6 * r))
        .collect();
    solver.set_curves(&small).unwrap();
    solver.step_motion();
    let drawn = start(&sequence, &small, Options::default());
    let away = differing(
        &solver.interpretation().labels,
        &drawn.interpretation().labels,
    );
    assert!(away < 0.005, "{away}");
}

/// Whether two passes do the same as when nobody looks for bodies.
fn starts_as_drawn(sequence: &Sequence, curves: &[Shape]) -> bool {
    let off = Options {
        bodies: false,
        ..Options::default()
    };
    let [with, without] = [Options::default(), off].map(|options| {
        let mut solver = start(sequence, curves, options);
        solver.step();
        solver.step();
        solver.interpretation()
    });
    with == without
}

#[test]
fn curves_that_are_on_no_body_of_their_own_start_as_drawn() {
    let sequence = render("blocks", 320, 240).unwrap();
    let [x, y, r] = circles(&sequence)[0];
    let both = [
        circle(x - 0.5 * r, y, 0.4 * r),
        circle(x + 0.5 * r, y, 0.4 * r),
    ];
    assert!(starts_as_drawn(&sequence, &both));
    assert!(!starts_as_drawn(&sequence, &sequence.curves));
}

// In WebAssembly this seed draws another scene.
#[cfg(not(target_arch = "wasm32"))]
#[test]
fn things_that_touch_and_move_alike_are_told_apart_by_their_curves() {
    let sequence = relievo::scene::variant("carousel", 9011, 1.0, 4.0, 320, 240).unwrap();
    let look = Look::at(&pair(&sequence), &sequence.truth.camera).unwrap();
    // Patches alone take the ball for a part of the box that it touches.
    assert_eq!(look.bodies().len(), 2);
    for way in [0.0, 0.2] {
        let curves = towards_the_next(&sequence, way);
        let mut solver = start(&sequence, &curves, Options::default());
        solver.step();
        let after = wrong(&solver, &sequence);
        assert!(after < 0.03, "{way}: {after} after");
    }
}

#[test]
fn frames_too_small_to_show_bodies_start_as_drawn() {
    let sequence = render("squares", 40, 30).unwrap();
    assert!(starts_as_drawn(&sequence, &sequence.curves));
}
