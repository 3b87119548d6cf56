//! What a region is fitted to: its pixels at one scale, and how much each of them counts.
//!
//! A residual r has the variance v = σ² + (δ‖∇I‖)², δ the error of position that a fit is granted, and
//! counts with the weight σ²/v, less where r is large: ω = σ²/v · (1 + r²/(c² v))^(−½), Charbonnier's.

use crate::grid::Grid;
use crate::warp::{Linearisation, RESIDUAL, Scale};

/// Error of position granted when motion and depth are fitted, in pixels.
const POSITION_ERROR: f32 = 0.06;
/// Residuals of this many standard deviations count half as much as in least squares.
const ROBUST: f32 = 2.0;
/// Standard deviation of f·ω known beforehand, in pixels at the finest scale's width of 320.
const ROTATION_SPREAD: f64 = 8.0;
/// Longest step of f T and of f ω, in pixels.
const LONGEST_STEP: f64 = 2.0;

/// What a region is fitted to.
pub(super) struct Evidence<'a> {
    pub scale: &'a Scale,
    /// 1 where the region owns the pixel and it is seen in both frames, else 0.
    pub owned: &'a Grid<f32>,
    /// Standard deviation of the residual, grey levels.
    pub sigma: f64,
    pub robust: bool,
}

impl Evidence<'_> {
    /// ω_i, in units in which the residual's variance is σ².
    pub fn weights(&self, linearisation: &Linearisation) -> Grid<f32> {
        let variance = (self.sigma * self.sigma) as f32;
        let mut weight = self.owned.clone();
        for (i, w) in weight.data_mut().iter_mut().enumerate() {
            if !linearisation.inside.data()[i] {
                *w = 0.0;
            } else if *w > 0.0 {
                let [ix, iy] = linearisation.gradient.data()[i];
                let position = POSITION_ERROR * POSITION_ERROR * (ix * ix + iy * iy);
                let own = variance + position;
                *w *= variance / own;
                if self.robust {
                    let r = linearisation.rows.data()[i][RESIDUAL];
                    *w /= (1.0 + r * r / (ROBUST * ROBUST * own)).sqrt();
                }
            }
        }
        weight
    }

    /// Robust χ² of pixel `i`.
    pub fn misfit(&self, linearisation: &Linearisation, i: usize) -> f64 {
        let [ix, iy] = linearisation.gradient.data()[i];
        let r = linearisation.rows.data()[i][RESIDUAL];
        let variance = (self.sigma * self.sigma) as f32;
        let position = POSITION_ERROR * POSITION_ERROR * (ix * ix + iy * iy);
        let q = f64::from(r * r / (variance + position));
        let scale = f64::from(ROBUST * ROBUST);
        2.0 * scale * ((1.0 + q / scale).sqrt() - 1.0)
    }

    /// Longest step of T and of ω.
    pub fn longest(&self) -> f64 {
        LONGEST_STEP / self.scale.camera.focal
    }

    /// Precision of ω, times the noise's variance.
    pub fn rotation_prior(&self) -> f64 {
        let f = self.scale.camera.focal;
        let spread = ROTATION_SPREAD * self.scale.width() as f64 / 320.0;
        (self.sigma * f / spread).powi(2)
    }
}
