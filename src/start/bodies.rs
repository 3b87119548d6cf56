//! Which surfaces are one body: those that one motion explains nearly as well as one for each.
//!
//! Surfaces are joined while that saves anything, the pair that saves most first: a moving camera's
//! view of hills or of a room becomes one body, and so do the sides of a box. What is saved is what
//! the patches say ([`Union`]) and, but for the background, what the seams say ([`Seams`]). Surfaces that
//! do not touch are only joined with the background, which may lie behind what is between.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use super::look::Look;
use super::rigid::Search;
use super::seams::Seams;
use super::union::Union;

/// Surfaces put together.
pub(super) struct Bodies {
    /// The surfaces of each; the background, which holds most of the rim, first.
    pub members: Vec<Vec<usize>>,
    /// What all surfaces cost like this less what they cost apart, at most 0.
    pub change: f64,
}

impl Bodies {
    /// Puts them together; `search` is how their motions are looked for.
    pub fn find(look: &Look, search: Search) -> Self {
        let Look {
            lattice,
            sights,
            surfaces,
            ..
        } = look;
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
                .or_insert_with_key(|members| Union::new(sights, surfaces, members).change(search));
            seams + *surfaces
        };
        let mut bodies = Self {
            members: (0..count).map(|k| vec![k]).collect(),
            change: 0.0,
        };
        loop {
            let members = &mut bodies.members;
            members.sort_by_key(|body| Reverse(on_rim(body)));
            let mut best = (0.0, None);
            for b in 1..members.len() {
                for a in 0..b {
                    let (one, other) = (&members[a], &members[b]);
                    if a > 0 && !seams.touch(one, other) {
                        continue;
                    }
                    let scenery = a == 0;
                    let together = change([&one[..], other].concat(), scenery);
                    let change =
                        together - change(one.clone(), scenery) - change(other.clone(), false);
                    if change < best.0 {
                        best = (change, Some((a, b)));
                    }
                }
            }
            let (less, Some((a, b))) = best else {
                return bodies;
            };
            let more = members.remove(b);
            members[a].extend(more);
            bodies.change += less;
        }
    }
}
