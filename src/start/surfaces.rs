//! Which surfaces there are, and which patches show them: as many as pay for their description.
//!
//! ```text
//! E = Σ_i min_k C_k(i) + Σ_k (terms_k + 1) log n
//! ```
//!
//! C_k(i) being what patch i and its neighbours cost under surface k, and n the number of independent
//! patches: minimum description length (Rissanen 1978), here the same as Schwarz's criterion. One
//! surface for all comes first. Then whatever windows of the frame agree on is proposed, and the proposal
//! that lowers E most, once all surfaces are fitted again to the patches they win, is kept. It stops when
//! none lowers E, or at [`MOST`].

use super::lattice::Lattice;
use super::sight::Sights;
use super::surface::Surface;

/// Surfaces at most.
const MOST: usize = 10;
/// Windows that propose, as [`windows`] takes them.
const REACHES: [f64; 2] = [2.0, 4.0];
/// Terms of a proposal.
const PROPOSED: usize = 6;
/// Proposals tried for each further surface, and looked at for that.
const TRIED: (usize, usize) = (4, 40);
/// Rounds of fitting and sharing out.
const ROUNDS: usize = 4;
/// Patches that a surface needs.
pub(super) const FEWEST: usize = 4;

/// Surfaces with the patches they win.
#[derive(Clone)]
pub(super) struct Surfaces {
    /// The surfaces.
    pub all: Vec<Surface>,
    /// The surface of each patch; none where it shows no part of one that is wide enough.
    pub owner: Vec<Option<usize>>,
    energy: f64,
}

impl Surfaces {
    /// Finds them.
    pub fn find(sights: &Sights, lattice: &Lattice) -> Self {
        let everywhere: Vec<usize> = (0..sights.all.len()).collect();
        let first = Surface::best(sights, &everywhere, None);
        let mut found = Self::share_out(sights, lattice, vec![first]);
        let proposals: Vec<(Surface, Vec<f64>)> = REACHES
            .iter()
            .flat_map(|&reach| windows(lattice, reach))
            .map(|within| Surface::agreed(sights, &within, PROPOSED))
            .map(|surface| (surface, pooled_costs(sights, lattice, &surface)))
            .collect();
        while found.all.len() < MOST {
            let Some(next) = found.with_another(sights, lattice, &proposals) else {
                break;
            };
            found = next;
        }
        found
    }

