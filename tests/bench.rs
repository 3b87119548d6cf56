//! What the accuracy tables rest on: circles drawn by lot, and what many numbers come to.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

#[allow(dead_code)]
#[path = "../src/scene/dice.rs"]
mod dice;
#[allow(dead_code)]
#[path = "../bench/accuracy/placements.rs"]
mod placements;
#[allow(dead_code)]
#[path = "../bench/accuracy/statistics.rs"]
mod statistics;

use placements::{Circle, GROWTH, LEAST_COVERED, MOST_SHARED, circles, covered, drawn, shared};
use relievo::scene;

#[test]
fn circles_by_lot_lie_on_their_objects_and_apart() {
    let scene = scene::render("carousel", 96, 72).unwrap();
    let labels = &scene.truth.labels;
    let sets = drawn(&scene.curves, labels, 5, 1);
    assert_eq!(sets.len(), 5);
    assert_eq!(sets, drawn(&scene.curves, labels, 5, 1));
    assert_ne!(sets, drawn(&scene.curves, labels, 5, 2));
    let own = circles(&scene.curves);
    for set in sets {
        let set = circles(&set);
        for (k, circle) in set.iter().enumerate() {
            assert!(covered(circle, labels, k + 1) >= LEAST_COVERED);
            assert!((GROWTH[0]..=GROWTH[1]).contains(&(circle.r / own[k].r)));
            let apart = |other| shared(circle, other) <= MOST_SHARED;
            assert!(set[..k].iter().all(apart));
        }
    }
}

#[test]
fn two_circles_share_what_they_share() {
    let circle = |x: f64, r: f64| Circle { x, y: 0.0, r };
    assert_eq!(shared(&circle(0.0, 1.0), &circle(2.0, 1.0)), 0.0);
    assert_eq!(shared(&circle(0.0, 1.0), &circle(0.5, 3.0)), 1.0);
    // Through each other's centre: (2π/3 − √3/2)/π.
    let through = shared(&circle(0.0, 2.0), &circle(2.0, 2.0));
    assert!((through - 0.391).abs() < 1e-3, "{through}");
}

#[test]
fn many_numbers_come_to_one() {
    use statistics::{geometric_mean, median};
    assert_eq!(median(&[]), None);
    assert_eq!(median(&[3.0, 1.0, 2.0]), Some(2.0));
    assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), Some(2.5));
    assert_eq!(geometric_mean(&[]), None);
    assert!((geometric_mean(&[1.0, 4.0]).unwrap() - 2.0).abs() < 1e-12);
}
