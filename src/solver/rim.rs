//! The rim of a region: pixels that another region's brightness reaches.
//!
//! Smoothing, derivatives and interpolation read brightness from two or three pixels around, and at a region's curve
//! some of it is another's, which moves otherwise. What is fitted there errs all along the curve to the same side:
//! depth falls off or rises towards it, and T turns. So in the end motion and depth are not fitted to the rim, and
//! smoothness carries depth on to the curve.

use crate::grid::Grid;

/// Its width, in pixels.
const WIDTH: f32 = 2.5;
/// Share of a region that its rim may be: what is thin has little else.
const MOST: f64 = 0.5;

/// The pixels of `owned` (> 0) within [`WIDTH`] of one that is not; none where they were more than [`MOST`] of it.
/// The frame's own border is no curve.
pub(super) fn rim(owned: &Grid<f32>) -> Option<Grid<bool>> {
    let (width, height) = (owned.width(), owned.height());
    let reach = WIDTH as i32;
    let across = -reach..=reach;
    let around: Vec<(i32, i32)> = across
        .clone()
        .flat_map(|dy| across.clone().map(move |dx| (dx, dy)))
        .filter(|&(dx, dy)| (dx as f32).hypot(dy as f32) <= WIDTH)
        .collect();
    let strange = |x: usize, y: usize, (dx, dy): (i32, i32)| {
        let place = x
            .checked_add_signed(dx as isize)
            .zip(y.checked_add_signed(dy as isize));
        place.is_some_and(|(x, y)| x < width && y < height && owned[(x, y)] <= 0.0)
    };
    let rim = Grid::from_fn(width, height, |x, y| {
        owned[(x, y)] > 0.0 && around.iter().any(|&by| strange(x, y, by))
    });
    let of_region = owned.data().iter().filter(|w| **w > 0.0).count();
    let of_rim = rim.data().iter().filter(|is| **is).count();
    (of_rim as f64 <= MOST * of_region as f64).then_some(rim)
}
