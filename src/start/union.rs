//! What several surfaces cost as one body, less what they cost apart.
//!
//! Apart, a surface's terms cost log n each, n being its own patches, and each region beyond the first
//! costs [`REGION`] numbers more. Together they share one of
//!
//! - the terms of one surface for all;
//! - T without turning: 2 numbers for its direction, and for each surface its depth: 1 number for one
//!   that only shifts, 3 for the plane of another;
//! - T and ω: 5 numbers, and depths as before.
//!
//! What the patches cost more under the common motion is added.

use super::rigid::{Rigid, Search, Witness};
use super::sight::Sights;
use super::surface::{SHIFT, Surface, TERMS};
use super::surfaces::Surfaces;

/// Price of a region, in numbers.
const REGION: f64 = 2.0;
/// Patches that are asked, at most.
const ASKED: usize = 600;
/// A patch that follows its surface with less probability is not asked.
const UNLIKELY: f64 = 0.1;
/// An error that all patches of a surface may have in common, in pixels: two motions no farther apart
/// are the same.
const COMMON: f64 = 0.05;

/// Surfaces that may be one body.
pub(super) struct Union<'a> {
    sights: &'a Sights,
    surfaces: &'a Surfaces,
    members: &'a [usize],
    /// How many patches each member has.
    sizes: Vec<usize>,
    /// Every `stride`-th of them.
    patches: Vec<Asked>,
    stride: f64,
}

/// A patch that is asked.
struct Asked {
    index: usize,
    /// Which of the members it is on.
    member: usize,
    witness: Witness,
    /// What it costs under its own surface.
    own: f64,
}

impl<'a> Union<'a> {
    /// The surfaces `members` of `surfaces`.
    pub fn new(sights: &'a Sights, surfaces: &'a Surfaces, members: &'a [usize]) -> Self {
        let mut patches = Vec::new();
        let mut sizes = Vec::new();
        for (member, &k) in members.iter().enumerate() {
            let surface = &surfaces.all[k];
            let own = surfaces.patches(k);
            sizes.push(own.len());
            patches.extend(own.into_iter().filter_map(|index| {
                let sight = &sights.all[index];
                let weight = sights.follows(index, surface.flow(sight.ray), 0.0);
                (weight > UNLIKELY).then(|| Asked {
                    index,
                    member,
                    witness: Witness::new(sight, surface, sights.focal, weight),
                    own: surface.cost(sights, index),
                })
            }));
        }
        let stride = patches.len().div_ceil(ASKED).max(1);
        Self {
            sights,
            surfaces,
            members,
            sizes,
            patches: patches.into_iter().step_by(stride).collect(),
            stride: stride as f64,
        }
    }

    /// Cost as one body less cost apart; 0 of a single surface.
    pub fn change(&self, search: Search) -> f64 {
        if self.members.len() == 1 {
            return 0.0;
        }
        let surface = TERMS.iter().map(|&terms| self.as_surface(terms));
        let motion = [false, true]
            .into_iter()
            .filter_map(|t| self.as_motion(t, search));
        let together = surface.chain(motion).fold(f64::INFINITY, f64::min);
        together - self.apart()
    }

    fn apart(&self) -> f64 {
        let terms = self.each_member(|terms| terms as f64);
        let regions = REGION * (self.members.len() - 1) as f64;
        terms + regions * Sights::price(self.sights.all.len())
    }

    /// Σ over members of as many numbers as a surface of so many terms has, at the member's price.
    fn each_member(&self, numbers: impl Fn(usize) -> f64) -> f64 {
        let each = self.members.iter().zip(&self.sizes);
        each.map(|(&k, &size)| numbers(self.surfaces.all[k].terms) * Sights::price(size))
            .sum()
    }

    fn price(&self) -> f64 {
        Sights::price(self.sizes.iter().sum())
    }

    /// As one surface of so many terms.
    ///
    /// Errors that a surface's patches have in common do not shrink with their number: what they cost
    /// more, e, counts as 1/(1/e + COMMON²/D²), D² being the mean square difference of their motion.
    fn as_surface(&self, terms: usize) -> f64 {
        let weighted = self.patches.iter().map(|p| (p.index, p.witness.weight));
        let surface = Surface::least_squares(self.sights, weighted, terms, 0.0);
        let mut by_member = vec![[0.0; 3]; self.members.len()];
        for patch in &self.patches {
            let ray = self.sights.all[patch.index].ray;
            let flow = surface.flow(ray);
            let own = self.surfaces.all[self.members[patch.member]].flow(ray);
            let weight = patch.witness.weight;
            let [more, apart, all] = &mut by_member[patch.member];
            *more += self.stride * (self.sights.cost(patch.index, flow) - patch.own);
            *apart += weight * ((flow[0] - own[0]).powi(2) + (flow[1] - own[1]).powi(2));
            *all += weight;
        }
        let more = by_member.into_iter().map(|[more, apart, all]| {
            let shrinks = more.max(0.0) * COMMON * COMMON * all / apart.max(1e-9);
            more / (1.0 + shrinks)
        });
        more.sum::<f64>() + terms as f64 * self.price()
    }

    /// As one motion, with or without ω.
    fn as_motion(&self, turns: bool, search: Search) -> Option<f64> {
        let witness = |p: &Asked| p.witness.for_many(self.stride);
        let witnesses: Vec<Witness> = self.patches.iter().map(witness).collect();
        let rigid = Rigid::nearest(&witnesses, turns, self.sights.spread, search)?;
        let more = self.patches.iter().map(|p| {
            let flow = rigid.flow(&p.witness);
            self.stride * (self.sights.cost(p.index, flow) - p.own)
        });
        let depths = self.each_member(|terms| if terms <= SHIFT { 1.0 } else { 3.0 });
        let motion = if turns { 5.0 } else { 2.0 };
        Some(more.sum::<f64>() + rigid.surprise + motion * self.price() + depths)
    }
}
