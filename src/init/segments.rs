//! The frame in segments of continuous flow.
//!
//! Patches of affine flow ([`patches`]) are joined where the flow of one goes on in the other: along most of their common
//! line the two flows, each found from the patch's own matches nearby, differ by no more than [`CONTINUOUS`] and
//! [`CERTAIN`] times what they are known to.

use std::collections::BTreeMap;

use glam::DVec2;

use super::affine::Moments;
use super::epipolar::median;
use super::groups::Groups;
use super::lattice::{Lattice, centre};
use super::patches::patches;
use super::sample::Sample;
use crate::ordered::ordered;

/// Flows that differ by less, in pixels, continue each other.
const CONTINUOUS: f64 = 0.15;
/// So do flows that differ by less than this many standard deviations.
const CERTAIN: f64 = 2.0;
/// But no more than this, in pixels.
const DOUBT: f64 = 0.2;
/// Fewest matches from which flow is found without those whose windows reach over the line.
const INNER: usize = 6;
/// Share of a line along which flow has to go on.
const SHARE: f64 = 0.7;
/// Patches of fewer matches join one neighbour only.
const SMALL: usize = 64;
/// Half of the window in which flow is found, in places of the lattice.
const REACH: usize = 3;
/// Matches that share one independent observation: windows of 9 px, 4 px apart.
const SHARED: f64 = 5.0;
/// Times that segments are compared.
const MERGES: usize = 4;

/// Which segment each match belongs to.
pub struct Segments {
    /// From 0, the largest first; `None` for matches that continue nothing.
    pub of: Vec<Option<usize>>,
    /// How many there are.
    pub count: usize,
}

impl Segments {
    /// The matches of each segment that is `wanted`.
    pub fn members(&self, wanted: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
        let mut each = vec![Vec::new(); self.count];
        for (k, segment) in self.of.iter().enumerate() {
            if let Some(s) = segment.filter(|&s| wanted(s)) {
                each[s].push(k);
            }
        }
        each.retain(|members| !members.is_empty());
        each
    }

    /// The share of each segment's matches for which `holds`.
    pub fn shares(&self, holds: impl Fn(usize) -> bool) -> Vec<f64> {
        let mut counts = vec![[0usize; 2]; self.count];
        for (k, segment) in self.of.iter().enumerate() {
            if let Some(s) = *segment {
                counts[s][0] += usize::from(holds(k));
                counts[s][1] += 1;
            }
        }
        let share = |[part, all]: [usize; 2]| part as f64 / all.max(1) as f64;
        counts.into_iter().map(share).collect()
    }

    /// The median of `value` over each segment's matches.
    pub fn medians(&self, value: &[f64]) -> Vec<f64> {
        let mut each = vec![Vec::new(); self.count];
        for (k, segment) in self.of.iter().enumerate() {
            if let Some(s) = *segment {
                each[s].push(value[k]);
            }
        }
        each.into_iter().map(median).collect()
    }
}

/// The segments of `samples`.
pub fn segments(samples: &[Sample], lattice: &Lattice) -> Segments {
    let (patch, count) = patches(samples, lattice);
    let border: Vec<bool> = (0..samples.len())
        .map(|k| {
            lattice
                .around(&samples[k].matched, 1)
                .any(|o| patch[o] != patch[k])
        })
        .collect();
    let middle = centre(lattice.size());
    // Contacts of patches, each with whether flow goes on there.
    let mut contacts = Vec::new();
    for k in 0..samples.len() {
        let Some(a) = patch[k] else { continue };
        for other in lattice
            .around(&samples[k].matched, 1)
            .filter(|&other| other > k)
        {
            if let Some(b) = patch[other].filter(|&b| b != a) {
                let at = 0.5 * (samples[k].at() + samples[other].at());
                let [(one, known), (two, sure)] =
                    [k, other].map(|k| near(k, at, samples, lattice, (&patch, &border), middle));
                let off = (one - two).length();
                let limit = CONTINUOUS + (CERTAIN * (known + sure).sqrt()).min(DOUBT);
                contacts.push((a, b, off < limit));
            }
        }
    }
    let mut groups = Groups::new(count);
    link_small(&mut groups, &patch, &contacts);
    for _ in 0..MERGES {
        if !merge(&mut groups, &patch, &contacts) {
            break;
        }
    }
    let sizes = groups.sizes(&patch);
    let largest = ordered((0..count).collect(), |&s: &usize| -(sizes[s] as f64));
    let mut rank = vec![0; count];
    for (new, &old) in largest.iter().enumerate() {
        rank[old] = new;
    }
    let of = patch.iter().map(|p| p.map(|p| rank[groups.find(p)]));
    Segments {
        of: of.collect(),
        count: sizes.iter().filter(|&&size| size > 0).count(),
    }
}

