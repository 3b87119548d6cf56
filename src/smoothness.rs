//! The function g that smooths depth or bends surfaces, equations (11) and (12), and its diffusivity.
//!
//! ```text
//! (11)  g(r) = 2√(1+r²) − 2     g'(r)/r = 2/√(1+r²)     keeps depth edges
//! (12)  g(r) = r²               g'(r)/r = 2             blurs them
//! ```
//!
//! both of r/ε, so that μ g(‖∇Z‖/ε) is the smoothness term of (7). r is in depth per pixel. With q = (r/ε)² and
//! e = √(1+q) for (11) or 1 for (12) both are g = 2q/(1+e) and g'(r)/r = 2/e, without the cancellation at small r.

use crate::options::Diffusion;

/// μ g(r/ε), ready to be evaluated at many pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoothness {
    /// 1 for (11), 0 for (12).
    edge: f32,
    /// 1/ε².
    unit: f32,
    /// 2μ.
    weight: f32,
}

impl Smoothness {
    /// g of `diffusion` with μ in grey levels² and ε in depth per pixel.
    pub fn new(diffusion: Diffusion, mu: f64, epsilon: f64) -> Self {
        Self {
            edge: match diffusion {
                Diffusion::Anisotropic => 1.0,
                Diffusion::Isotropic => 0.0,
            },
            unit: epsilon.powi(-2) as f32,
            weight: (2.0 * mu) as f32,
        }
    }

    /// μ g(r/ε), in grey levels², and its diffusivity μ g'(r)/r, what ∇Z is multiplied with in the divergence of (9),
    /// for a squared gradient `r2` = r².
    #[inline]
    pub fn at(&self, r2: f32) -> (f32, f32) {
        let q = self.unit * r2;
        let e = (1.0 + self.edge * q).sqrt();
        // One division for two quotients.
        let both = (e * (1.0 + e)).recip();
        let (g, diffusivity) = (q * e * both, (1.0 + e) * both);
        (self.weight * g, self.weight * self.unit * diffusivity)
    }
}
