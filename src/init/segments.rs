//! The frame in segments of smooth flow.
//!
//! 1. A match lies inside a segment when its flow continues that of four fifths of the matches around it. Matches
//!    inside that lie side by side and continue each other are the core of a segment: cores are parted by seams, and a
//!    seam that is open over a few places only does not join them.
//! 2. The other matches join the core that they continue best, in rounds.
//! 3. Two segments are one when their flow is continuous along more than half of the line on which they touch.

use glam::DVec2;

use super::lattice::Lattice;
use super::local_flow::LocalFlow;
use super::sample::Sample;

/// Flows that disagree by less, in pixels, continue each other.
const CONTINUOUS: f64 = 0.3;
/// The same for matches that join a core.
const JOINING: f64 = 0.8;
/// Share of the matches around that one inside continues.
const INSIDE: f64 = 0.8;
/// Fewest matches around it, of 24.
const FEWEST: usize = 8;
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
}

/// The segments of those `samples` that are `wanted`.
pub fn segments(samples: &[Sample], lattice: &Lattice, wanted: &[bool]) -> Segments {
    let flows: Vec<LocalFlow> = (0..samples.len())
        .map(|k| LocalFlow::around(k, samples, lattice, wanted))
        .collect();
    let flows = &flows[..];
    let inside: Vec<bool> = (0..samples.len())
        .map(|k| {
            let (mut count, mut same) = (0, 0);
            for other in lattice.around(&samples[k], 2).filter(|&o| wanted[o]) {
                count += 1;
                same += usize::from(flows[k].jump(&flows[other]) < CONTINUOUS);
            }
            wanted[k] && count >= FEWEST && same as f64 >= INSIDE * f64::from(count as u32)
        })
        .collect();
    let mut of = vec![None; samples.len()];
    let mut count = 0;
    for first in 0..samples.len() {
        if !inside[first] || of[first].is_some() {
            continue;
        }
        let mut stack = vec![first];
        of[first] = Some(count);
        while let Some(k) = stack.pop() {
            for other in lattice.around(&samples[k], 1) {
                let joins = inside[other] && of[other].is_none();
                if joins && flows[k].jump(&flows[other]) < CONTINUOUS {
                    of[other] = Some(count);
                    stack.push(other);
                }
            }
        }
        count += 1;
    }
    grow(&mut of, samples, lattice, flows, wanted);
    for _ in 0..MERGES {
        if !merge(&mut of, count, samples, lattice, flows) {
            break;
        }
    }
    by_size(of, count)
}

fn grow(
    of: &mut [Option<usize>],
    samples: &[Sample],
    lattice: &Lattice,
    flows: &[LocalFlow],
    wanted: &[bool],
) {
    loop {
        let joins: Vec<(usize, usize)> = (0..of.len())
            .filter(|&k| wanted[k] && of[k].is_none())
            .filter_map(|k| {
                let at = samples[k].at();
                let d = samples[k].displacement();
                let each = lattice.around(&samples[k], 1).filter_map(|other| {
                    let off = (flows[other].displacement(at) - d).length();
                    of[other].filter(|_| off < JOINING).map(|s| (off, s))
                });
                let best = each.min_by(|a, b| a.0.total_cmp(&b.0))?;
                Some((k, best.1))
            })
            .collect();
        if joins.is_empty() {
            return;
        }
        for (k, segment) in joins {
            of[k] = Some(segment);
        }
    }
}

/// Joins what is continuous; whether anything was.
fn merge(
    of: &mut [Option<usize>],
    count: usize,
    samples: &[Sample],
    lattice: &Lattice,
    flows: &[LocalFlow],
) -> bool {
    let mut contacts = std::collections::BTreeMap::<(usize, usize), (u32, u32, DVec2)>::new();
    for k in 0..of.len() {
        let Some(a) = of[k] else { continue };
        for other in lattice.around(&samples[k], 1).filter(|&other| other > k) {
            if let Some(b) = of[other].filter(|&b| b != a) {
                let contact = contacts.entry((a.min(b), a.max(b))).or_default();
                contact.0 += 1;
                contact.1 += u32::from(flows[k].jump(&flows[other]) < CONTINUOUS);
                let (low, high) = if a < b { (k, other) } else { (other, k) };
                contact.2 += flows[low].difference(&flows[high]);
            }
        }
    }
    let mut root: Vec<usize> = (0..count).collect();
    let mut any = false;
    for (&(a, b), &(all, same, sum)) in &contacts {
        let mean = sum.length() / f64::from(all);
        if 2 * same > all || (4 * same > all && mean < CONTINUOUS) {
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
    order.sort_by_key(|&s| std::cmp::Reverse(sizes[s]));
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
