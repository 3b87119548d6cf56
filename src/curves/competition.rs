//! What regions compete with for a pixel: ξk, their residuals in units of their own uncertainty.
//!
//! ```text
//! q = r² / (σ² + (δ‖∇I‖)²)      ξ = σ² τ² q / (τ² + q)
//! ```
//!
//! r in grey levels, σ its noise, δ the error of position that a hypothesis is granted: without it
//! strong texture out-votes weak. ξ saturates at τ²σ², so that one bad pixel does not decide for its
//! neighbours. A hypothesis that takes a pixel out of the frame is neither confirmed nor refuted and
//! pays what a point without counterpart pays.

use crate::grid::Grid;
use crate::warp::{Linearisation, RESIDUAL};

/// δ, in pixels.
const POSITION_ERROR: f32 = 0.25;
/// τ, in standard deviations.
const SATURATION: f32 = 4.0;
/// What a pixel without counterpart pays, in variances.
const UNSEEN: f32 = 3.0;

/// q of pixel `i`: its squared residual in units of its variance.
pub fn misfit(linearisation: &Linearisation, i: usize, sigma: f64, normalised: bool) -> f32 {
    let r = linearisation.rows.data()[i][RESIDUAL];
    let mut variance = (sigma * sigma) as f32;
    if normalised {
        let [ix, iy] = linearisation.gradient.data()[i];
        variance += POSITION_ERROR * POSITION_ERROR * (ix * ix + iy * iy);
    }
    r * r / variance
}

/// ξ of a hypothesis that a pixel refutes altogether, grey levels².
pub fn refuted(sigma: f64) -> f32 {
    (sigma * sigma) as f32 * SATURATION * SATURATION
}

/// ξ of one region at every pixel of its window, grey levels².
pub fn residual_in_units(linearisation: &Linearisation, sigma: f64, normalised: bool) -> Grid<f32> {
    let variance = (sigma * sigma) as f32;
    let (width, height) = (linearisation.rows.width(), linearisation.rows.height());
    let mut xi = Grid::new(width, height, UNSEEN * variance);
    for (i, xi) in xi.data_mut().iter_mut().enumerate() {
        if linearisation.inside.data()[i] {
            let q = misfit(linearisation, i, sigma, normalised);
            *xi = variance * q * SATURATION * SATURATION / (SATURATION * SATURATION + q);
        }
    }
    xi
}
