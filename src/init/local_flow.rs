//! The flow around a match, affine and robust: what its neighbours agree on with it.
//!
//! ```text
//! d(x) = d₀ + A (x − x₀),     minimise Σ w |d(x_i) − d_i|²,     w = 1/(1 + r²/s²)²
//! ```
//!
//! over the matches within three places of the lattice. It starts from the match's own displacement, so that of two
//! motions in a window its own is followed. Pixels.

use glam::DVec2;

use super::lattice::Lattice;
use super::sample::Sample;
use crate::linalg::solve;

/// Half of the window, in places of the lattice.
const REACH: isize = 3;
/// s in pixels, one an iteration.
const SCALES: [f64; 3] = [0.6, 0.3, 0.3];
/// What keeps A small where it is not determined, in matches at a pixel's distance.
const RIDGE: f64 = 30.0;

/// A displacement and its derivatives, at a match.
#[derive(Clone, Copy, Debug)]
pub struct LocalFlow {
    at: DVec2,
    middle: DVec2,
    /// ∂d/∂x and ∂d/∂y.
    slopes: [DVec2; 2],
}

impl LocalFlow {
    /// Around match `k`.
    pub fn around(k: usize, samples: &[Sample], lattice: &Lattice, wanted: &[bool]) -> Self {
        let at = samples[k].at();
        let own = samples[k].displacement();
        let mut near = [(DVec2::ZERO, DVec2::ZERO); ((2 * REACH + 1) * (2 * REACH + 1)) as usize];
        let mut count = 1;
        near[0].1 = own;
        for other in lattice.around(&samples[k], REACH).filter(|&o| wanted[o]) {
            near[count] = (samples[other].at() - at, samples[other].displacement());
            count += 1;
        }
        let mut fit = Self {
            at,
            middle: own,
            slopes: [DVec2::ZERO; 2],
        };
        for scale in SCALES {
            let mut normal = [[0.0; 3]; 3];
            let mut right = [[0.0; 3]; 2];
            for &(x, d) in &near[..count] {
                let r = d - fit.middle - fit.slopes[0] * x.x - fit.slopes[1] * x.y;
                let weight = (1.0 + r.length_squared() / (scale * scale)).powi(-2);
                let row = [1.0, x.x, x.y];
                for a in 0..3 {
                    for b in 0..=a {
                        normal[a][b] += weight * row[a] * row[b];
                    }
                    right[0][a] += weight * row[a] * d.x;
                    right[1][a] += weight * row[a] * d.y;
                }
            }
            normal[1][1] += RIDGE;
            normal[2][2] += RIDGE;
            let [u, v] = right.map(|b| solve(&normal, &b));
            if let (Some(u), Some(v)) = (u, v) {
                fit.middle = DVec2::new(u[0], v[0]);
                fit.slopes = [DVec2::new(u[1], v[1]), DVec2::new(u[2], v[2])];
            }
        }
        fit
    }

    /// The displacement at `x`.
    pub fn displacement(&self, x: DVec2) -> DVec2 {
        let x = x - self.at;
        self.middle + self.slopes[0] * x.x + self.slopes[1] * x.y
    }

    /// By how many pixels two flows disagree half-way between them.
    pub fn jump(&self, other: &Self) -> f64 {
        self.difference(other).length()
    }

    /// This displacement less the other's half-way between them, in pixels.
    pub fn difference(&self, other: &Self) -> DVec2 {
        let middle = 0.5 * (self.at + other.at);
        self.displacement(middle) - other.displacement(middle)
    }
}
