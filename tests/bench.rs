//! What the accuracy tables rest on: circles drawn by lot, labels matched, and what many numbers come to.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

#[allow(dead_code)]
#[path = "../src/scene/dice.rs"]
mod dice;
#[path = "../bench/accuracy/information.rs"]
mod information;
#[path = "../bench/accuracy/overlap.rs"]
mod overlap;
#[allow(dead_code)]
#[path = "../bench/accuracy/placements.rs"]
mod placements;
#[allow(dead_code)]
#[path = "../bench/accuracy/statistics.rs"]
mod statistics;

use glam::DVec3;
use information::{AtBest, Pixel, at_best};
use overlap::{Overlap, iou};
use placements::{Circle, GROWTH, LEAST_COVERED, MOST_SHARED, circles, covered, drawn, shared};
use relievo::motion::solve_positive;
use relievo::{Grid, RigidMotion, scene};

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

/// Numbers from −1 to 1 that look like noise.
fn noise(i: usize) -> f64 {
    let i = i as u64;
    ((i * 7919 + i * i % 1009 * 104_729) % 2003) as f64 / 1001.0 - 1.0
}

/// Pixels of a square whose residuals depend on everything.
fn textured() -> Vec<Pixel> {
    let each = (0..15 * 15).map(|i| {
        let row = std::array::from_fn(|c| noise(8 * i + c) as f32 + f32::from(c == 0));
        (row, [(i % 15) as f64, (i / 15) as f64])
    });
    each.collect()
}

const SIDEWAYS: RigidMotion = RigidMotion {
    translation: DVec3::new(2.0, 0.0, 0.0),
    rotation: DVec3::ZERO,
};

#[test]
fn estimates_scatter_as_much_as_information_foretells() {
    let (pixels, sigma) = (textured(), 0.3);
    let AtBest { depth, heading } = at_best(&pixels, sigma, &SIDEWAYS, true).unwrap();
    // Least squares, on residuals that are nothing but noise: all that is found is error.
    let mean2 = pixels.iter().map(|(_, at)| at[0] * at[0]).sum::<f64>() / pixels.len() as f64;
    let basis = |[x, y]: [f64; 2]| {
        let product = (x - 7.0) * (y - 7.0);
        [x - 7.0, y - 7.0, x * x - mean2, product, y * y - mean2]
    };
    let (mut turned, mut bent) = (0.0, 0.0);
    let draws = 400;
    for draw in 0..draws {
        let (mut normal, mut right) = ([[0.0; 11]; 11], [0.0; 11]);
        for (i, (row, at)) in pixels.iter().enumerate() {
            let q = basis(*at);
            let j: [f64; 11] = std::array::from_fn(|c| match c.checked_sub(6) {
                None => f64::from(row[1 + c]),
                Some(c) => f64::from(row[0]) * q[c],
            });
            // Three uniform numbers have variance 1 together, and are next to normal.
            let from = 3 * (draw * pixels.len() + i);
            let r = sigma * (noise(from) + noise(from + 1) + noise(from + 2));
            for a in 0..11 {
                right[a] += j[a] * r;
                (0..11).for_each(|b| normal[a][b] += j[a] * j[b]);
            }
        }
        let x = solve_positive(&normal, &right).unwrap();
        turned += (x[1] * x[1] + x[2] * x[2]) / 4.0;
        let off = |at: [f64; 2]| {
            basis(at)
                .iter()
                .zip(&x[6..])
                .map(|(q, c)| q * c)
                .sum::<f64>()
        };
        bent += pixels.iter().map(|(_, at)| off(*at).abs()).sum::<f64>() / pixels.len() as f64;
    }
    let seen = (turned / f64::from(draws as u32)).sqrt().to_degrees();
    assert!(
        (seen / heading - 1.0).abs() < 0.1,
        "{seen}, {heading} foretold"
    );
    let seen = bent / f64::from(draws as u32);
    assert!((seen / depth - 1.0).abs() < 0.1, "{seen}, {depth} foretold");
}

#[test]
fn less_noise_and_a_known_turn_tell_more_and_no_texture_tells_nothing() {
    let pixels = textured();
    let of = |sigma, turns| at_best(&pixels, sigma, &SIDEWAYS, turns).unwrap();
    let (a, b) = (of(1.0, true), of(2.0, true));
    assert!((b.depth / a.depth - 2.0).abs() < 1e-9 && (b.heading / a.heading - 2.0).abs() < 1e-9);
    let known = of(1.0, false);
    assert!(known.depth < a.depth && known.heading < a.heading);
    let bare: Vec<Pixel> = pixels.iter().map(|(_, at)| ([0.0; 8], *at)).collect();
    assert_eq!(at_best(&bare, 1.0, &SIDEWAYS, true), None);
}
