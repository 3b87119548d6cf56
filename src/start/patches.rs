//! Where small patches go, by matching them from the coarsest scale to the one asked for.
//!
//! A patch of (2·[`HALF`]+1)² pixels around (x, y) is displaced by the w that minimises Σ (I2(x+w) − I1)²
//! (Lucas and Kanade 1981): w ← w − G⁻¹ Σ ∇I r with G = Σ ∇I ∇Iᵀ, at most [`STEPS`] times a scale or until
//! w moves by less than a hundredth of a pixel. G, over the residual's variance, is also how well each
//! direction of w is known: patches on a straight edge say little along it, and are not trusted there.

use super::scale::Scale;
use crate::grid::Grid;

/// Half the side of a patch, in pixels.
pub(super) const HALF: usize = 4;
/// Distance between the centres of neighbouring patches.
const SPACING: usize = 4;
/// Steps of matching a scale.
const STEPS: usize = 8;
/// Gradient that noise alone gives, grey levels per pixel: steadies G where there is no texture.
const FLAT: f32 = 1.0;

/// A patch that has been matched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Column of its centre.
    pub x: f32,
    /// Row of its centre.
    pub y: f32,
    /// Its displacement, in pixels.
    pub motion: [f32; 2],
    /// xx, xy and yy of the precision matrix of its displacement, pixels⁻².
    pub precision: [f32; 3],
}

/// Patches all over the frame at `scales[level]`, matched from the last (coarsest) scale on.
pub fn patches(scales: &[Scale], level: usize) -> Vec<Patch> {
    let scale = &scales[level];
    let (width, height) = (scale.width(), scale.height());
    let mut found = Vec::new();
    for y in (HALF..height.saturating_sub(HALF)).step_by(SPACING) {
        for x in (HALF..width.saturating_sub(HALF)).step_by(SPACING) {
            found.extend(follow(scales, level, x as f32, y as f32));
        }
    }
    found
}

fn follow(scales: &[Scale], level: usize, x: f32, y: f32) -> Option<Patch> {
    let mut motion = [0.0f32; 2];
    let mut patch = None;
    for finer in (level..scales.len()).rev() {
        let shrink = (1 << (finer - level)) as f32;
        // Centres of coarse pixels lie between fine ones.
        let (px, py) = ((x + 0.5) / shrink - 0.5, (y + 0.5) / shrink - 0.5);
        if finer + 1 < scales.len() {
            motion = motion.map(|m| 2.0 * m);
        }
        patch = place(&scales[finer], px, py, &mut motion);
        if !motion.iter().all(|m| m.is_finite()) {
            return None;
        }
    }
    patch.map(|precision| Patch {
        x,
        y,
        motion,
        precision,
    })
}

/// Matches one patch at one scale; returns the precision of what it finds, `None` off the frame.
fn place(scale: &Scale, px: f32, py: f32, motion: &mut [f32; 2]) -> Option<[f32; 3]> {
    let half = HALF as isize;
    let size = ((2 * half + 1) * (2 * half + 1)) as f32;
    let (mut g, mut sum) = ([0.0f32; 3], 0.0);
    let start = *motion;
    for _ in 0..STEPS {
        g = [size * FLAT, 0.0, size * FLAT];
        let mut b = [0.0f32; 2];
        sum = 0.0;
        for j in -half..=half {
            for i in -half..=half {
                let (x, y) = (px + i as f32, py + j as f32);
                let (r, ix, iy) = sample(scale, x, y, motion);
                g[0] += ix * ix;
                g[1] += ix * iy;
                g[2] += iy * iy;
                b[0] += ix * r;
                b[1] += iy * r;
                sum += r * r;
            }
        }
        let det = g[0] * g[2] - g[1] * g[1];
        let step = [
            (g[2] * b[0] - g[1] * b[1]) / det,
            (g[0] * b[1] - g[1] * b[0]) / det,
        ];
        for k in 0..2 {
            motion[k] -= step[k].clamp(-1.0, 1.0);
            // No scale is trusted with more than the next coarser one could have left over.
            motion[k] = motion[k].clamp(start[k] - 3.0, start[k] + 3.0);
        }
        if step[0].abs().max(step[1].abs()) < 0.01 {
            break;
        }
    }
    let at = [px + motion[0], py + motion[1]];
    let within = at[0] >= 0.0
        && at[1] >= 0.0
        && at[0] <= (scale.width() - 1) as f32
        && at[1] <= (scale.height() - 1) as f32;
    let variance = 1.0 + sum / size;
    within.then(|| g.map(|g| g / variance))
}

fn sample(scale: &Scale, x: f32, y: f32, motion: &[f32; 2]) -> (f32, f32, f32) {
    let read = |grid: &Grid<f32>, x, y| grid.bilinear(x, y);
    let (qx, qy) = (x + motion[0], y + motion[1]);
    let r = read(&scale.second, qx, qy) - read(&scale.first, x, y);
    let (first, second) = (&scale.first_gradient, &scale.second_gradient);
    (
        r,
        0.5 * (read(&first.0, x, y) + read(&second.0, qx, qy)),
        0.5 * (read(&first.1, x, y) + read(&second.1, qx, qy)),
    )
}
