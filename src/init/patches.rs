//! The frame in patches of affine flow, by merging (Koepfler, Lopez and Morel 1994).
//!
//! ```text
//! E = Σ_patches min χ²  +  λ · length of the lines between them
//! ```
//!
//! χ² is that of [`Moments`], length counts pairs of neighbouring places of the lattice. At first every match is a patch;
//! the two neighbours that gain most for each unit of their common line are merged, until none gain. Then matches on
//! the lines go to the neighbour that they fit best. λ being what a unit of line has to separate in χ², a large body is
//! told from its surroundings by a small part of a match's uncertainty, a single match by several times that.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use glam::DVec2;

use super::affine::{Affine, Moments};
use super::groups::Groups;
use super::lattice::{Lattice, place};
use super::sample::Sample;

/// λ.
const LENGTH: f64 = 10.0;
/// Fewest matches of a patch.
const FEWEST: usize = 6;
/// Fewest matches of a patch that have none of another around them.
const CORE: usize = 3;
/// χ² at which a match stops counting against a patch while lines are straightened.
const CUT: f64 = 25.0;
/// Rounds of straightening.
const ROUNDS: usize = 6;

/// Which patch each of `samples` belongs to, numbered from 0; `None` for matches that fit none.
pub fn patches(samples: &[Sample], lattice: &Lattice) -> (Vec<Option<usize>>, usize) {
    let [across, down] = lattice.size();
    let middle = super::lattice::centre([across, down]);
    let moments: Vec<Moments> = samples.iter().map(|s| Moments::of(s, middle)).collect();
    let of = merged(&moments, &lines(samples, lattice));
    let (mut of, count) = numbered(&of);
    dissolve(&mut of, count, samples, lattice);
    straighten(&mut of, count, samples, lattice, &moments, middle);
    (of, count)
}

/// Pairs of matches that are neighbours: side by side, or with one place without a match between them.
fn lines(samples: &[Sample], lattice: &Lattice) -> Vec<(usize, usize)> {
    let [across, down] = lattice.size();
    let mut pairs = Vec::with_capacity(2 * samples.len());
    for (k, sample) in samples.iter().enumerate() {
        let (x, y) = place(&sample.matched);
        let right = (1..=2).map(|step| (x + step, y)).filter(|p| p.0 < across);
        let below = (1..=2).map(|step| (x, y + step)).filter(|p| p.1 < down);
        pairs.extend(right.map(|p| lattice.at(p)).find_map(|o| o).map(|o| (k, o)));
        pairs.extend(below.map(|p| lattice.at(p)).find_map(|o| o).map(|o| (k, o)));
    }
    pairs
}

/// A pair that may be merged.
struct Pair {
    /// Gain lost for each unit of line; the least comes first.
    price: f64,
    ends: [usize; 2],
    /// How often each end had been merged.
    ages: [u32; 2],
}

impl PartialEq for Pair {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Pair {}
impl PartialOrd for Pair {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Pair {
    fn cmp(&self, other: &Self) -> Ordering {
        let own = (self.price, self.ends);
        own.0.total_cmp(&other.price).then(own.1.cmp(&other.ends))
    }
}

/// The lengths of a patch's lines with its neighbours, in the order of their numbers.
#[derive(Clone, Default)]
struct Lengths(Vec<(usize, f64)>);

impl Lengths {
    fn find(&self, other: usize) -> Result<usize, usize> {
        self.0.binary_search_by_key(&other, |line| line.0)
    }

    fn of(&self, other: usize) -> f64 {
        self.find(other).map_or(0.0, |at| self.0[at].1)
    }

    fn add(&mut self, other: usize, length: f64) {
        match self.find(other) {
            Ok(at) => self.0[at].1 += length,
            Err(at) => self.0.insert(at, (other, length)),
        }
    }