/// The flow at `at` from the matches around match k that belong to its patch, and its variance, px².
fn near(
    k: usize,
    at: DVec2,
    samples: &[Sample],
    lattice: &Lattice,
    (patch, border): (&[Option<usize>], &[bool]),
    middle: DVec2,
) -> (DVec2, f64) {
    let own = |borders: bool| {
        let mut sum = Moments::default();
        let alike = |o: &usize| patch[*o] == patch[k] && (borders || !border[*o]);
        let all = lattice.around(&samples[k].matched, REACH).chain([k]);
        for other in all.filter(alike) {
            sum = sum.with(&Moments::of(&samples[other], middle));
        }
        sum
    };
    let mut sum = own(false);
    if sum.count < INNER {
        sum = own(true);
    }
    let flow = sum.fit();
    (
        flow.displacement(at, middle),
        SHARED * sum.variance(at, middle),
    )
}

/// Two patches that touch at a match of each, and whether flow goes on there.
type Contact = (usize, usize, bool);

/// For each two groups that touch, the number of their contacts and of those where flow goes on.
fn lines(groups: &mut Groups, contacts: &[Contact]) -> BTreeMap<(usize, usize), [u32; 2]> {
    let mut lines = BTreeMap::<_, [u32; 2]>::new();
    for &(a, b, same) in contacts {
        let (a, b) = (groups.find(a), groups.find(b));
        if a != b {
            let line = lines.entry((a.min(b), a.max(b))).or_default();
            line[0] += 1;
            line[1] += u32::from(same);
        }
    }
    lines
}

/// Joins each small patch to the one neighbour that continues it best: those along an outline continue both sides.
fn link_small(groups: &mut Groups, patch: &[Option<usize>], contacts: &[Contact]) {
    let sizes = groups.sizes(patch);
    let mut best = vec![(SHARE, 0, None); sizes.len()];
    for ((a, b), [all, same]) in lines(groups, contacts) {
        let share = f64::from(same) / f64::from(all);
        for (a, b) in [(a, b), (b, a)] {
            if sizes[a] < SMALL && (share, same) > (best[a].0, best[a].1) {
                best[a] = (share, same, Some(b));
            }
        }
    }
    for (a, (_, _, b)) in best.into_iter().enumerate() {
        if let Some(b) = b {
            join(groups, a, b);
        }
    }
}

/// Joins what is continuous; whether anything was.
fn merge(groups: &mut Groups, patch: &[Option<usize>], contacts: &[Contact]) -> bool {
    let sizes = groups.sizes(patch);
    let mut any = false;
    for ((a, b), [all, same]) in lines(groups, contacts) {
        let smaller = sizes[a].min(sizes[b]);
        let least = 0.5 * (smaller as f64).sqrt();
        if smaller >= SMALL && f64::from(same) > (SHARE * f64::from(all)).max(least) {
            any |= join(groups, a, b);
        }
    }
    any
}

/// Joins two groups; whether they were two.
fn join(groups: &mut Groups, a: usize, b: usize) -> bool {
    let (a, b) = (groups.find(a), groups.find(b));
    groups.join(a.min(b), a.max(b));
    a != b
}
