//! What the accuracy tables rest on: circles drawn by lot, labels matched, and what many numbers come to.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

#[path = "../../bench/accuracy/overlap.rs"]
mod overlap;
#[allow(dead_code)]
#[path = "../../bench/accuracy/placements.rs"]
mod placements;
#[allow(dead_code)]
#[path = "../../bench/accuracy/statistics.rs"]
mod statistics;

use overlap::{Overlap, iou};
use placements::{Circle, GROWTH, LEAST_COVERED, MOST_SHARED, circles, covered, drawn, shared};
use relievo::{Grid, scene};

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

#[test]
fn labels_are_compared_by_what_they_cover() {
    let row = |labels: &[u8]| Grid::from_vec(labels.len(), 1, labels.to_vec()).unwrap();
    let wrong = |found: &[u8], truth: &[u8]| Overlap::of(&row(found), &row(truth)).wrong();
    assert_eq!(wrong(&[0, 2, 2, 1], &[0, 1, 1, 2]), 0.0);
    // The background's number is no name, and a body has one name.
    assert_eq!(wrong(&[1, 1, 0, 0], &[0, 0, 1, 1]), 1.0);
    assert_eq!(wrong(&[0, 1, 2, 2], &[0, 1, 1, 1]), 0.25);
    // Not the greatest overlap first, but the most right in all.
    assert_eq!(
        wrong(&[1, 1, 1, 1, 1, 2, 2, 2, 2], &[1, 1, 1, 2, 2, 1, 1, 1, 1]),
        3.0 / 9.0
    );
    assert_eq!(wrong(&[0, 0, 3, 0], &[0, 1, 1, 0]), 0.25);
}

#[test]
fn overlap_is_what_both_have_of_what_either_has() {
    let overlap = |a: [bool; 4], b: [bool; 4]| iou(a.into_iter(), b.into_iter());
    assert_eq!(
        overlap([true, true, false, false], [false, true, true, false]),
        1.0 / 3.0
    );
    assert_eq!(overlap([false; 4], [false; 4]), 0.0);
}