    fn remove(&mut self, other: usize) {
        if let Ok(at) = self.find(other) {
            self.0.remove(at);
        }
    }
}

/// The number of the patch of each match: that of one of its matches.
fn merged(moments: &[Moments], lines: &[(usize, usize)]) -> Vec<usize> {
    let mut groups = Groups::new(moments.len());
    let mut sums = moments.to_vec();
    let mut misfit: Vec<f64> = sums.iter().map(|m| m.fit().misfit).collect();
    let mut age = vec![0u32; sums.len()];
    let mut length = vec![Lengths::default(); sums.len()];
    for &(a, b) in lines {
        length[a].add(b, 1.0);
        length[b].add(a, 1.0);
    }
    let price = |a: usize, b: usize, sums: &[Moments], misfit: &[f64], line: f64| {
        (sums[a].with(&sums[b]).fit().misfit - misfit[a] - misfit[b]) / line
    };
    let mut queue = BinaryHeap::with_capacity(lines.len());
    for &(a, b) in lines {
        let price = price(a, b, &sums, &misfit, length[a].of(b));
        let pair = Pair {
            price,
            ends: [a, b],
            ages: [0, 0],
        };
        queue.push(Reverse(pair));
    }
    while let Some(Reverse(pair)) = queue.pop() {
        if pair.price > LENGTH {
            break;
        }
        let [a, b] = pair.ends.map(|k| groups.find(k));
        if a == b {
            continue;
        }
        if pair.ends != [a, b] || pair.ages != [age[a], age[b]] {
            let line = length[a].of(b);
            let price = price(a, b, &sums, &misfit, line);
            let ages = [age[a], age[b]];
            queue.push(Reverse(Pair {
                price,
                ends: [a, b],
                ages,
            }));
            continue;
        }
        let (kept, gone) = if length[a].0.len() >= length[b].0.len() {
            (a, b)
        } else {
            (b, a)
        };
        groups.join(kept, gone);
        sums[kept] = sums[kept].with(&sums[gone]);
        misfit[kept] = sums[kept].fit().misfit;
        age[kept] += 1;
        length[kept].remove(gone);
        for (other, line) in std::mem::take(&mut length[gone].0) {
            if other != kept {
                length[kept].add(other, line);
                length[other].remove(gone);
                length[other].add(kept, line);
            }
        }
    }
    (0..moments.len()).map(|k| groups.find(k)).collect()
}

/// Numbers from 0 for patches that are large enough.
fn numbered(of: &[usize]) -> (Vec<Option<usize>>, usize) {
    let mut sizes = vec![0usize; of.len()];
    of.iter().for_each(|&p| sizes[p] += 1);
    let mut number = vec![None; of.len()];
    let mut count = 0;
    for (p, &size) in sizes.iter().enumerate() {
        if size >= FEWEST {
            number[p] = Some(count);
            count += 1;
        }
    }
    (of.iter().map(|&p| number[p]).collect(), count)
}

/// Leaves patches without a core to others: windows that reach over an outline see flows between those on its two sides.
fn dissolve(of: &mut [Option<usize>], count: usize, samples: &[Sample], lattice: &Lattice) {
    let mut core = vec![0usize; count];
    for (k, sample) in samples.iter().enumerate() {
        let Some(p) = of[k] else { continue };
        let around = || lattice.around(&sample.matched, 1);
        let inside = around().count() >= FEWEST && around().all(|o| of[o] == Some(p));
        core[p] += usize::from(inside);
    }
    for patch in of.iter_mut() {
        *patch = patch.filter(|&p| core[p] >= CORE);
    }
}

/// Gives each match to that of the patches around it for which χ² and line come to least.
fn straighten(
    of: &mut [Option<usize>],
    count: usize,
    samples: &[Sample],
    lattice: &Lattice,
    moments: &[Moments],
    middle: DVec2,
) {
    for _ in 0..ROUNDS {
        let mut sums = vec![Moments::default(); count];
        for (m, p) in moments.iter().zip(of.iter()) {
            if let Some(p) = *p {
                sums[p] = sums[p].with(m);
            }
        }
        let flows: Vec<Affine> = sums.iter().map(Moments::fit).collect();
        let before = of.to_vec();
        for (k, sample) in samples.iter().enumerate() {
            let near: Vec<usize> = lattice
                .around(&sample.matched, 1)
                .filter_map(|o| before[o])
                .collect();
            let cost = |p: usize| {
                let off = flows[p].displacement(sample.at(), middle) - sample.displacement();
                let others = near.iter().filter(|&&o| o != p).count();
                sample.product(off, off).min(CUT) + 0.5 * LENGTH * others as f64
            };
            let own = before[k].into_iter();
            let best = near.iter().copied().chain(own).map(|p| (cost(p), p));
            of[k] = best.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, p)| p);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::init::matches::Match;

    /// Matches over 160×120 pixels that move by `flow`, with a known error of a tenth of a pixel or so.
    fn field(flow: impl Fn(f32, f32) -> [f32; 2]) -> (Vec<Sample>, Lattice) {
        let camera = Camera::centred(160.0, 160, 120).unwrap();
        let each = (0..40 * 30).map(|k| {
            let [x, y] = [(k % 40 * 4 + 2) as f32, (k / 40 * 4 + 2) as f32];
            let [u, v] = flow(x, y);
            let off = |n: usize| 0.1 * ((n * 7919 % 101) as f32 / 50.0 - 1.0);
            let matched = Match {
                at: [x, y],
                to: [x + u + off(k), y + v + off(k + 17)],
                tensor: [3000.0, 0.0, 3000.0],
                residual: 4.0,
            };
            Sample::new(matched, &camera)
        });
        let samples: Vec<Sample> = each.collect();
        let lattice = Lattice::new(samples.iter().map(|s| &s.matched), [160, 120]);
        (samples, lattice)
    }

    #[test]
    fn one_affine_flow_is_one_patch() {
        let (samples, lattice) = field(|x, y| [0.02 * x - 1.0, 0.01 * y + 0.015 * x]);
        let (of, count) = patches(&samples, &lattice);
        assert_eq!(count, 1);
        assert!(of.iter().all(|p| *p == Some(0)));
    }

    #[test]
    fn two_flows_are_two_patches_along_the_line_between_them() {
        let inside = |x: f32, y: f32| (40.0..88.0).contains(&x) && (32.0..80.0).contains(&y);
        let (samples, lattice) = field(|x, y| match inside(x, y) {
            true => [0.8, -0.4],
            false => [0.0, 0.0],
        });
        let (of, count) = patches(&samples, &lattice);
        assert_eq!(count, 2);
        let body = of[lattice.at((16, 14)).unwrap()];
        for (sample, patch) in samples.iter().zip(&of) {
            let [x, y] = sample.matched.at;
            assert_eq!(inside(x, y), *patch == body, "({x}, {y})");
        }
    }
}