    /// With the best further surface, if any lowers E.
    fn with_another(
        &self,
        sights: &Sights,
        lattice: &Lattice,
        proposals: &[(Surface, Vec<f64>)],
    ) -> Option<Self> {
        let present = least_costs(sights, lattice, &self.all);
        let gain = |costs: &[f64]| -> f64 {
            let each = present.iter().zip(costs);
            each.map(|(p, c)| (p - c).max(0.0)).sum()
        };
        let mut order: Vec<(f64, &Surface)> = proposals
            .iter()
            .map(|(surface, costs)| (gain(costs), surface))
            .collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0));
        let worthwhile = 2.0 * Sights::price(sights.all.len());
        let tried = order
            .into_iter()
            .take(TRIED.1)
            .take_while(|(gain, _)| *gain >= worthwhile)
            .map(|(_, surface)| {
                let mut all = self.all.clone();
                all.push(*surface);
                Self::share_out(sights, lattice, all)
            })
            .filter(|with| lattice.wide(&with.patches(with.all.len() - 1)))
            .take(TRIED.0)
            .map(|with| with.settled(sights, lattice, 1));
        let best = tried.min_by(|a, b| a.energy.total_cmp(&b.energy))?;
        let best = best.settled(sights, lattice, ROUNDS);
        (best.energy < self.energy).then_some(best)
    }

    /// Fits and shares out in turn as long as E falls.
    fn settled(self, sights: &Sights, lattice: &Lattice, rounds: usize) -> Self {
        let mut found = self;
        for _ in 0..rounds {
            let refitted = (0..found.all.len()).filter_map(|k| {
                let within = lattice.core(&found.patches(k));
                (within.len() >= FEWEST).then(|| Surface::best(sights, &within, Some(found.all[k])))
            });
            let next = Self::share_out(sights, lattice, refitted.collect());
            if next.all.is_empty() || next.energy >= found.energy {
                break;
            }
            found = next;
        }
        found
    }

    /// Gives each patch to the surface under which it and its neighbours cost least.
    fn share_out(sights: &Sights, lattice: &Lattice, all: Vec<Surface>) -> Self {
        let costs: Vec<Vec<f64>> = all
            .iter()
            .map(|surface| pooled_costs(sights, lattice, surface))
            .collect();
        let price = Sights::price(sights.all.len());
        let mut energy: f64 = all.iter().map(|s| (s.terms + 1) as f64 * price).sum();
        let owner = (0..sights.all.len()).map(|i| {
            let each = costs.iter().map(|c| c[i]).enumerate();
            let least = each.min_by(|a, b| a.1.total_cmp(&b.1))?;
            energy += least.1;
            Some(least.0)
        });
        Self {
            owner: owner.collect(),
            all,
            energy,
        }
    }

    /// The patches of surface `k`.
    pub fn patches(&self, k: usize) -> Vec<usize> {
        let owners = self.owner.iter().enumerate();
        owners
            .filter(|(_, owner)| **owner == Some(k))
            .map(|(i, _)| i)
            .collect()
    }

    /// Makes a surface of its own, fitted anew, of every connected part that is wide enough: what lies
    /// apart need not move alike. The rest is nobody's.
    pub fn torn_apart(&self, sights: &Sights, lattice: &Lattice) -> Self {
        let mut all = Vec::new();
        let mut owner = vec![None; self.owner.len()];
        for (k, surface) in self.all.iter().enumerate() {
            for part in lattice.parts(&self.owner, k) {
                if lattice.wide(&part) {
                    for &i in &part {
                        owner[i] = Some(all.len());
                    }
                    all.push(Surface::best(sights, &lattice.core(&part), Some(*surface)));
                }
            }
        }
        Self {
            all,
            owner,
            energy: self.energy,
        }
    }

    /// Other surfaces, fitted and each in one piece, if they are a shorter description.
    pub fn instead(&self, sights: &Sights, lattice: &Lattice, all: Vec<Surface>) -> Option<Self> {
        let described =
            |all| Self::share_out(sights, lattice, all).settled(sights, lattice, ROUNDS);
        let [these, others] = [self.all.clone(), all].map(described);
        (others.energy < these.energy).then(|| others.torn_apart(sights, lattice))
    }

    /// The same, of rays `factor` times as long.
    pub fn stretched(&self, factor: f64) -> Self {
        let all = self.all.iter().map(|surface| surface.stretched(factor));
        Self {
            all: all.collect(),
            ..self.clone()
        }
    }
}

/// C_k for a surface: what each patch and its neighbours cost.
pub(super) fn pooled_costs(sights: &Sights, lattice: &Lattice, surface: &Surface) -> Vec<f64> {
    let each = 0..sights.all.len();
    lattice.pooled(&each.map(|i| surface.cost(sights, i)).collect::<Vec<_>>())
}

/// min_k C_k over some surfaces.
pub(super) fn least_costs<'a>(
    sights: &Sights,
    lattice: &Lattice,
    surfaces: impl IntoIterator<Item = &'a Surface>,
) -> Vec<f64> {
    let mut least = vec![f64::INFINITY; sights.all.len()];
    for surface in surfaces {
        for (l, c) in least.iter_mut().zip(pooled_costs(sights, lattice, surface)) {
            *l = l.min(c);
        }
    }
    least
}

/// The patches of windows all over the frame, `reach` places to each side where the frame has the usual
/// number of patches.
pub(super) fn windows(lattice: &Lattice, reach: f64) -> impl Iterator<Item = Vec<usize>> {
    let (width, height) = (lattice.patch.width(), lattice.patch.height());
    let reach = ((reach * lattice.grain()).round() as usize).max(1);
    let along = move |end: usize| (reach..end.saturating_sub(reach)).step_by(reach + 1);
    along(height).flat_map(move |y| {
        along(width)
            .map(move |x| lattice.window((x, y), reach))
            .filter(|within| within.len() >= FEWEST)
    })
}
