//! A whole frame of a stage, as a camera would record it.
//!
//! It is sampled 3×3 times per pixel on a regular lattice and filtered by a tent two pixels
//! wide (weights 1 2 3 2 1 each way, shared between neighbours), in linear light, then encoded as
//! sRGB and rounded to whole numbers as a PNG would.

use glam::DVec3;

use super::cast::Caster;
use crate::srgb;

/// Samples per pixel, each way.
pub(super) const FINE: usize = 3;

impl Caster<'_> {
    /// The whole picture, sRGB 0–255 in whole numbers.
    pub fn picture(&self, width: usize, height: usize) -> Vec<[f32; 3]> {
        const TENT: [f64; 2 * FINE - 1] = [1.0, 2.0, 3.0, 2.0, 1.0];
        let step = 1.0 / FINE as f64;
        // One fine row beyond the frame on each side, all filtered along x at once, summed along y.
        let mut out = vec![DVec3::ZERO; width * height];
        let mut fine = vec![DVec3::ZERO; (width + 2) * FINE];
        let lead = FINE as isize;
        // Rows from the bottom up: terrain recedes along them, so that what the row below met, less a
        // fiftieth for the columns' slant, bounds what this one can meet.
        let mut below = vec![0.0; fine.len()];
        for j in (-1..=(height * FINE) as isize).rev() {
            let y = (j as f64 - 1.0) * step;
            let mut left = f64::INFINITY;
            for (i, sample) in fine.iter_mut().enumerate() {
                let x = (i as isize - lead - 1) as f64 * step;
                let right = below.get(i + 1).copied().unwrap_or(f64::INFINITY);
                let from = 0.98 * below[i].min(left).min(right);
                left = below[i];
                let lattice = i % FINE + FINE * (j + lead) as usize % (FINE * FINE);
                let seen = self.look_beyond(x, y, from);
                below[i] = seen.depth;
                *sample = self.colour(x, y, &seen, lattice);
            }
            for (k, weight) in TENT.iter().enumerate() {
                // Row y of pixels has its centre at fine row 3y + 1.
                let centre = j - (k as isize - 2);
                let row = (centre - 1).div_euclid(lead);
                if (centre - 1).rem_euclid(lead) != 0 || row < 0 || row >= height as isize {
                    continue;
                }
                let row = row as usize * width;
                for (x, pixel) in out[row..row + width].iter_mut().enumerate() {
                    let first = x * FINE + FINE - 1;
                    let mut sum = DVec3::ZERO;
                    for (s, w) in fine[first..first + TENT.len()].iter().zip(TENT) {
                        sum += *s * w;
                    }
                    *pixel += sum * (weight / 81.0);
                }
            }
        }
        out.iter().map(|&c| encode(c)).collect()
    }
}

/// Linear light as sRGB 0–255, in whole numbers.
fn encode(linear: DVec3) -> [f32; 3] {
    linear
        .to_array()
        .map(|c| (255.0 * srgb::encode(c)).round() as f32)
}
