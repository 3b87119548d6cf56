//! Where depth may step: ε of (11), less across edges of brightness.
//!
//! ```text
//! g'(r)/r ∝ 1 / √( 1 + r²/(s ε)² )        s = min(1, g)⁴,  g of frames/edges.rs
//! ```
//!
//! A gentle bend costs the same everywhere; a step costs the share s of what it costs where brightness is level,
//! so that what is stiff enough to average noise away still breaks where one thing stands before another
//! (compare Nagel and Enkelmann 1986). s belongs to a pair of neighbours and reads brightness in their direction:
//! depth steps across an edge and stays smooth along it, so that no pixel is on its own. It has no unit.

use crate::frames::edge_weights_across;
use crate::grid::Grid;

/// How clear of noise an edge has to be: depth would follow noise along false ones.
const CLEAR: f64 = 4.0;
/// Least s: some stiffness is left.
const LEAST: f32 = 0.002;

/// s between each pixel of a picture and the next to the right, and the next below, up to 1, and 1 where either is
/// not `owned`. `sigma` is the standard deviation of a residual, in grey levels.
pub fn creases(picture: &Grid<f32>, sigma: f64, owned: &Grid<f32>) -> [Grid<f32>; 2] {
    let [right, down] = edge_weights_across(picture, sigma, CLEAR);
    let (width, height) = (picture.width(), picture.height());
    let between = |g: &Grid<f32>, ahead: (usize, usize)| {
        Grid::from_fn(width, height, |x, y| {
            let (at, next) = ((x, y), (x + ahead.0, y + ahead.1));
            if next.0 < width && next.1 < height && owned[at].min(owned[next]) >= 1.0 {
                (0.5 * (g[at] + g[next])).min(1.0).powi(4).max(LEAST)
            } else {
                1.0
            }
        })
    };
    [between(&right, (1, 0)), between(&down, (0, 1))]
}
