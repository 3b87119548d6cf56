//! The functional (7), term by term:
//!
//! ```text
//! (7)  E = Σk ∫_Rk [ ψk² + μ g(‖∇Z‖) ] dx + λ Σ_{k≥1} ∮_γk ds
//! ```
//!
//! in grey levels² (a pixel being the unit of area).

use serde::Serialize;

/// The three terms of (7).
///
/// ```
/// use relievo::energy::Energy;
///
/// let energy = Energy { data: 900.0, smoothness: 80.0, length: 20.0 };
/// assert_eq!(energy.total(), 1000.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Energy {
    /// Σ ∫ ψ².
    pub data: f64,
    /// μ Σ ∫ g(‖∇Z‖).
    pub smoothness: f64,
    /// λ Σ ∮ ds.
    pub length: f64,
}

impl Energy {
    /// E.
    pub fn total(&self) -> f64 {
        self.data + self.smoothness + self.length
    }
}
