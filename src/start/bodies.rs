//! Which surfaces are one body: those that one motion explains nearly as well as one for each.
//!
//! Surfaces are joined while that saves anything, the pair that saves most first: a moving camera's
//! view of hills or of a room becomes one body, and so do the sides of a box. What is saved is what
//! the patches say ([`Union`]) and, but for the background, what the seams say ([`Seams`]). Surfaces that
//! do not touch are only joined with the background, which may lie behind what is between.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use super::lattice::Lattice;
use super::seams::Seams;
use super::sight::Sights;
use super::surfaces::Surfaces;
use super::union::Union;

/// The bodies, each a list of surfaces; the background, which holds most of the rim, first.
pub(super) fn bodies(sights: &Sights, lattice: &Lattice, surfaces: &Surfaces) -> Vec<Vec<usize>> {
    let count = surfaces.all.len();
    let seams = Seams::between(sights, lattice, surfaces);
    let rim = lattice.on_rim(&surfaces.owner, count);
    let on_rim = |body: &Vec<usize>| -> usize { body.iter().map(|&k| rim[k]).sum() };
    let mut known = BTreeMap::new();
    let mut change = |mut members: Vec<usize>, scenery: bool| -> f64 {
        members.sort_unstable();
        let seams = if scenery { 0.0 } else { seams.within(&members) };
        let surfaces = known
            .entry(members)
            .or_insert_with_key(|members| Union::new(sights, surfaces, members).change());
        seams + *surfaces
    };
    let mut bodies: Vec<Vec<usize>> = (0..count).map(|k| vec![k]).collect();
    loop {
        bodies.sort_by_key(|body| Reverse(on_rim(body)));
        let mut best = (0.0, None);
        for b in 1..bodies.len() {
            for a in 0..b {
                let (one, other) = (&bodies[a], &bodies[b]);
                if a > 0 && !seams.touch(one, other) {
                    continue;
                }
                let scenery = a == 0;
                let together = change([&one[..], other].concat(), scenery);
                let change = together - change(one.clone(), scenery) - change(other.clone(), false);
                if change < best.0 {
                    best = (change, Some((a, b)));
                }
            }
        }
        let Some((a, b)) = best.1 else {
            return bodies;
        };
        let more = bodies.remove(b);
        bodies[a].extend(more);
    }
}
