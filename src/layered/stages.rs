//! The stages of a rigid pass: estimate motion and surface, then the surface alone, then label.
//!
//! Motion is found under weak charges for curvature and held, then the surface under strong ones: weak ones alone leave
//! depth rough, strong ones alone turn T, since smoothness prefers the T that needs the least relief.

use super::estimate::{Prior, Problem, Support, surface_energy};
use super::label::{Occlusion, Outlines, Reach, drop_small_components, rigid_residual, saturation};
use super::solver::{Layered, Phase};
use crate::motion_model::MotionModel;
use crate::options::Options;
use crate::solver::Weights;
use crate::spread::LEAST_SIGMA;
use crate::window::{Window, places};

/// What curvature is charged while motion is found, and for depth, in variances of the residual, px².
pub(super) const STIFFNESS: [f64; 2] = [1e5, 1e6];
/// Gauss–Newton steps of motion with depth, and of depth alone.
const STEPS: usize = 2;
/// A region with more pixels than this shows which motion it has on the next coarser scale.
const LARGE: usize = 20_000;
/// λ in units of the largest cost of a pixel, per pixel of length: while regions are planes, and from then on.
const LENGTH: [f32; 2] = [0.2, 1.5];
/// How far labels move while regions are planes, on coarse scales, and on the finest.
const REACH: [Reach; 3] = [
    Reach { band: 8, sweeps: 2 },
    Reach { band: 4, sweeps: 1 },
    Reach { band: 3, sweeps: 1 },
];

impl Layered {
    /// Where regions are.
    pub(super) fn find_windows(&mut self) {
        let (width, height) = (self.labels.width(), self.labels.height());
        let (labels, offered) = (self.labels.data(), self.offered.data());
        for (k, region) in self.regions.iter_mut().enumerate() {
            let owns = |i: usize| usize::from(labels[i]) == k;
            region.window = Window::around(width, height, owns);
            let reach = |i: usize| owns(i) || usize::from(offered[i]) == k;
            region.reach = Window::around(width, height, reach);
            region.fresh = false;
        }
    }

    /// The pixels that region k owns, row by row.
    pub(super) fn owned(&self, k: usize) -> impl Iterator<Item = (usize, usize)> {
        let window = self.regions[k].window;
        let pixels = window.map_or_else(|| places(0..0, 0..0), Window::pixels);
        pixels.filter(move |&at| usize::from(self.labels[at]) == k)
    }

    /// The window of the finest scale over which the surface of region k reaches: two cells beyond what it owns, the
    /// background's over all.
    pub(super) fn reach_of(&self, k: usize, window: Window) -> Window {
        let (width, height) = (self.pair.width(), self.pair.height());
        if k == 0 {
            return Window::whole(width, height);
        }
        let (level, margin) = (self.level, 2 * self.spacing());
        let first = |edge: usize| (edge << level).saturating_sub(margin);
        let last = |edge: usize, most: usize| ((edge << level) + margin).min(most);
        let (left, top) = (first(window.left), first(window.top));
        Window {
            left,
            top,
            width: last(window.left + window.width, width) - left,
            height: last(window.top + window.height, height) - top,
        }
    }

    /// Surfaces over where regions are now.
    pub(super) fn fit_surfaces(&mut self) {
        for k in 0..self.regions.len() {
            if let Some(window) = self.regions[k].reach {
                let reach = self.reach_of(k, window);
                let spacing = self.spacing();
                let surface = &mut self.regions[k].state.surface;
                *surface = surface.over(spacing, &reach);
                self.regions[k].fresh = false;
            }
        }
    }

    /// Takes a first step, and measures σ of what it leaves.
    pub(super) fn measure_sigma(&mut self, options: &Options) {
        self.improve(STIFFNESS[0], 1, true, options);
        let owned = self.regions.iter().filter(|r| r.window.is_some());
        self.sigma = owned
            .map(|r| r.estimator.equations.spread)
            .fold(LEAST_SIGMA as f32, f32::max);
        self.regions.iter_mut().for_each(|r| r.fresh = false);
    }

    /// Stage 1: motion and surface of every region.
    pub(super) fn estimate(&mut self, options: &Options) {
        self.improve(STIFFNESS[0], STEPS, true, options);
    }

    /// Stage 1, the surface alone, motion held.
    pub(super) fn estimate_depth(&mut self, options: &Options) {
        self.improve(STIFFNESS[1], STEPS, false, options);
        let prior = self.prior(STIFFNESS[1], self.sigma, options);
        let owned = self.regions.iter().filter(|r| r.window.is_some());
        self.energy.smoothness = (owned.clone())
            .map(|r| surface_energy(&r.state.surface, &prior))
            .sum();
        self.energy.data = owned.map(|r| r.estimator.equations.cost).sum();
    }

