//! One Gauss–Newton step of T and ω with depth eliminated.
//!
//! In each block of 4×4 pixels ρ may change by one number δ. With a = ∂e/∂ρ, b = (∂e/∂T along the two directions across
//! T, ∂e/∂ω) and m = Σ w (a, b, e)(a, b, e)ᵀ,
//!
//! ```text
//! Σ_blocks (m_bb − m_ba m_ab/m_aa) step = −Σ_blocks (m_be − m_ba m_ae/m_aa)
//! ```
//!
//! |T| stays. Turns of T and ω are in radians; a step is at most 0.05. w = 1/(σ² (1 + e²/4σ²)²).

use glam::DVec3;

use super::linearisation::Linearisation;
use crate::camera::{RigidMotion, omega, turn};
use crate::grid::Grid;
use crate::layered::view::View;
use crate::linalg::{solve, tangents};

/// Side of a block in pixels.
const BLOCK: usize = 4;
/// Largest step.
const LARGEST: f64 = 0.05;

/// Steps `motion`, and takes what that explains from the residuals of `compared`.
pub fn motion_step(
    compared: &mut Linearisation,
    view: &View,
    rho: &Grid<f32>,
    sigma: f32,
    motion: &mut RigidMotion,
) {
    let (width, height) = (rho.width(), rho.height());
    let length = motion.translation.length();
    if length <= 0.0 {
        return;
    }
    let bases = tangents(motion.translation / length).map(|b| b * length);
    let single = bases.map(|b| b.to_array().map(|v| v as f32));
    // ∂e/∂ρ, ∂e/∂T along both bases, ∂e/∂ω.
    let derivatives = |g: [f32; 3], p: [f32; 3], rho: f32| -> [f32; 6] {
        let dot = |a: [f32; 3]| a[0] * g[0] + a[1] * g[1] + a[2] * g[2];
        [
            dot(view.translation),
            rho * dot(single[0]),
            rho * dot(single[1]),
            p[1] * g[2] - p[2] * g[1],
            p[2] * g[0] - p[0] * g[2],
            p[0] * g[1] - p[1] * g[0],
        ]
    };
    let mut normal = [[0.0f64; 6]; 6];
    for top in (0..height).step_by(BLOCK) {
        for left in (0..width).step_by(BLOCK) {
            let mut m = [[0.0f32; 7]; 7];
            for y in top..(top + BLOCK).min(height) {
                for x in left..(left + BLOCK).min(width) {
                    let i = y * width + x;
                    if compared.compared[i] {
                        let e = compared.residual[i];
                        let j = derivatives(compared.gradient[i], view.turned(x, y), rho.data()[i]);
                        add(&mut m, j, e, sigma);
                    }
                }
            }
            if m[0][0] > 0.0 {
                let inverse = 1.0 / (m[0][0] * 1.001 + 1e-6);
                for k in 1..7 {
                    for l in 1..=k {
                        normal[k - 1][l - 1] += f64::from(m[k][l] - m[k][0] * m[l][0] * inverse);
                    }
                }
            }
        }
    }
    let mut matrix = [[0.0; 5]; 5];
    for k in 0..5 {
        matrix[k].copy_from_slice(&normal[k][..5]);
        matrix[k][k] = matrix[k][k] * 1.0001 + 1e-6;
    }
    let right = std::array::from_fn(|k| -normal[5][k]);
    let Some(step) = solve::<5>(&matrix, &right) else {
        return;
    };
    let largest = step.iter().fold(LARGEST, |most, s| most.max(s.abs()));
    let step = step.map(|s| s * LARGEST / largest);
    for y in 0..height {
        for x in 0..width {
            let i = y * width + x;
            if compared.compared[i] {
                let j = derivatives(compared.gradient[i], view.turned(x, y), rho.data()[i]);
                let change = (0..5).map(|k| j[k + 1] * step[k] as f32).sum::<f32>();
                compared.residual[i] += change;
            }
        }
    }
    let across = bases[0] * step[0] + bases[1] * step[1];
    motion.translation = (motion.translation + across).normalize() * length;
    let turned = turn(DVec3::new(step[2], step[3], step[4])) * motion.matrix();
    motion.rotation = omega(&turned);
}

/// Adds a pixel to the lower triangle of its block.
fn add(m: &mut [[f32; 7]; 7], j: [f32; 6], e: f32, sigma: f32) {
    let weight = 1.0 / (1.0 + e * e / (4.0 * sigma * sigma));
    let weight = weight * weight / (sigma * sigma);
    let j = [j[0], j[1], j[2], j[3], j[4], j[5], e];
    for k in 0..7 {
        let w = weight * j[k];
        for l in 0..=k {
            m[k][l] += w * j[l];
        }
    }
}

#[cfg(test)]
mod tests;
