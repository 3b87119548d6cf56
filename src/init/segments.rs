//! The frame in segments of continuous flow.
//!
//! Patches of affine flow ([`patches`]) are joined where the flow of one goes on in the other: along most of their common
//! line the two flows, each found from the patch's own matches nearby, differ by no more than [`CONTINUOUS`] and
//! [`CERTAIN`] times what they are known to.

use std::collections::BTreeMap;

use glam::DVec2;

use super::affine::Moments;
use super::epipolar::median;
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
const REACH: isize = 3;
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
    let (mut of, count) = patches(samples, lattice);
    let patch = of.clone();
    let border: Vec<bool> = (0..samples.len())
        .map(|k| lattice.around(&samples[k], 1).any(|o| patch[o] != patch[k]))
        .collect();
    let middle = centre(lattice.size());
    // Contacts of patches, each with whether flow goes on there.
    let mut contacts = Vec::new();
    for k in 0..samples.len() {
        let Some(a) = patch[k] else { continue };
        for other in lattice.around(&samples[k], 1).filter(|&other| other > k) {
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
    link_small(&mut of, count, &contacts);
    for _ in 0..MERGES {
        if !merge(&mut of, count, &patch, &contacts) {
            break;
        }
    }
    by_size(of, count)
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
        let all = lattice.around(&samples[k], REACH).chain([k]);
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

/// Joins each small patch to the one neighbour that continues it best: those along an outline continue both sides.
fn link_small(of: &mut [Option<usize>], count: usize, contacts: &[(usize, usize, bool)]) {
    let mut sizes = vec![0usize; count];
    of.iter().flatten().for_each(|&s| sizes[s] += 1);
    let mut lines = BTreeMap::<(usize, usize), (u32, u32)>::new();
    for &(a, b, same) in contacts {
        for pair in [(a, b), (b, a)] {
            let line = lines.entry(pair).or_default();
            line.0 += 1;
            line.1 += u32::from(same);
        }
    }
    let mut best = vec![(SHARE, 0, None); count];
    for (&(a, b), &(all, same)) in &lines {
        let share = f64::from(same) / f64::from(all);
        if sizes[a] < SMALL && (share, same) > (best[a].0, best[a].1) {
            best[a] = (share, same, Some(b));
        }
    }
    let mut root: Vec<usize> = (0..count).collect();
    for (a, (_, _, b)) in best.into_iter().enumerate() {
        if let Some(b) = b {
            let (a, b) = (find(&root, a), find(&root, b));
            root[a.max(b)] = a.min(b);
        }
    }
    for segment in of.iter_mut().flatten() {
        *segment = find(&root, *segment);
    }
}

/// Joins what is continuous; whether anything was.
fn merge(
    of: &mut [Option<usize>],
    count: usize,
    patch: &[Option<usize>],
    contacts: &[(usize, usize, bool)],
) -> bool {
    // Where the segment of each patch is.
    let mut now: Vec<usize> = (0..count).collect();
    for (p, s) in patch.iter().zip(of.iter()) {
        if let (Some(p), Some(s)) = (*p, *s) {
            now[p] = s;
        }
    }
    let mut sizes = vec![0usize; count];
    of.iter().flatten().for_each(|&s| sizes[s] += 1);
    let mut lines = BTreeMap::<(usize, usize), (u32, u32)>::new();
    for &(a, b, same) in contacts {
        let (a, b) = (now[a], now[b]);
        if a != b {
            let line = lines.entry((a.min(b), a.max(b))).or_default();
            line.0 += 1;
            line.1 += u32::from(same);
        }
    }
    let mut root: Vec<usize> = (0..count).collect();
    let mut any = false;
    for (&(a, b), &(all, same)) in &lines {
        let least = 0.5 * (sizes[a].min(sizes[b]) as f64).sqrt();
        let large = sizes[a].min(sizes[b]) >= SMALL;
        if large && f64::from(same) > (SHARE * f64::from(all)).max(least) {
            let (a, b) = (find(&root, a), find(&root, b));
            if a != b {
                root[a.max(b)] = a.min(b);
                any = true;
            }
        }
    }
    for segment in of.iter_mut().flatten() {
        *segment = find(&root, *segment);
    }
    any
}

fn find(root: &[usize], mut k: usize) -> usize {
    while root[k] != k {
        k = root[k];
    }
    k
}

fn by_size(mut of: Vec<Option<usize>>, count: usize) -> Segments {
    let mut sizes = vec![0usize; count];
    of.iter().flatten().for_each(|&s| sizes[s] += 1);
    let mut order: Vec<usize> = (0..count).filter(|&s| sizes[s] > 0).collect();
    order = ordered(order, |&s| -(sizes[s] as f64));
    let mut rank = vec![0; count];
    for (new, &old) in order.iter().enumerate() {
        rank[old] = new;
    }
    of.iter_mut().flatten().for_each(|s| *s = rank[*s]);
    Segments {
        of,
        count: order.len(),
    }
}