    fn improve(&mut self, stiffness: f64, steps: usize, moving: bool, options: &Options) {
        let prior = self.prior(stiffness, self.sigma, options);
        for k in 0..self.regions.len() {
            self.improve_region(k, prior, steps, moving);
        }
    }

    /// Up to `steps` steps of region k's surface, and of its motion where `moving`.
    pub(super) fn improve_region(&mut self, k: usize, prior: Prior, steps: usize, moving: bool) {
        let region = &mut self.regions[k];
        let Some(window) = region.reach.filter(|_| region.window.is_some()) else {
            return;
        };
        let problem = Problem {
            scale: &self.scales[self.level],
            level: self.level,
            support: Support {
                offered: Some(&self.offered),
                ..Support::of(&self.labels, k, window)
            },
            prior,
        };
        let free = if moving {
            region.state.model
        } else {
            MotionModel::Still
        };
        let (state, fresh) = (&mut region.state, region.fresh);
        region
            .estimator
            .improve(&problem, state, free, steps, fresh);
        region.fresh = true;
    }

    /// Compares the motion models that are left.
    pub(super) fn select_models(&mut self, options: &Options) {
        let prior = self.prior(STIFFNESS[0], self.sigma, options);
        for k in 0..self.regions.len() {
            let (level, labels) = self.scale_for(k, LARGE);
            let Some(support) = Support::around(&labels, k) else {
                continue;
            };
            let region = &mut self.regions[k];
            let problem = Problem {
                scale: &self.scales[level],
                level,
                support,
                prior,
            };
            let own = &region.state.surface;
            let (spacing, reach) = (own.spacing, own.window());
            let mut given = vec![region.state.clone()];
            for mut other in region.alternatives.drain(..) {
                other.surface = other.surface.over(spacing, &reach);
                given.push(other);
            }
            let select = options.model_selection;
            let (found, ambiguous) = problem.select(given, select, &mut region.estimator);
            region.ambiguous = ambiguous;
            if let Some(best) = found.into_iter().next() {
                region.state = best.state;
            }
            region.fresh = false;
        }
    }

    /// Stage 2: labels.
    pub(super) fn label(&mut self, options: &Options) {
        let (scale, level) = (&self.scales[self.level], self.level);
        for (region, residuals) in self.regions.iter().zip(&mut self.memory.costs) {
            rigid_residual(scale, level, region, residuals);
        }
        if !matches!(self.phase, Phase::Rigid(done) if done > 0) {
            self.label_sigma = self.memory.spread(&self.labels).max(LEAST_SIGMA as f32);
        }
        self.memory.charge(self.label_sigma);
        let occlusion = (options.occlusion && self.regions.len() > 1).then(|| {
            let states = self.regions.iter().map(|r| &r.state);
            Occlusion::of(scale, level, states, &self.labels)
        });
        if let Some(occlusion) = occlusion {
            self.memory.find_chance(scale, self.label_sigma);
            let background = &self.regions[0].state;
            let (chance, costs) = (&self.memory.chance, &mut self.memory.costs[0]);
            let hides = occlusion.excuse(scale, level, background, chance, costs);
            for (region, hides) in self.regions.iter_mut().zip(hides) {
                region.hides = hides;
            }
        }
        self.share_out(true, options);
        self.fit_surfaces();
    }

    /// Gives every pixel to a region by the costs in memory: of planes, or of rigid motions.
    pub(super) fn share_out(&mut self, rigid: bool, options: &Options) {
        if !rigid {
            self.memory.average();
        }
        let sigma = if rigid { self.label_sigma } else { self.sigma };
        let most = saturation(sigma);
        let lambda = match options.lambda {
            Some(lambda) => lambda as f32,
            None => LENGTH[usize::from(rigid)] * most,
        };
        self.weights = Weights {
            mu: self.prior(STIFFNESS[1], self.sigma, options).mu,
            lambda: f64::from(lambda),
            sigma: f64::from(self.sigma),
        };
        if self.regions.len() > 1 {
            let outlines = Outlines {
                lambda,
                brightness: &self.scales[self.level].plain,
                sigma,
            };
            let (memory, labels) = (&mut self.memory, &mut self.labels);
            let reach = match (rigid, self.level) {
                (false, _) => REACH[0],
                (true, 0) => REACH[2],
                (true, _) => REACH[1],
            };
            memory.partition(&outlines, most, reach, labels);
            if rigid && self.level == 0 {
                drop_small_components(labels);
            }
            self.energy.length = outlines.energy(labels);
        }
        if self.regions.len() > 1 || !rigid {
            self.energy.data = self.memory.data_energy(&self.labels);
        }
        if rigid {
            let memory = &self.memory;
            memory.offer(self.label_sigma, &self.labels, &mut self.offered);
        }
        self.find_windows();
    }
}
