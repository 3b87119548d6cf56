//! How far depth shows at a pixel: 0 not at all, 1 fully.
//!
//! ψ = a ρ + b with a = s·T, so that the pixels around one tell its ρ with the precision
//! P = Σ a²/σ², here over a Gaussian window of [`WINDOW`] pixels, the reach of smoothing. The confidence is
//!
//! ```text
//! 1 / (1 + (δ/δ0)²),   δ = 1/√P the standard deviation of ρ, in units in which the region's mean ρ is 1
//! ```
//!
//! It is 0 where T = 0 or nothing has texture, and ½ where ρ is known to within [`HALF`]. Noise has slopes of its own:
//! whoever knows how steep takes them off a².

use crate::frames::blur;
use crate::grid::Grid;

/// Standard deviation of the window, in pixels.
const WINDOW: f64 = 2.5;
/// δ0.
const HALF: f64 = 0.15;

/// Confidence from `squares`, a² at every pixel (0 where depth cannot show) less what noise alone leaves of it, and the
/// residual's σ.
pub fn confidence(squares: &Grid<f32>, sigma: f64) -> Grid<f32> {
    let pixels = 4.0 * std::f64::consts::PI * WINDOW * WINDOW;
    let scale = (pixels * HALF * HALF / (sigma * sigma)) as f32;
    blur(squares, WINDOW).map(|mean| {
        let gain = scale * mean.max(0.0);
        gain / (1.0 + gain)
    })
}
