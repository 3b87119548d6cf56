//! Stage 3: depth pixel by pixel, for regions whose depth has steps.
//!
//! A surface over control points cannot step. A region may want depth pixel by pixel where it leaves many of its pixels
//! unexplained ([`UNEXPLAINED`]) and, if it is one of several, costs more than σ² a pixel and has matches that lie elsewhere
//! than its surface has them ([`MISPLACED`]). Then matches give its motion anew, a plane sweep its depth, and both are
//! refined (`refine/`). They are taken if they cost less than [`GAIN`] of what the surface does, in the mean over the
//! region. Often it was the motion that was wrong and not the surface: a surface through the depths found is estimated anew
//! under the motion found, and stays unless depth pixel by pixel still costs less than [`GAIN`] of it, or the two are more
//! than a pixel apart over much of the region ([`APART`]). Where the two are nowhere a pixel apart, there is no step. If
//! that surface is no better than the one before, all stays as it was.

use super::estimate::{State, Surface, most_cost};
use super::label::saturation;
use super::refine::{Refined, match_range, refine, sweep};
use super::scale::Scale;
use super::solver::Layered;
use super::stages::STIFFNESS;
use super::view::View;
use crate::frames::blur;
use crate::grid::Grid;
use crate::init::{Match, epipolar_motion, matches};
use crate::motion_model::MotionModel;
use crate::options::Options;

/// Share of a region's pixels that a surface may leave unexplained, times the number of regions, and the share of the
/// largest cost from which on a pixel is.
const UNEXPLAINED: [f64; 2] = [0.01, 0.5];
/// A region with fewer pixels than this has too few matches.
const FEWEST: usize = 2000;
/// Share of a region's matches that are more than a pixel from where a good surface has them.
const MISPLACED: f64 = 0.01;
/// What the mean cost must fall to, against the surface as it was and as it is under the motion found.
const GAIN: [f64; 2] = [0.87, 0.8];
/// Share of pixels from which on a surface that is more than a pixel off has lost its way.
const APART: f64 = 0.25;
/// Share of pixels that are so far off where depth has steps.
const STEPPED: f64 = 0.02;
/// Gauss–Newton steps of the surface under the motion found.
const STEPS: usize = 4;

impl Layered {
    /// Looks for regions that want depth pixel by pixel; whether there are any.
    pub(super) fn find_unexplained(&mut self) -> bool {
        self.unexplained = (0..self.regions.len())
            .filter(|&k| self.is_unexplained(k))
            .collect();
        !self.unexplained.is_empty()
    }

    fn is_unexplained(&self, k: usize) -> bool {
        let most = UNEXPLAINED[1] as f32 * saturation(self.label_sigma);
        let all = self.owned(k).count();
        let costs = &self.memory.costs[k];
        let bad = self.owned(k).filter(|&at| costs[at] > most).count();
        // Every outline brings hidden and shadowed pixels that no surface explains: of several regions only one that costs
        // more than noise does may want more than a surface.
        let usual = UNEXPLAINED[0] * self.regions.len() as f64;
        let noise = f64::from(self.sigma * self.sigma);
        all >= FEWEST
            && bad as f64 > usual * all as f64
            && (self.regions.len() == 1 || self.surface_cost(k) > noise)
    }

    /// Looks for depth anew where it is wanted.
    pub(super) fn refine_discontinuities(&mut self, options: &Options) {
        // Not in each other's light: what one frame alone shows is taken for a change of light, which turns depth.
        let pair = self.pair.clone();
        let frames = [pair.first(), pair.second()].map(|frame| &*frame.grey);
        let small = self.small();
        let all: Vec<Match> = if small.size == [frames[0].width(), frames[0].height()] {
            small.samples.iter().map(|s| s.matched).collect()
        } else {
            matches(frames[0], frames[1])
        };
        let camera = self.scales[0].camera;
        let smooth = frames.map(|frame| blur(frame, self.smoothing));
        let scale = Scale::new(smooth, frames.map(Grid::clone), camera);
        self.adopted = 0;
        for k in self.unexplained.clone() {
            let support = self.labels.map(|l| usize::from(l) == k);
            let own: Vec<_> = (all.iter().copied())
                .filter(|m| support[(m.at[0] as usize, m.at[1] as usize)])
                .collect();
            // Most steps of depth are at outlines: several regions have them in their labels.
            if self.regions.len() > 1 && !self.misplaces(k, &own) {
                continue;
            }
            let found = epipolar_motion(&own, &camera).filter(|f| f.model == MotionModel::Full);
            let Some((found, range)) =
                found.and_then(|f| match_range(&own, &f, &camera).map(|r| (f, r)))
            else {
                continue;
            };
            let swept = sweep(frames, &camera, &found.motion, &support, range);
            let refined = refine(&scale, &found.motion, &support, swept);
            let before = self.surface_cost(k);
            let view = View::of(&camera, &refined.motion);
            let after = self.mean_cost(k, &view, |x, y| refined.rho[(x, y)]);
            if after < GAIN[0] * before && self.adopt(k, refined, [before, after], options) {
                self.adopted += 1;
            }
        }
    }

