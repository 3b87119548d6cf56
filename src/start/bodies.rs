//! Which surfaces are one body: those that one motion explains nearly as well as one for each.
//!
//! Surfaces apart cost (terms) log n each and the price of a region more; together they share a motion,
//! the terms of one surface for all, or 2 numbers for T, 5 for T and ω, and a depth (1 number) or a plane
//! (3) for each. They are joined when what is saved exceeds what their patches cost more
//! under the common motion: the pair that saves most first, until none saves anything. A moving camera's
//! view of hills or of a room so becomes one body, and the sides of a box. What does not touch is only
//! joined with the background, which may lie behind.

use std::collections::BTreeMap;

use super::lattice::Lattice;
use super::rigid::{Rigid, Witness};
use super::sight::Sights;
use super::surface::{Surface, TERMS};
use super::surfaces::Surfaces;
use crate::grid::Grid;

/// Price of a region, in numbers.
const REGION: f64 = 2.0;
/// Patches whose motion is judged, at most.
const WITNESSES: usize = 600;
/// A patch that follows its surface with less probability is no witness.
const UNLIKELY: f64 = 0.1;
/// Patches side by side that make two surfaces touch.
const TOUCH: usize = 3;
/// An error that all patches of a surface may have in common, in pixels: two motions no farther apart
/// are the same.
const COMMON: f64 = 0.05;

/// The bodies, each a list of surfaces; the background, which holds most of the rim, first.
pub(super) fn bodies(sights: &Sights, lattice: &Lattice, surfaces: &Surfaces) -> Vec<Vec<usize>> {
    let count = surfaces.all.len();
    let touching = touching(lattice, surfaces);
    let rim = lattice.on_rim(&surfaces.owner, count);
    let mut bodies: Vec<Vec<usize>> = (0..count).map(|k| vec![k]).collect();
    let on_rim = |body: &Vec<usize>| -> usize { body.iter().map(|&k| rim[k]).sum() };
    let mut known = BTreeMap::new();
    let mut change = |members: &[usize]| -> f64 {
        if members.len() == 1 {
            return 0.0;
        }
        let mut members = members.to_vec();
        members.sort_unstable();
        *known
            .entry(members)
            .or_insert_with_key(|members| joined(sights, surfaces, members))
    };
    loop {
        bodies.sort_by_key(|body| std::cmp::Reverse(on_rim(body)));
        let mut best: Option<(f64, usize, usize)> = None;
        for b in 1..bodies.len() {
            for a in 0..b {
                let (one, other) = (&bodies[a], &bodies[b]);
                let pairs = one.iter().flat_map(|&i| other.iter().map(move |&j| (i, j)));
                if a > 0 && pairs.map(|at| touching[at]).sum::<usize>() < TOUCH {
                    continue;
                }
                let saved = change(&[&one[..], other].concat()) - change(one) - change(other);
                if saved < best.map_or(0.0, |b| b.0) {
                    best = Some((saved, a, b));
                }
            }
        }
        let Some((_, a, b)) = best else {
            return bodies;
        };
        let more = bodies.remove(b);
        bodies[a].extend(more);
    }
}

/// How many patches of one surface lie beside one of another.
fn touching(lattice: &Lattice, surfaces: &Surfaces) -> Grid<usize> {
    let count = surfaces.all.len();
    let mut touching = Grid::new(count, count, 0);
    for (i, owner) in surfaces.owner.iter().enumerate() {
        for j in lattice.beside(i) {
            if let (Some(a), Some(b)) = (*owner, surfaces.owner[j]) {
                touching[(a, b)] += 1;
            }
        }
    }
    touching
}

/// A patch of one of the surfaces that are to be joined.
struct Patch {
    /// Which patch.
    index: usize,
    /// Which of the surfaces.
    member: usize,
    witness: Witness,
    /// What it costs under its own surface.
    own: f64,
}

/// What the surfaces cost as one body, less what they cost apart.
fn joined(sights: &Sights, surfaces: &Surfaces, members: &[usize]) -> f64 {
    let mut patches = Vec::new();
    let mut prices = Vec::new();
    let mut every = 0;
    for (member, &k) in members.iter().enumerate() {
        let surface = &surfaces.all[k];
        let own = surfaces.patches(k);
        prices.push(Sights::price(own.len()));
        every += own.len();
        for index in own {
            let sight = &sights.all[index];
            let weight = sights.follows(index, surface.flow(sight.ray), 0.0);
            if weight > UNLIKELY {
                patches.push(Patch {
                    index,
                    member,
                    witness: Witness::new(sight, surface, sights.focal, weight),
                    own: surface.cost(sights, index),
                });
            }
        }
    }
    let stride = patches.len().div_ceil(WITNESSES).max(1);
    let patches: Vec<Patch> = patches.into_iter().step_by(stride).collect();
    let price = Sights::price(every);
    let terms = |k: usize| surfaces.all[k].terms;
    let apart = members
        .iter()
        .zip(&prices)
        .map(|(&k, price)| terms(k) as f64 * price)
        .sum::<f64>()
        + REGION * (members.len() - 1) as f64 * Sights::price(sights.all.len());
    let common = TERMS.iter().map(|&terms| {
        one_surface(sights, surfaces, members, &patches, terms, stride) + terms as f64 * price
    });
    let depths: f64 = members
        .iter()
        .zip(&prices)
        .map(|(&k, price)| if terms(k) <= 2 { *price } else { 3.0 * price })
        .sum();
    let witnesses: Vec<Witness> = patches.iter().map(|p| p.witness.for_many(stride)).collect();
    let rigid = [false, true].into_iter().filter_map(|turns| {
        let rigid = Rigid::search(&witnesses, turns, sights.spread)?;
        let excess: f64 = patches
            .iter()
            .map(|p| sights.cost(p.index, rigid.flow(&p.witness)) - p.own)
            .sum();
        let numbers = if turns { 5.0 } else { 2.0 };
        Some(excess * stride as f64 + rigid.surprise + numbers * price + depths)
    });
    common.chain(rigid).fold(f64::INFINITY, f64::min) - apart
}

/// How much more all patches cost under one surface, of which every `stride`-th is given.
///
/// Errors that a surface's patches have in common do not shrink with their number: an excess e over a
/// mean square difference D² counts as 1/(1/e + COMMON²/D²).
fn one_surface(
    sights: &Sights,
    surfaces: &Surfaces,
    members: &[usize],
    patches: &[Patch],
    terms: usize,
    stride: usize,
) -> f64 {
    let weighted = patches.iter().map(|p| (p.index, p.witness.weight));
    let surface = Surface::least_squares(sights, weighted, terms, 0.0);
    let mut by_member = vec![[0.0; 3]; members.len()];
    for patch in patches {
        let ray = sights.all[patch.index].ray;
        let flow = surface.flow(ray);
        let own = surfaces.all[members[patch.member]].flow(ray);
        let [excess, difference2, weight] = &mut by_member[patch.member];
        *excess += sights.cost(patch.index, flow) - patch.own;
        *difference2 +=
            patch.witness.weight * ((flow[0] - own[0]).powi(2) + (flow[1] - own[1]).powi(2));
        *weight += patch.witness.weight;
    }
    let each = by_member.into_iter().map(|[excess, difference2, weight]| {
        let excess = excess * stride as f64;
        let shrunk = excess.max(0.0) * COMMON * COMMON * weight / difference2.max(1e-9);
        excess / (1.0 + shrunk)
    });
    each.sum()
}
