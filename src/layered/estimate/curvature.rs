//! What a surface's curvature costs.
//!
//! ```text
//! E = μ Σ (ε s)² g(d / (ε s)) / s²  +  κ Σ s² (ρ − 1)²
//! ```
//!
//! d are the second differences of ρ at control points s pixels apart, g that of (11), 2√(1+r²) − 2, or of (12), r²: planes
//! cost nothing. The second sum holds what nothing is seen of.

use super::surface::Surface;
use crate::options::Diffusion;

/// κ: pull of ρ towards 1, in variances of the residual for a pixel.
const PULL: f32 = 1e-4;

/// What is charged for curvature.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prior {
    /// μ, grey levels²·px².
    pub mu: f64,
    pub diffusion: Diffusion,
    /// ε of g(r/ε), change of slope per control point, 1/px.
    pub epsilon: f64,
}

/// κ s², grey levels².
pub(super) fn pull(surface: &Surface, variance: f32) -> f32 {
    PULL * variance * (surface.spacing * surface.spacing) as f32
}

/// What curvature and distance from 1 cost, grey levels².
pub(crate) fn surface_energy(surface: &Surface, prior: &Prior, sigma: f32) -> f64 {
    let s = surface.spacing as f32;
    let edge = prior.epsilon as f32 * s;
    let mut sum = 0.0;
    for_each_curvature(surface, |_, _, share, d| {
        let square = match prior.diffusion {
            Diffusion::Isotropic => d * d,
            Diffusion::Anisotropic => 2.0 * edge * edge * ((1.0 + (d / edge).powi(2)).sqrt() - 1.0),
        };
        sum += f64::from(share * square);
    });
    let pull = pull(surface, sigma * sigma);
    let away: f32 = surface.rho.iter().map(|rho| (rho - 1.0).powi(2)).sum();
    prior.mu / f64::from(s * s) * sum + f64::from(pull * away)
}

/// Half the derivative of what a second difference costs, over it.
pub(super) fn curvature_weight(d: f32, spacing: usize, prior: &Prior) -> f32 {
    let s = spacing as f32;
    let mu = prior.mu as f32 / (s * s);
    match prior.diffusion {
        Diffusion::Isotropic => mu,
        Diffusion::Anisotropic => mu / (1.0 + (d / (prior.epsilon as f32 * s)).powi(2)).sqrt(),
    }
}

/// Calls with the control points, factors, share and value of each second difference: ρ_xx, ρ_yy and, twice, ρ_xy.
pub(super) fn for_each_curvature(
    surface: &Surface,
    mut each: impl FnMut(&[usize], &[f32], f32, f32),
) {
    let mut call = |nodes: &[usize], factors: &[f32], share| {
        let terms = nodes.iter().zip(factors);
        let d = terms.map(|(&n, f)| f * surface.rho[n]).sum();
        each(nodes, factors, share, d);
    };
    let node = |i, j| surface.node(i, j);
    for i in 0..surface.columns {
        for j in 0..surface.rows {
            if i > 0 && i + 1 < surface.columns {
                let three = [node(i - 1, j), node(i, j), node(i + 1, j)];
                call(&three, &[1.0, -2.0, 1.0], 1.0);
            }
            if j > 0 && j + 1 < surface.rows {
                let three = [node(i, j - 1), node(i, j), node(i, j + 1)];
                call(&three, &[1.0, -2.0, 1.0], 1.0);
            }
            if i + 1 < surface.columns && j + 1 < surface.rows {
                call(&surface.corners(i, j), &[1.0, -1.0, -1.0, 1.0], 2.0);
            }
        }
    }
}
