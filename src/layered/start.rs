//! The first scale: regions as planes, then candidate motions.
//!
//! A drawn circle covers only a part of its object and may miss some of it. Planes have eight numbers and reach as far as
//! they fit, so that in a few rounds of fitting and labelling each curve finds the outline of what it was drawn on.

use super::estimate::{Blocks, Degree, PlanarFlow, Problem, Support, Surface};
use super::label::{coarsened, planar_cost};
use super::solver::Layered;
use super::stages::STIFFNESS;
use crate::grid::Grid;
use crate::options::Options;

/// Rounds in which curves have six numbers instead of eight: a part of an object tells no more.
const AFFINE_ROUNDS: usize = 3;
/// Gauss–Newton steps of a planar fit.
const STEPS: usize = 3;
/// A region with more pixels than this at the first scale shows its motion on the next coarser one.
const LARGE: usize = 8000;
/// Least σ of a planar fit in the search, grey levels.
const LEAST_SIGMA: f32 = 0.7;

impl Layered {
    /// Fits a plane to every region.
    pub(super) fn fit_planes(&mut self, round: usize) {
        let coarse = (self.level + 1).min(self.scales.len() - 1);
        let half = coarsened(&self.labels, coarse - self.level);
        for (k, region) in self.regions.iter_mut().enumerate() {
            let Some(window) = region.window else {
                continue;
            };
            if round == 0
                && let Some(support) = Support::around(&half, k)
            {
                let scale = &self.scales[coarse];
                region.flow = PlanarFlow::search(scale, &support);
                region.flow.fit(scale, &support, Degree::Shift, STEPS);
                region.flow.fit(scale, &support, Degree::Affine, STEPS + 1);
            }
            let degree = if round < AFFINE_ROUNDS && k > 0 {
                Degree::Affine
            } else {
                Degree::Plane
            };
            let support = Support::of(&self.labels, k, window);
            region
                .flow
                .fit(&self.scales[self.level], &support, degree, STEPS);
        }
    }

    /// Labels by what planes leave unexplained.
    pub(super) fn label_planes(&mut self, round: usize, options: &Options) {
        if round < 2 {
            let owned = self.regions.iter().filter(|r| r.window.is_some());
            self.sigma = owned.map(|r| r.flow.sigma).fold(1.0, f32::max);
        }
        let scale = &self.scales[self.level];
        for (region, costs) in self.regions.iter().zip(&mut self.memory.costs) {
            planar_cost(scale, region, self.sigma, costs);
        }
        self.energy.smoothness = 0.0;
        self.share_out(false, options);
    }

    /// Motion, model and surface of every region from scratch.
    pub(super) fn search_motions(&mut self, options: &Options) {
        let select = options.model_selection;
        for k in 0..self.regions.len() {
            let Some(window) = self.regions[k].window else {
                continue;
            };
            let flow = self.regions[k].flow;
            let sigma = flow.sigma.max(LEAST_SIGMA);
            let support = Support::of(&self.labels, k, window);
            let blocks = Blocks::gather(self.here(), &support, &flow);
            let (level, labels) = self.scale_for(k, LARGE);
            let Some(support) = Support::around(&labels, k) else {
                continue;
            };
            let flat = Surface::flat(2 * self.spacing(), &self.reach_of(k, window));
            let problem = Problem {
                scale: &self.scales[level],
                level,
                support,
                prior: self.prior(STIFFNESS[0], sigma, options),
            };
            let region = &mut self.regions[k];
            let (found, ambiguous) = problem.search(&blocks, flat, select, &mut region.estimator);
            region.ambiguous = ambiguous;
            region.fresh = false;
            region.dense = None;
            let mut found = found.into_iter();
            if let Some(best) = found.next() {
                region.state = best.state;
            }
            region.alternatives = found.map(|c| c.state).collect();
        }
        self.fit_surfaces();
        self.measure_sigma(options);
        self.estimate(options);
    }

    /// On which scale region k shows its motion: the one at work, or the next coarser one if it has more than `large`
    /// pixels; and the labels there.
    pub(super) fn scale_for(&self, k: usize, large: usize) -> (usize, Grid<u8>) {
        let owned = self.labels.data().iter().filter(|&&l| usize::from(l) == k);
        let up = usize::from(owned.count() > large && self.level + 1 < self.scales.len());
        (self.level + up, coarsened(&self.labels, up))
    }
}
