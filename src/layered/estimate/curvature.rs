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
use crate::smoothness::Smoothness;

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
    /// σ of the residual, grey levels.
    pub sigma: f32,
}

/// κ s², grey levels².
pub(super) fn pull(surface: &Surface, prior: &Prior) -> f32 {
    PULL * (prior.sigma * prior.sigma) * (surface.spacing * surface.spacing) as f32
}

impl Prior {
    /// What a second difference at control points so many pixels apart costs.
    pub(super) fn bending(&self, spacing: usize) -> Smoothness {
        let weight = self.mu * self.epsilon * self.epsilon;
        Smoothness::new(self.diffusion, weight, self.epsilon * spacing as f64)
    }
}

/// What curvature and distance from 1 cost, grey levels².
pub(crate) fn surface_energy(surface: &Surface, prior: &Prior) -> f64 {
    let bending = prior.bending(surface.spacing);
    let mut sum = 0.0;
    for_each_curvature(surface, |_, _, share, d| {
        sum += f64::from(share * bending.at(d * d).0);
    });
    let away: f32 = surface.rho.iter().map(|rho| (rho - 1.0).powi(2)).sum();
    sum + f64::from(pull(surface, prior) * away)
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
