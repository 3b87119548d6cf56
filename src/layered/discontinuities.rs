//! Stage 3: depth pixel by pixel, for regions whose depth has steps.
//!
//! A surface over control points cannot step. Where a region leaves many of its pixels unexplained ([`UNEXPLAINED`]),
//! matches give its motion anew, a plane sweep its depth, and both are refined (`refine/`). The result is taken if its mean
//! cost over the region is less than [`GAIN`] of the surface's.

use super::estimate::CUT;
use super::label::saturation;
use super::refine::{match_range, refine, sweep};
use super::solver::Layered;
use crate::camera::RigidMotion;
use crate::init::{epipolar_motion, matches};
use crate::motion_model::MotionModel;
use crate::window::Window;

/// Share of a region's pixels that a surface may leave unexplained, times the number of regions, and the share of the
/// largest cost from which on a pixel is.
const UNEXPLAINED: [f64; 2] = [0.01, 0.5];
/// A region with fewer pixels than this has too few matches.
const FEWEST: usize = 2000;
/// What the mean cost must fall to.
const GAIN: f64 = 0.87;

impl Layered {
    /// Whether some region wants depth pixel by pixel.
    pub(super) fn has_discontinuities(&mut self) -> bool {
        if self.regions.len() == 1 {
            self.find_costs();
        }
        (0..self.regions.len()).any(|k| self.is_unexplained(k))
    }

    fn is_unexplained(&self, k: usize) -> bool {
        let most = UNEXPLAINED[1] as f32 * saturation(self.label_sigma);
        let owned = self.labels.data().iter().zip(self.memory.costs[k].data());
        let (mut all, mut bad) = (0usize, 0usize);
        for (_, &cost) in owned.filter(|(l, _)| usize::from(**l) == k) {
            all += 1;
            bad += usize::from(cost > most);
        }
        // Every outline brings hidden and shadowed pixels that no surface explains.
        let usual = UNEXPLAINED[0] * self.regions.len() as f64;
        all >= FEWEST && bad as f64 > usual * all as f64
    }

    /// Looks for depth anew where it is wanted.
    pub(super) fn refine_discontinuities(&mut self) {
        let wanted: Vec<usize> = (0..self.regions.len())
            .filter(|&k| self.is_unexplained(k))
            .collect();
        // Not in each other's light: matches and the sweep compare frames less their local mean.
        let frames = [self.pair.first(), self.pair.second()].map(|frame| &*frame.grey);
        let all = matches(frames[0], frames[1]);
        let camera = self.scales[0].camera;
        let mut adopted = Vec::new();
        for k in wanted {
            let support = self.labels.map(|l| usize::from(l) == k);
            let own: Vec<_> = (all.iter().copied())
                .filter(|m| support[(m.at[0] as usize, m.at[1] as usize)])
                .collect();
            let found = epipolar_motion(&own, &camera).filter(|f| f.model == MotionModel::Full);
            let Some((found, range)) =
                found.and_then(|f| match_range(&own, &f, &camera).map(|r| (f, r)))
            else {
                continue;
            };
            let swept = sweep(frames, &camera, &found.motion, &support, range);
            let refined = refine(frames, &camera, &swept.motion, &support, swept.rho);
            let surface = &self.regions[k].state.surface;
            let before = self.mean_cost(k, &self.regions[k].state.motion(), |x, y| {
                surface.at(x as f32, y as f32)
            });
            let after = self.mean_cost(k, &refined.motion, |x, y| refined.rho[(x, y)]);
            if after < GAIN * before {
                adopted.push((k, refined));
            }
        }
        for (k, refined) in adopted {
            let region = &mut self.regions[k];
            region.state.translation = refined.motion.translation;
            region.state.rotation = refined.motion.matrix();
            region.model = MotionModel::Full;
            region.ambiguous = false;
            region.dense = Some(refined.rho);
            region.fresh = false;
        }
    }

    /// Mean of c(e) over the pixels of region k, grey levels²; what leaves the frame counts as unexplained.
    fn mean_cost(&self, k: usize, motion: &RigidMotion, rho: impl Fn(usize, usize) -> f32) -> f64 {
        let scale = &self.scales[0];
        let mut state = self.regions[k].state.clone();
        state.translation = motion.translation;
        state.rotation = motion.matrix();
        let target = state.pose().target(scale);
        let Some(Window {
            left,
            top,
            width,
            height,
        }) = self.regions[k].window
        else {
            return f64::INFINITY;
        };
        let most = (CUT * self.sigma).powi(2);
        let (mut sum, mut count) = (0.0, 0usize);
        for y in top..top + height {
            for x in left..left + width {
                if usize::from(self.labels[(x, y)]) != k {
                    continue;
                }
                let (to_x, to_y) = target.of(x, y, rho(x, y));
                let cost = if scale.contains(to_x, to_y) {
                    let e = scale.brightness(to_x, to_y) - scale.first[(x, y)];
                    e * e * most / (most + e * e)
                } else {
                    most
                };
                sum += f64::from(cost);
                count += 1;
            }
        }
        sum / count.max(1) as f64
    }
}
