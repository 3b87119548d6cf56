//! The image motion of a plane, fitted to patches: what a patch of a surface looks like from afar.
//!
//! A plane that moves rigidly moves its image by a quadratic in the ray (X, Y) (Longuet-Higgins 1984),
//!
//! ```text
//! u = a0 + a2 X + a3 Y + X (a6 X + a7 Y)      v = a1 + a4 X + a5 Y + Y (a6 X + a7 Y)
//! ```
//!
//! a in pixels. With fewer terms it is an affine motion, a shift, or none. The fit is least squares in
//! the patches' own precisions, reweighted by the probability that a patch follows the surface; at first
//! every patch is granted an error as wide as the spread of all, then less and less ([`STAGES`]), so that
//! the fit finds what most agree on whatever the rest does.

use super::sight::Sights;
use crate::linalg::solve as solve_positive;

/// Terms that a surface may have.
pub(super) const TERMS: [usize; 4] = [0, SHIFT, 6, 8];
/// Terms of one that only shifts.
pub(super) const SHIFT: usize = 2;
/// Standard deviation of a known beforehand, in pixels.
const EXPECTED: f64 = 20.0;
/// Errors granted to patches one fit after the other, in spreads of all patches.
const STAGES: [f64; 6] = [1.0, 0.5, 0.2, 0.07, 0.0, 0.0];

/// A surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    /// a0 to a7; 0 beyond its terms.
    coefficients: [f64; 8],
    /// How many of them count.
    pub terms: usize,
}

impl Surface {
    /// Image motion along a ray.
    pub fn flow(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let a = &self.coefficients;
        let bend = a[6] * x + a[7] * y;
        [
            a[0] + a[2] * x + a[3] * y + x * bend,
            a[1] + a[4] * x + a[5] * y + y * bend,
        ]
    }

    /// The same image motion, of rays `factor` times as long.
    pub fn stretched(mut self, factor: f64) -> Self {
        for (i, a) in self.coefficients.iter_mut().enumerate() {
            *a /= factor.powi([0, 1, 2][usize::from(i >= 2) + usize::from(i >= 6)]);
        }
        self
    }

    /// cost(w; m) of patch `i`.
    pub fn cost(&self, sights: &Sights, i: usize) -> f64 {
        sights.cost(i, self.flow(sights.all[i].ray))
    }

    /// The surface of so many `terms` that most of the patches `within` agree on.
    pub fn agreed(sights: &Sights, within: &[usize], terms: usize) -> Self {
        let mut surface = None;
        for stage in STAGES {
            surface = Some(Self::reweighted(
                sights,
                within,
                terms,
                surface,
                stage * sights.spread,
            ));
        }
        surface.unwrap_or(Self {
            coefficients: [0.0; 8],
            terms,
        })
    }

    /// The surface that explains the patches `within` best for what its terms cost, near `start` when
    /// that is given.
    pub fn best(sights: &Sights, within: &[usize], start: Option<Self>) -> Self {
        let near = |terms, mut surface| {
            for _ in 0..2 {
                surface = Self::reweighted(sights, within, terms, Some(surface), 0.0);
            }
            surface
        };
        let all = TERMS[TERMS.len() - 1];
        let full = match start {
            Some(surface) => near(all, surface),
            None => Self::agreed(sights, within, all),
        };
        let price = Sights::price(sights.all.len());
        let total = |surface: &Self| -> f64 {
            let each = within.iter().map(|&i| surface.cost(sights, i));
            each.sum::<f64>() + surface.terms as f64 * price
        };
        let fewer = TERMS.iter().filter(|&&t| t < all).map(|&t| near(t, full));
        let tried = fewer.chain(start).map(|surface| (total(&surface), surface));
        tried
            .fold((total(&full), full), |best, tried| {
                if tried.0 < best.0 { tried } else { best }
            })
            .1
    }

    /// One step: patches count as far as they follow `last`, each granted an error of `slack` pixels.
    fn reweighted(
        sights: &Sights,
        within: &[usize],
        terms: usize,
        last: Option<Self>,
        slack: f64,
    ) -> Self {
        let weight = |i: usize| match last {
            Some(last) => sights.follows(i, last.flow(sights.all[i].ray), slack),
            None => 1.0,
        };
        Self::least_squares(
            sights,
            within.iter().map(|&i| (i, weight(i))),
            terms,
            slack * slack,
        )
    }

    /// Σ weight (w−m)ᵀ (C+v I)⁻¹ (w−m) made least over patches with weights.
    pub fn least_squares(
        sights: &Sights,
        weighted: impl Iterator<Item = (usize, f64)>,
        terms: usize,
        variance: f64,
    ) -> Self {
        let mut matrix = [[0.0; 8]; 8];
        let mut right = [0.0; 8];
        for (i, weight) in weighted {
            let sight = &sights.all[i];
            let (_, precision) = sight.precision(variance);
            let [a, b, c] = precision.map(|p| weight * p);
            let [x, y] = sight.ray;
            let u = [1.0, 0.0, x, y, 0.0, 0.0, x * x, x * y];
            let v = [0.0, 1.0, 0.0, 0.0, x, y, x * y, y * y];
            for i in 0..terms {
                let (pu, pv) = (a * u[i] + b * v[i], b * u[i] + c * v[i]);
                right[i] += pu * sight.motion[0] + pv * sight.motion[1];
                for j in 0..=i {
                    matrix[i][j] += pu * u[j] + pv * v[j];
                }
            }
        }
        for i in 0..8 {
            matrix[i][i] += EXPECTED.powi(-2);
        }
        Self {
            coefficients: solve_positive(&matrix, &right).unwrap_or([0.0; 8]),
            terms,
        }
    }
}
