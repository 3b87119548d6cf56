//! The weights of (7), as they are reported.

use serde::Serialize;

/// The weights in force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Weights {
    /// μ of (7): grey levels² under `paper`, grey levels²·px² under `best`, which charges curvature.
    pub mu: f64,
    /// λ of (7), grey levels²·px.
    pub lambda: f64,
    /// σ of the residual that they were chosen from, grey levels; 0 before the first motion step.
    pub sigma: f64,
}
