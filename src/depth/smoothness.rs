//! The function g that smooths depth, equations (11) and (12), and its diffusivity.
//!
//! ```text
//! (11)  g(r) = 2√(1+r²) − 2     g'(r)/r = 2/√(1+r²)     keeps depth edges
//! (12)  g(r) = r²               g'(r)/r = 2             blurs them
//! ```
//!
//! both of r/ε, so that μ g(‖∇Z‖/ε) is the smoothness term of (7). r is in depth per pixel.

use crate::options::Diffusion;

/// g(r/ε), weighted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoothness {
    /// Which g.
    pub diffusion: Diffusion,
    /// μ, in grey levels².
    pub mu: f64,
    /// ε, in depth per pixel.
    pub epsilon: f64,
}

impl Smoothness {
    /// μ g(r/ε) for a squared gradient `r2` = r².
    pub fn energy(&self, r2: f64) -> f64 {
        let q = r2 / (self.epsilon * self.epsilon);
        self.mu
            * match self.diffusion {
                // 2√(1+q) − 2 without the cancellation at small q.
                Diffusion::Anisotropic => 2.0 * q / ((1.0 + q).sqrt() + 1.0),
                Diffusion::Isotropic => q,
            }
    }

    /// μ g'(r)/r of g(r/ε): what ∇Z is multiplied with in the divergence of (9).
    pub fn diffusivity(&self, r2: f64) -> f64 {
        let e2 = self.epsilon * self.epsilon;
        let edge = match self.diffusion {
            Diffusion::Anisotropic => (1.0 + r2 / e2).sqrt(),
            Diffusion::Isotropic => 1.0,
        };
        2.0 * self.mu / (e2 * edge)
    }
}
