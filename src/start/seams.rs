//! What the seam between two surfaces says: whether it is an edge of one body or the outline of another.
//!
//! Where two sides of a body meet they have the same depth, so that one rigid motion moves both alike: their
//! image motions differ by d ≈ 0 there, as those of two bodies do only by chance. With R the spread of all
//! patches and σ = [`ALIKE`] R, a seam within a body costs
//!
//! ```text
//! −2 log( ((1−ε) N(d; 0, σ² I) + ε N(d; 0, R² I)) / N(d; 0, R² I) )
//! ```
//!
//! more than one between two: less than nothing where d is small, and no more than −2 log ε, as a body may
//! hide part of itself; ε is [`HIDES`]. Nothing is said of a surface that only shifts, whose motion is
//! not known well enough at its rim, nor within the background, which is many things one behind
//! the other.

use std::collections::BTreeMap;

use super::lattice::Lattice;
use super::sight::Sights;
use super::surface::SHIFT;
use super::surfaces::Surfaces;

/// Patches side by side that make two surfaces touch.
const TOUCH: usize = 3;
/// How well the motion at a seam is known from both sides, in spreads of all patches.
const ALIKE: f64 = 0.06;
/// Share of the seams within a body where its depth leaps.
const HIDES: f64 = 0.001;

/// The seams between surfaces.
pub(super) struct Seams {
    /// What each costs within a body, by its two surfaces, the lower number first.
    costs: BTreeMap<(usize, usize), f64>,
}

impl Seams {
    /// The seams of all surfaces that touch.
    pub fn between(sights: &Sights, lattice: &Lattice, surfaces: &Surfaces) -> Self {
        // Squared differences of motion, in R², at all places of a seam.
        let mut apart: BTreeMap<(usize, usize), Vec<f64>> = BTreeMap::new();
        for (i, owner) in surfaces.owner.iter().enumerate() {
            let ray = sights.all[i].ray;
            for j in lattice.beside(i) {
                let (Some(a), Some(b)) = (*owner, surfaces.owner[j]) else {
                    continue;
                };
                if a != b {
                    let [p, q] = [a, b].map(|k| surfaces.all[k].flow(ray));
                    let apart2 = (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
                    let seam = apart.entry((a.min(b), a.max(b))).or_default();
                    seam.push(apart2 / sights.spread.powi(2));
                }
            }
        }
        // Each place is seen from both sides.
        apart.retain(|_, seam| seam.len() >= 2 * TOUCH);
        let cost = |((a, b), mut seam): ((usize, usize), Vec<f64>)| {
            seam.sort_by(f64::total_cmp);
            let shifts = [a, b].iter().any(|&k| surfaces.all[k].terms <= SHIFT);
            let cost = if shifts {
                0.0
            } else {
                cost(seam[seam.len() / 2])
            };
            ((a, b), cost)
        };
        Self {
            costs: apart.into_iter().map(cost).collect(),
        }
    }

    /// Whether some of `one` touch some of `other`.
    pub fn touch(&self, one: &[usize], other: &[usize]) -> bool {
        let mut pairs = one.iter().flat_map(|&i| other.iter().map(move |&j| (i, j)));
        pairs.any(|(i, j)| self.costs.contains_key(&(i.min(j), i.max(j))))
    }

    /// What the seams between `members` cost more within one body than between several.
    pub fn within(&self, members: &[usize]) -> f64 {
        let both = |(a, b): &(usize, usize)| members.contains(a) && members.contains(b);
        let inner = self.costs.iter().filter(|(pair, _)| both(pair));
        inner.map(|(_, cost)| cost).sum()
    }
}

/// The cost of a seam at which motions differ by d, d² in R².
fn cost(d2: f64) -> f64 {
    let sharp = ALIKE.powi(-2);
    let alike = sharp * (-0.5 * d2 * (sharp - 1.0)).exp();
    -2.0 * (HIDES + (1.0 - HIDES) * alike).ln()
}
