//! The planes that labelling works on, one set for each scale.

use super::NOBODY;
use super::data_cost::{chance_cost, charge};
use super::partition::{argmin, box_blur, outline_energy, partition, pull};
use crate::grid::Grid;
use crate::layered::estimate::saturation;
use crate::layered::scale::Scale;
use crate::spread::spread;

/// Half the side of the window over which costs are averaged while regions are planes, and, twice, what chance costs.
pub(super) const WINDOW: usize = 3;
/// What a hidden pixel is charged, in units of what it costs to match by chance.
const HIDDEN: f32 = 0.7;
/// Half the side of the window, twice, of the costs that a coarse scale starts from.
const RESTART_WINDOW: usize = 2;
/// A pixel that costs its owner more than this share of the largest cost is not explained by it.
const UNEXPLAINED: f32 = 0.6;
/// The least K ∗ 1k under which such a pixel is offered to region k.
const NEAR: f32 = 0.01;

/// Costs, pulls and what is passed from one to the other.
pub(in crate::layered) struct Memory {
    /// For each region what each pixel costs it, grey levels².
    pub costs: Vec<Grid<f32>>,
    /// For each region K ∗ 1k.
    pub pulls: Vec<Grid<f32>>,
    pub chance: Grid<f32>,
    spare: Grid<f32>,
    sizes: Vec<f32>,
}

impl Default for Memory {
    fn default() -> Self {
        let empty = Grid::new(0, 0, 0.0);
        Self {
            costs: Vec::new(),
            pulls: Vec::new(),
            chance: empty.clone(),
            spare: empty,
            sizes: Vec::new(),
        }
    }
}

impl Memory {
    /// Makes it as large as a scale.
    pub fn fit(&mut self, width: usize, height: usize, regions: usize) {
        let plane = || Grid::new(width, height, 0.0);
        self.costs = (0..regions).map(|_| plane()).collect();
        self.pulls = (0..regions).map(|_| plane()).collect();
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

    /// Labels by the costs as they are; `anew` starts from the least cost in a wide window instead of the labels.
    pub fn partition(&mut self, beta: f32, anew: bool, labels: &mut Grid<u8>) {
        if anew {
            for (costs, wide) in self.costs.iter().zip(&mut self.pulls) {
                wide.data_mut().copy_from_slice(costs.data());
                box_blur(wide, RESTART_WINDOW, &mut self.spare);
                box_blur(wide, RESTART_WINDOW, &mut self.spare);
            }
            argmin(&self.pulls, labels);
        }
        partition(&self.costs, beta, labels, &mut self.pulls, &mut self.spare);
    }

    /// What labels cost, and their outlines; also brings the pulls up to date.
    pub fn energy(&mut self, beta: f32, labels: &Grid<u8>) -> [f64; 2] {
        pull(labels, &mut self.pulls, &mut self.spare);
        let own = labels.data().iter().enumerate();
        let data = own.map(|(i, &k)| f64::from(self.costs[usize::from(k)].data()[i]));
        [data.sum(), outline_energy(labels, &self.pulls, beta)]
    }

    /// Offers pixels that their owner does not explain to the nearest other region.
    pub fn offer(&self, sigma: f32, labels: &Grid<u8>, offered: &mut Grid<u8>) {
        offered.data_mut().fill(NOBODY);
        if self.costs.len() == 1 {
            return;
        }
        let most = UNEXPLAINED * saturation(sigma);
        for (i, (&owner, offered)) in labels.data().iter().zip(offered.data_mut()).enumerate() {
            if self.costs[usize::from(owner)].data()[i] <= most {
                continue;
            }
            let mut nearest = NEAR;
            for (k, pull) in self.pulls.iter().enumerate() {
                if k != usize::from(owner) && pull.data()[i] > nearest {
                    nearest = pull.data()[i];
                    *offered = k as u8;
                }
            }
        }
    }
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
        for anew in [false, true] {
            let mut memory = memory();
            let mut labels = Grid::from_fn(60, 40, |x, _| u8::from(x >= 24));
            let before = memory.energy(10.0, &labels);
            memory.partition(10.0, anew, &mut labels);
            assert!(wrong(&labels) < 60, "{anew}: {} wrong", wrong(&labels));
            let after = memory.energy(10.0, &labels);
            assert!(after[0] + after[1] < before[0] + before[1]);
        }
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
        memory.energy(1.0, &labels);
        let mut offered = Grid::new(60, 40, 7);
        memory.offer(2.0, &labels, &mut offered);
        assert_eq!(offered[(28, 20)], 1);
        assert_eq!(offered[(5, 20)], NOBODY);
        assert_eq!(offered[(20, 20)], NOBODY);
    }
}
