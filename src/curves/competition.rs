//! What regions compete with for a pixel: ξk, their residuals in units of their own uncertainty.
//!
//! ```text
//! q  = r² / (σ² + (δ‖∇I‖)²)            qg = ½ ‖∇I2(x+w) − ∇I1‖² / (σg² + ½ (δ‖∇∇I‖)²)
//! ξ  = σ² ( sat q + sat qg ) / 2       sat q = τ² q / (τ² + q)
//! ```
//!
//! r in grey levels, σ its noise, σg that of the gradient's change, δ the error of position that a hypothesis
//! is granted: without it strong texture out-votes weak. The gradient tells texture from a change of light.
//! ξ saturates at τ²σ², so that one bad pixel does not decide for its neighbours. A hypothesis that takes a
//! pixel out of the frame is neither confirmed nor refuted and pays what a point without counterpart pays.

use crate::grid::Grid;
use crate::occlusion::HIDDEN;
use crate::warp::{Linearisation, RESIDUAL, Scale};

/// δ, in pixels.
const POSITION_ERROR: f32 = 0.25;
/// τ, in standard deviations.
const SATURATION: f32 = 4.0;

/// What a hypothesis is measured by.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// σ, grey levels.
    pub sigma: f64,
    /// σg, grey levels per pixel; `None` leaves gradients out.
    pub gradient_sigma: Option<f64>,
    /// Whether an error of position is granted.
    pub normalised: bool,
}

impl Measure {
    /// q of pixel `i`: its squared residual in units of its variance.
    fn brightness(&self, line: &Linearisation, i: usize) -> f32 {
        let r = line.rows.data()[i][RESIDUAL];
        let [ix, iy] = line.gradient.data()[i];
        let variance = (self.sigma * self.sigma) as f32;
        r * r / (variance + self.granted(ix * ix + iy * iy))
    }

    /// qg of pixel `i`.
    fn gradient(&self, line: &Linearisation, scale: &Scale, i: usize, sigma: f64) -> f32 {
        let [gx, gy] = line.gradient_change(scale, i);
        let bend = scale.bend[line.window.place(i)];
        0.5 * (gx * gx + gy * gy) / ((sigma * sigma) as f32 + 0.5 * self.granted(bend))
    }

    fn granted(&self, steepness2: f32) -> f32 {
        if self.normalised {
            POSITION_ERROR * POSITION_ERROR * steepness2
        } else {
            0.0
        }
    }

    /// ξ of a hypothesis that a pixel refutes altogether, grey levels².
    pub fn refuted(&self) -> f32 {
        (self.sigma * self.sigma) as f32 * SATURATION * SATURATION
    }

    /// What a pixel without counterpart pays, grey levels².
    pub fn hidden(&self) -> f32 {
        (self.sigma * self.sigma) as f32 * HIDDEN
    }

    /// ξ of one region at every pixel of its window, grey levels².
    pub fn residual_in_units(&self, line: &Linearisation, scale: &Scale) -> Grid<f32> {
        let variance = (self.sigma * self.sigma) as f32;
        let sat = |q: f32| q * SATURATION * SATURATION / (SATURATION * SATURATION + q);
        let mut xi = Grid::new(line.window.width, line.window.height, self.hidden());
        for (i, xi) in xi.data_mut().iter_mut().enumerate() {
            if line.inside.data()[i] {
                let q = sat(self.brightness(line, i));
                *xi = variance
                    * self.gradient_sigma.map_or(q, |sigma| {
                        0.5 * (q + sat(self.gradient(line, scale, i, sigma)))
                    });
            }
        }
        xi
    }
}
