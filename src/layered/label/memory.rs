//! The planes that labelling works on, one set for each scale.

use super::average::box_blur;
use super::data_cost::{chance_cost, charge};
use super::partition::{Outlines, Reach, Swaps};
use super::{NOBODY, saturation};
use crate::grid::Grid;
use crate::layered::scale::Scale;
use crate::spread::spread;

/// Half the side of the window over which costs are averaged while regions are planes, and, twice, what chance costs.
pub(super) const WINDOW: usize = 3;
/// What a hidden pixel is charged, in units of what it costs to match by chance.
const HIDDEN: f32 = 0.7;
/// A pixel that costs its owner more than this share of the largest cost is not explained by it.
const UNEXPLAINED: f32 = 0.6;
/// Pixels within which another region must be for such a pixel to be offered to it.
const NEAR: usize = 4;

/// Costs and what is passed from one to the other.
#[derive(Default)]
pub(in crate::layered) struct Memory {
    /// For each region what each pixel costs it, grey levels².
    pub costs: Vec<Grid<f32>>,
    pub chance: Grid<f32>,
    spare: Grid<f32>,
    swaps: Swaps,
    sizes: Vec<f32>,
}

impl Memory {
    /// Makes it as large as a scale.
    pub fn fit(&mut self, width: usize, height: usize, regions: usize) {
        let plane = || Grid::new(width, height, 0.0);
        self.costs = (0..regions).map(|_| plane()).collect();
        self.chance = plane();
        self.spare = plane();
    }

    /// What a hidden pixel is charged, at each pixel.
    pub fn find_chance(&mut self, scale: &Scale, sigma: f32) {
        chance_cost(scale, sigma, &mut self.chance);
        box_blur(&mut self.chance, WINDOW, &mut self.spare);
        box_blur(&mut self.chance, WINDOW, &mut self.spare);
        self.chance.data_mut().iter_mut().for_each(|c| *c *= HIDDEN);
    }

    /// Averages costs over a few pixels: while regions are planes, one alone tells little.
    pub fn average(&mut self) {
        for costs in &mut self.costs {
            box_blur(costs, WINDOW, &mut self.spare);
        }
    }

    /// σ of the residuals in place of costs, over the pixels that each region owns; that of the region with the most.
    pub fn spread(&mut self, labels: &Grid<u8>) -> f32 {
        let mut most = 0.0f32;
        let sizes = &mut self.sizes;
        for (k, residuals) in self.costs.iter().enumerate() {
            sizes.clear();
            let owned = labels.data().iter().zip(residuals.data());
            let owned = owned.filter(|(l, e)| usize::from(**l) == k && e.is_finite());
            sizes.extend(owned.map(|(_, e)| e));
            most = most.max(spread(sizes) as f32);
        }
        most
    }

    /// Residuals become costs.
    pub fn charge(&mut self, sigma: f32) {
        for costs in &mut self.costs {
            charge(costs, sigma);
        }
    }

    /// Labels by the costs as they are, none larger than `most`.
    pub fn partition(
        &mut self,
        outlines: &Outlines,
        most: f32,
        reach: Reach,
        labels: &mut Grid<u8>,
    ) {
        self.swaps
            .partition(&self.costs, outlines, most, reach, labels);
    }

    /// What labels cost, grey levels².
    pub fn data_energy(&self, labels: &Grid<u8>) -> f64 {
        let own = labels.data().iter().enumerate();
        own.map(|(i, &k)| f64::from(self.costs[usize::from(k)].data()[i]))
            .sum()
    }

    /// Offers pixels that their owner does not explain to the nearest other region.
    pub fn offer(&self, sigma: f32, labels: &Grid<u8>, offered: &mut Grid<u8>) {
        offered.data_mut().fill(NOBODY);
        if self.costs.len() == 1 {
            return;
        }
        let most = UNEXPLAINED * saturation(sigma);
        for y in 0..labels.height() {
            for x in 0..labels.width() {
                let owner = labels[(x, y)];
                if self.costs[usize::from(owner)][(x, y)] > most {
                    offered[(x, y)] = nearest_other(labels, x, y, owner);
                }
            }
        }
    }
}

/// The nearest region that is not `owner`.
fn nearest_other(labels: &Grid<u8>, x: usize, y: usize, owner: u8) -> u8 {
    let (mut found, mut least) = (NOBODY, usize::MAX);
    for py in y.saturating_sub(NEAR)..(y + NEAR + 1).min(labels.height()) {
        let left = x.saturating_sub(NEAR);
        let row = &labels.row(py)[left..(x + NEAR + 1).min(labels.width())];
        for (n, &label) in row.iter().enumerate() {
            if label != owner {
                let distance = (left + n).abs_diff(x).pow(2) + py.abs_diff(y).pow(2);
                if distance < least {
                    (found, least) = (label, distance);
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Costs of two regions, the second better to the right of column 30; noise that says otherwise here and there.
    fn memory() -> Memory {
        let mut memory = Memory::default();
        memory.fit(60, 40, 2);
        for y in 0..40 {
            for x in 0..60 {
                let wrong = (x * 7 + y * 13) % 11 == 0;
                let second = (x >= 30) != wrong;
                memory.costs[0][(x, y)] = if second { 10.0 } else { 1.0 };
                memory.costs[1][(x, y)] = if second { 1.0 } else { 10.0 };
            }
        }
        memory
    }

    fn wrong(labels: &Grid<u8>) -> usize {
        let each = labels.data().iter().enumerate();
        each.filter(|&(i, &l)| (l == 1) != (i % 60 >= 30)).count()
    }

    #[test]
    fn labels_follow_costs_and_noise_is_smoothed_away() {
        let mut memory = memory();
        let brightness = Grid::new(60, 40, 100.0);
        let outlines = Outlines {
            lambda: 15.0,
            brightness: &brightness,
            sigma: 1.0,
        };
        let mut labels = Grid::from_fn(60, 40, |x, _| u8::from(x >= 24));
        let energy = |memory: &Memory, l: &Grid<u8>| memory.data_energy(l) + outlines.energy(l);
        let before = energy(&memory, &labels);
        let reach = Reach { band: 8, sweeps: 2 };
        memory.partition(&outlines, 10.0, reach, &mut labels);
        assert!(wrong(&labels) < 20, "{} wrong", wrong(&labels));
        assert!(energy(&memory, &labels) < before);
    }

    #[test]
    fn what_its_owner_does_not_explain_is_offered_to_the_nearest_other() {
        let mut memory = memory();
        let most = saturation(2.0);
        memory.costs[0].data_mut().fill(0.0);
        // Two places that the background does not explain, one beside the other region.
        memory.costs[0][(28, 20)] = most;
        memory.costs[0][(5, 20)] = most;
        let labels = Grid::from_fn(60, 40, |x, _| u8::from(x >= 30));
        let mut offered = Grid::new(60, 40, 7);
        memory.offer(2.0, &labels, &mut offered);
        assert_eq!(offered[(28, 20)], 1);
        assert_eq!(offered[(5, 20)], NOBODY);
        assert_eq!(offered[(20, 20)], NOBODY);
    }
}
