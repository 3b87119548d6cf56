//! What is expected of a quantity known here and there.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::Grid;
use relievo::depth::local_line;
use relievo::frames::blur;

const SIZE: (usize, usize) = (81, 67);
const MIDDLE: (f32, f32) = (40.0, 33.0);
const RADIUS: f32 = 25.0;
const REACH: f64 = 6.0;

/// Pixels from a disc's edge inwards.
fn inward(x: usize, y: usize) -> f32 {
    RADIUS - (x as f32 - MIDDLE.0).hypot(y as f32 - MIDDLE.1)
}

/// What is expected of `value`, known in the disc.
fn expected(value: impl Fn(usize, usize) -> f32) -> Grid<f32> {
    let known = |x: usize, y: usize| f32::from(inward(x, y) >= 0.0);
    let weight = Grid::from_fn(SIZE.0, SIZE.1, known);
    let weighted = Grid::from_fn(SIZE.0, SIZE.1, |x, y| known(x, y) * value(x, y));
    local_line(&weight, &weighted, REACH)
}

fn everywhere() -> impl Iterator<Item = (usize, usize)> {
    (0..SIZE.0 * SIZE.1).map(|i| (i % SIZE.0, i / SIZE.0))
}

#[test]
fn what_changes_evenly_is_expected_where_a_mean_lags_behind() {
    let value = |x: usize, y: usize| 0.05 * (x as f32 - MIDDLE.0) - 0.03 * (y as f32 - MIDDLE.1);
    let line = expected(value);
    let known = |x: usize, y: usize| f32::from(inward(x, y) >= 0.0);
    let blurred = |f: &dyn Fn(usize, usize) -> f32| blur(&Grid::from_fn(SIZE.0, SIZE.1, f), REACH);
    let (sum, count) = (blurred(&|x, y| known(x, y) * value(x, y)), blurred(&known));
    let mut off = [0.0f32; 2];
    for (x, y) in everywhere().filter(|&(x, y)| inward(x, y) >= 3.0) {
        let at = (x, y);
        for (off, m) in off.iter_mut().zip([line[at], sum[at] / (count[at] + 0.05)]) {
            *off += (m - value(x, y)).powi(2);
        }
    }
    assert!(off[0] < 0.8 * off[1], "squares of {off:?}");
}

#[test]
fn where_little_is_known_nothing_is_expected() {
    let value = |_, _| 3.0;
    let found = expected(value);
    for (x, y) in everywhere() {
        let (at, inward) = (found[(x, y)], inward(x, y));
        assert!((-0.1..3.1).contains(&at), "{at} at {inward}");
        if inward > 8.0 {
            assert!((at - 3.0).abs() < 0.2, "{at} at {inward}");
        }
    }
    let corner = found[(0, 0)];
    assert!(corner.abs() < 0.05, "{corner} far away");
    assert!(expected(|_, _| 0.0).data().iter().all(|m| *m == 0.0));
}

#[test]
fn frames_of_any_side_do() {
    for (width, height) in [(1, 1), (1, 7), (8, 2), (31, 30)] {
        let weight = Grid::new(width, height, 1.0f32);
        let found = local_line(&weight, &weight, REACH);
        assert_eq!((found.width(), found.height()), (width, height));
        assert!(found.data().iter().all(|m| (0.0..1.1).contains(m)));
    }
}