    /// Whether some of the matches of region k are far from where its surface has them.
    fn misplaces(&self, k: usize, matches: &[Match]) -> bool {
        let state = &self.regions[k].state;
        let view = state.view(&self.scales[0].camera);
        let far = |m: &&Match| {
            let [x, y] = m.at;
            let [to_x, to_y] = view.target(x as usize, y as usize, state.surface.at(x, y));
            (to_x - m.to[0]).hypot(to_y - m.to[1]) > 1.0
        };
        matches.iter().filter(far).count() as f64 > MISPLACED * matches.len() as f64
    }

    /// Takes the motion of `refined` with a surface or with depth pixel by pixel, if that costs less; costs are those of
    /// the surface as it is and of `refined`. Whether it did.
    fn adopt(
        &mut self,
        k: usize,
        refined: Refined,
        [before, cost]: [f64; 2],
        options: &Options,
    ) -> bool {
        let spacing = self.spacing();
        let prior = self.prior(STIFFNESS[0], self.sigma, options);
        let view = View::of(&self.scales[0].camera, &refined.motion);
        let region = &mut self.regions[k];
        let own = (region.state.clone(), region.ambiguous);
        let pixels = State {
            model: MotionModel::Full,
            translation: refined.motion.translation,
            rotation: refined.motion.matrix(),
            surface: Surface::through(spacing, &refined.rho),
        };
        (region.state, region.ambiguous) = (pixels.clone(), false);
        region.fresh = false;
        self.improve_region(k, prior, STEPS, true);
        let smooth = self.surface_cost(k);
        let apart = self.share_apart(k, &view, &refined.rho);
        // If the surface is no better than the one before, the motion was not what was wrong: then depth has to show steps,
        // where outlines do not show them.
        let usual = if self.regions.len() > 1 { STEPPED } else { 0.0 };
        let better = smooth <= GAIN[0] * before;
        let stepped = if better {
            apart > 0.0 && cost < GAIN[1] * smooth
        } else {
            apart > usual
        };
        let region = &mut self.regions[k];
        let adopted = stepped || apart > APART || better;
        if stepped || apart > APART {
            region.state = pixels;
            region.dense = Some(refined.rho);
        } else if !better {
            (region.state, region.ambiguous) = own;
        }
        region.fresh = false;
        adopted
    }

    /// Share of the pixels of region k that its surface moves by more than a pixel from where `view` moves them with `rho`.
    fn share_apart(&self, k: usize, view: &View, rho: &Grid<f32>) -> f64 {
        let state = &self.regions[k].state;
        let own = state.view(&self.scales[0].camera);
        let (mut all, mut apart) = (0usize, 0usize);
        for (x, y) in self.owned(k) {
            let [a, b] = own.target(x, y, state.surface.at(x as f32, y as f32));
            let [c, d] = view.target(x, y, rho[(x, y)]);
            all += 1;
            apart += usize::from((a - c).hypot(b - d) > 1.0);
        }
        apart as f64 / all.max(1) as f64
    }

    fn surface_cost(&self, k: usize) -> f64 {
        let state = &self.regions[k].state;
        let rho = |x: usize, y: usize| state.surface.at(x as f32, y as f32);
        self.mean_cost(k, &state.view(&self.scales[0].camera), rho)
    }

    /// Mean of c(e) over the pixels of region k, grey levels²; what leaves the frame counts as unexplained.
    fn mean_cost(&self, k: usize, view: &View, rho: impl Fn(usize, usize) -> f32) -> f64 {
        let scale = &self.scales[0];
        let most = most_cost(self.sigma);
        let (mut sum, mut count) = (0.0, 0usize);
        for (x, y) in self.owned(k) {
            let [to_x, to_y] = view.target(x, y, rho(x, y));
            let cost = if scale.contains(to_x, to_y) {
                let e = scale.second.at(to_x, to_y) - scale.first[(x, y)];
                e * e * most / (most + e * e)
            } else {
                most
            };
            sum += f64::from(cost);
            count += 1;
        }
        sum / count.max(1) as f64
    }
}
