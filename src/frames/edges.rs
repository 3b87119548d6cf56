//! How far a pixel lies on an edge of brightness.
//!
//! ```text
//! g = 2 / ( 1 + ‖∇I‖² / m ),    m = Gw * ‖∇I‖² + n
//! ```
//!
//! An edge is what is steep for its surroundings, m, so that faint ones count in faint places: g is 1 where a
//! pixel is as steep as they are, 2 where it is level, and falls to 0 on a sharp edge. It has no unit and does not
//! change when brightness is scaled. n is noise's share of ‖∇I‖², times the
//! square of how clear of noise an edge has to be.

use super::{blur, gradient};
use crate::grid::Grid;

/// Standard deviation of the Gaussian before the gradient, in pixels.
const SMOOTHING: f64 = 1.0;
/// Standard deviation of w, the surroundings, in pixels.
const SURROUNDINGS: f64 = 8.0;
/// n/σ²: white noise smoothed so has gradients of the variance σ²/8π in each direction, and σ, a
/// residual's, is that of two frames.
const OF_NOISE: f64 = 0.04;

/// g at every pixel of a picture, from 0 to 2; `sigma` is the standard deviation of a residual between two
/// such pictures, in grey levels. What is less steep than `clear` times noise's gradient is no edge.
pub fn edge_weight(picture: &Grid<f32>, sigma: f64, clear: f64) -> Grid<f32> {
    let Steepness { along, around } = Steepness::of(picture, sigma, clear);
    let [ix2, iy2] = along;
    Grid::from_fn(picture.width(), picture.height(), |x, y| {
        let at = (x, y);
        2.0 / (1.0 + (ix2[at] + iy2[at]) / around[at])
    })
}

/// The same for edges that are crossed by going right, and by going down: ‖∇I‖² gives way to twice the part of
/// it that lies in that direction.
pub fn edge_weights_across(picture: &Grid<f32>, sigma: f64, clear: f64) -> [Grid<f32>; 2] {
    let Steepness { along, around } = Steepness::of(picture, sigma, clear);
    along.map(|mut g| {
        for (g, around) in g.data_mut().iter_mut().zip(around.data()) {
            *g = 2.0 / (1.0 + 2.0 * *g / around);
        }
        g
    })
}

/// ‖∇I‖² in parts, and m.
struct Steepness {
    /// (∂I/∂x)² and (∂I/∂y)².
    along: [Grid<f32>; 2],
    around: Grid<f32>,
}

impl Steepness {
    fn of(picture: &Grid<f32>, sigma: f64, clear: f64) -> Self {
        let (ix, iy) = gradient(&blur(picture, SMOOTHING));
        let along = [ix, iy].map(|d| d.map(|d| d * d));
        let mut both = along[0].clone();
        for (both, iy2) in both.data_mut().iter_mut().zip(along[1].data()) {
            *both += iy2;
        }
        let noise = (OF_NOISE * (clear * sigma).powi(2)).max(1e-6) as f32;
        Self {
            along,
            around: blur(&both, SURROUNDINGS).map(|m| m + noise),
        }
    }
}
