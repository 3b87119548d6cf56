//! Where outlines are cheap: the length of a curve weighed by the picture under it.
//!
//! ```text
//! Σ_{k≥1} ∮_γk λ g ds        g of frames/edges.rs, 0 on a sharp edge, 2 where brightness is level
//! ```
//!
//! Geodesic active contours (Caselles, Kimmel and Sapiro 1997). Where two regions explain a pixel alike, as on a
//! dark side or a bare wall, motion leaves open where one ends; there a curve comes to rest on an edge of
//! brightness rather than where it is shortest.

use crate::frames::edge_weight;
use crate::grid::Grid;

/// How clear of noise an edge has to be: no more than as steep, since λ grows with noise as well.
const CLEAR: f64 = 1.0;

/// λ g: what a pixel of curve costs at every place of a picture. `sigma` is the standard deviation of a
/// residual, in grey levels.
pub fn outline_cost(picture: &Grid<f32>, sigma: f64, lambda: f64) -> Grid<f32> {
    edge_weight(picture, sigma, CLEAR).map(|g| lambda as f32 * g)
}
