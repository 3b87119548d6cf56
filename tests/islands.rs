//! Curves without islands and holes.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::Grid;
use relievo::curves::{redistance, without_islands};

const W: usize = 64;
const H: usize = 48;

/// A level set that is positive where `inside` holds.
fn level_set(inside: impl Fn(usize, usize) -> bool) -> Grid<f32> {
    let mut phi = Grid::from_fn(W, H, |x, y| if inside(x, y) { 0.5 } else { -0.5 });
    redistance(&mut phi);
    phi
}

/// A square of odd `side` around (`cx`, `cy`).
fn square(cx: usize, cy: usize, side: usize) -> impl Fn(usize, usize) -> bool + Copy {
    move |x, y| x.abs_diff(cx) <= side / 2 && y.abs_diff(cy) <= side / 2
}

/// Asserts that `phi` is positive exactly where `inside` holds.
fn is(phi: &Grid<f32>, inside: impl Fn(usize, usize) -> bool) {
    for y in 0..H {
        for x in 0..W {
            assert_eq!(phi[(x, y)] > 0.0, inside(x, y), "({x}, {y})");
        }
    }
}

#[test]
fn islands_and_holes_go() {
    let (main, island, hole) = (square(22, 24, 21), square(50, 10, 3), square(20, 22, 3));
    let mut phi = [level_set(move |x, y| {
        (main(x, y) && !hole(x, y)) || island(x, y)
    })];
    is(&phi[0], move |x, y| {
        (main(x, y) && !hole(x, y)) || island(x, y)
    });
    without_islands(&mut phi);
    is(&phi[0], main);
    // Where the island was, distance is that to what is left.
    let away = phi[0][(50, 24)];
    assert!((away + 17.5).abs() < 1.5, "{away}");
    assert!(phi[0][(22, 24)] > 8.0);
}

#[test]
fn an_island_that_touches_by_a_corner_is_an_island() {
    let (main, island) = (square(22, 24, 21), square(34, 36, 3));
    let mut phi = [level_set(move |x, y| main(x, y) || island(x, y))];
    without_islands(&mut phi);
    is(&phi[0], main);
}

#[test]
fn what_is_large_stays() {
    let (one, other) = (square(16, 24, 17), square(46, 24, 15));
    let mut two = [level_set(move |x, y| one(x, y) || other(x, y))];
    let before = two.clone();
    without_islands(&mut two);
    assert_eq!(two, before);
    let (main, hole) = (square(30, 24, 31), square(30, 24, 11));
    let mut ring = [level_set(move |x, y| main(x, y) && !hole(x, y))];
    let before = ring.clone();
    without_islands(&mut ring);
    assert_eq!(ring, before);
}

#[test]
fn a_bay_at_the_frame_s_border_is_no_hole() {
    let bay = square(0, 20, 5);
    let mut phi = [level_set(move |x, y| !bay(x, y))];
    let before = phi.clone();
    without_islands(&mut phi);
    assert_eq!(phi, before);
}

#[test]
fn a_hole_that_belongs_to_another_curve_stays() {
    let (main, hole) = (square(30, 24, 25), square(28, 22, 3));
    let around = move |x, y| main(x, y) && !hole(x, y);
    let mut phi = [level_set(around), level_set(hole)];
    let before = phi.clone();
    without_islands(&mut phi);
    assert_eq!(phi, before);
    // Nobody's, it is filled.
    let mut alone = [level_set(around), level_set(square(55, 40, 3))];
    without_islands(&mut alone);
    is(&alone[0], main);
    is(&alone[1], square(55, 40, 3));
}

#[test]
fn a_curve_in_one_piece_or_in_none_is_left_as_it_is() {
    // Not a distance on purpose: nothing is to be computed anew.
    let blob = Grid::from_fn(W, H, |x, y| {
        let (dx, dy) = (x as f32 - 30.0, y as f32 - 20.0);
        0.03 * (150.0 - dx * dx - 0.7 * dy * dy + 6.0 * (0.5 * dx).sin())
    });
    let mut phi = [blob.clone(), Grid::new(W, H, -3.0)];
    without_islands(&mut phi);
    let bits = |g: &Grid<f32>| g.map(f32::to_bits);
    assert_eq!(bits(&phi[0]), bits(&blob));
    assert!(phi[1].data().iter().all(|p| *p == -3.0));
}
