//! Which body each curve is drawn on.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::start::assignment;
use relievo::{Grid, Shape};

const W: usize = 120;
const H: usize = 60;

fn circle(x: f64, y: f64, r: f64) -> Grid<f32> {
    Shape::Circle { x, y, r }.level_set(W, H, 0).unwrap()
}

#[test]
fn each_curve_gets_the_body_that_it_is_on() {
    let curves = [circle(30.0, 30.0, 5.0), circle(90.0, 30.0, 30.0)];
    let bodies = [
        circle(85.0, 25.0, 12.0),
        circle(60.0, 8.0, 6.0),
        circle(33.0, 33.0, 15.0),
    ];
    assert_eq!(assignment(&curves, &bodies), Some(vec![2, 0]));
    let turned = [bodies[2].clone(), bodies[1].clone(), bodies[0].clone()];
    assert_eq!(assignment(&curves, &turned), Some(vec![0, 2]));
}

#[test]
fn a_curve_mostly_on_its_neighbours_body_is_still_its_own() {
    let bodies = [circle(40.0, 30.0, 18.0), circle(78.0, 30.0, 18.0)];
    // The second covers more of the first body than of its own, but the first curve is nearer there.
    let curves = [circle(32.0, 30.0, 10.0), circle(57.0, 30.0, 11.0)];
    assert_eq!(assignment(&curves, &bodies), Some(vec![0, 1]));
}

#[test]
fn a_point_inside_and_a_lasso_around_are_on_it() {
    let body = [circle(60.0, 30.0, 20.0)];
    for curve in [circle(66.0, 30.0, 1.5), circle(60.0, 30.0, 45.0)] {
        assert_eq!(assignment(&[curve], &body), Some(vec![0]));
    }
}

#[test]
fn without_a_body_for_every_curve_there_is_no_assignment() {
    let body = circle(40.0, 30.0, 18.0);
    let (on, also, beside) = (
        circle(34.0, 30.0, 8.0),
        circle(46.0, 30.0, 8.0),
        circle(90.0, 30.0, 8.0),
    );
    let one = std::slice::from_ref(&body);
    assert_eq!(assignment(&[on.clone(), also.clone()], one), None);
    assert_eq!(assignment(&[on.clone(), beside.clone()], one), None);
    let away = circle(60.0, 8.0, 6.0);
    assert_eq!(assignment(&[on.clone(), also], &[body.clone(), away]), None);
    assert_eq!(assignment(&[on], &[]), None);
    assert_eq!(assignment(&[beside], one), None);
}

#[test]
fn no_curve_needs_no_body() {
    assert_eq!(assignment(&[], &[]), Some(vec![]));
    assert_eq!(assignment(&[], &[circle(40.0, 30.0, 18.0)]), Some(vec![]));
}
