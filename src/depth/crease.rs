//! Where depth may step: ε of (11), less on edges of brightness.
//!
//! ```text
//! g'(r)/r ∝ 1 / √( 1 + r²/(s ε)² )        s = min(1, g)³,  g of frames/edges.rs
//! ```
//!
//! A gentle bend costs the same everywhere; a step costs the share s of what it costs where brightness is level,
//! so that what is stiff enough to average noise away still breaks where one thing stands before another
//! (compare Nagel and Enkelmann 1986). s has no unit.

use crate::frames::edge_weight;
use crate::grid::Grid;

/// How clear of noise an edge has to be: depth would follow noise along false ones.
const CLEAR: f64 = 4.0;
/// Least s: some stiffness is left, or single pixels would stand out.
const LEAST: f32 = 0.01;

/// s at every pixel of a picture, up to 1; `sigma` is the standard deviation of a residual, in grey levels.
pub fn creases(picture: &Grid<f32>, sigma: f64) -> Grid<f32> {
    edge_weight(picture, sigma, CLEAR).map(|g| g.min(1.0).powi(3).max(LEAST))
}
