//! Regions that one rigid motion explains as well.
//!
//! Two explanations of a pair of regions are compared with what they cost apart, E/σ²:
//!
//! ```text
//! one body      one motion and one surface over both, for regions that touch
//! one scene     one motion, a surface for each: a region and the background, whatever their depths
//! ```
//!
//! The motion of a scene is the background's own, or the one that matches of both agree on: a background of little relief
//! does not tell its T alone.
//!
//! Where curves are looked for, this is asked on the first scale, after the search for motions. Pairs that lose no more than
//! [`ALIKE`] are merged as one body, the pair that loses least first, then what loses no more than [`SCENERY`] with the
//! background. Curves that are drawn stay, and it is noted when the solve has ended: in noise, or where a body happens to move
//! as the background would at another depth, whoever drew it knows better. Only pairs whose matches leave it open are tried
//! then: a region of whose matches a motion explains less than [`POSSIBLE`] does not share it.

use glam::DVec3;

use super::by_matches::FEWEST;
use super::estimate::{Problem, State, Support};
use super::solver::Layered;
use super::stages::STIFFNESS;
use super::view::View;
use crate::camera::{Camera, RigidMotion};
use crate::grid::Grid;
use crate::init::{Carrier, Sample, epipolar_motion};
use crate::motion_model::MotionModel;
use crate::options::Options;

/// What one motion and surface may cost more than two, in variances of the residual: what two are charged more.
const ALIKE: f64 = 150.0;
/// What a region may cost more as scenery: in variances, and, if that is more, as a share of E, since what no motion
/// explains grows with the frame.
const SCENERY: (f64, f64) = (300.0, 0.03);
/// Gauss–Newton steps of a union at first, and then, if it is not far off; and of a surface under a given motion.
const STEPS: [usize; 2] = [3, 6];
/// How many times too much is far off.
const FAR: f64 = 6.0;
/// How many times nearer than the background, or farther, a part of the scene may be on the mean.
const NEARER: f64 = 4.5;
/// Share of a region's matches that the motion of a scene explains, or it is none.
const POSSIBLE: f64 = 0.3;
/// Pairs of neighbouring pixels from which on two regions touch.
const TOUCH: usize = 6;

impl Layered {
    /// Merges what is one, where nobody has said that it is two.
    pub(super) fn merge_regions(&mut self, options: &Options) {
        let count = self.regions.len();
        let mut lost = vec![None; count * count];
        while let Some((into, from)) = self.most_alike(&mut lost, options) {
            self.merge(into, from, options);
            for k in 0..count {
                for other in [into, from] {
                    lost[k.min(other) * count + k.max(other)] = None;
                }
            }
        }
        for k in self.scenery(options) {
            self.merge(0, k, options);
        }
    }

    /// Notes what may be one, and leaves it as it was drawn.
    pub(super) fn note_parts(&mut self, options: &Options) {
        self.regions.iter_mut().for_each(|r| r.part_of = None);
        let count = self.regions.len();
        let (samples, camera) = self.owned_matches();
        // Most bodies move in a way that the others' motions do not explain.
        let unlike = Some(f64::INFINITY);
        let mut lost = vec![None; count * count];
        for (a, b) in (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))) {
            let explains = |a: usize, b: usize| {
                let motion = self.regions[a].state.motion();
                may_explain(&motion, &samples[b], &camera)
            };
            if !explains(a, b) && (a == 0 || !explains(b, a)) {
                lost[a * count + b] = unlike;
            }
        }
        if let Some((whole, part)) = self.most_alike(&mut lost, options) {
            self.regions[part].part_of = Some(whole);
        }
        if self.regions[0].state.model.translates() {
            for k in self.scenery(options) {
                self.regions[k].part_of.get_or_insert(0);
            }
        }
    }

    /// Regions that move as the background would at another depth.
    fn scenery(&mut self, options: &Options) -> Vec<usize> {
        if self.regions.len() < 2 {
            return Vec::new();
        }
        let (samples, camera) = self.owned_matches();
        (1..self.regions.len())
            .filter(|&k| {
                self.regions[k].window.is_some() && self.is_scenery(k, &samples, &camera, options)
            })
            .collect()
    }

    /// The two touching regions that lose least as one body, if little. `lost` is what pairs are known to lose.
    fn most_alike(
        &mut self,
        lost: &mut [Option<f64>],
        options: &Options,
    ) -> Option<(usize, usize)> {
        let count = self.regions.len();
        let touch = touching(&self.labels, count);
        let mut best: Option<(f64, (usize, usize))> = None;
        for a in 0..count {
            for b in a + 1..count {
                if touch[a * count + b] < TOUCH {
                    continue;
                }
                let known = lost[a * count + b];
                let lost_here = known.unwrap_or_else(|| self.lost_as_body(a, b, options));
                lost[a * count + b] = Some(lost_here);
                if lost_here < best.map_or(ALIKE, |(least, _)| least) {
                    best = Some((lost_here, (a, b)));
                }
            }
        }
        best.map(|(_, pair)| pair)
    }

    /// What one motion and surface cost more than the two, E/σ², begun from that of the larger region and, where that
    /// is not the background, from the other's.
    fn lost_as_body(&mut self, a: usize, b: usize, options: &Options) -> f64 {
        let apart: f64 = [a, b].map(|k| self.cost_of(k, options)).iter().sum();
        let joined = joined(&self.labels, a, b);
        let variance = f64::from(self.sigma * self.sigma);
        let mut least = f64::INFINITY;
        for from in [a, b] {
            if from > 0 && a == 0 {
                continue;
            }
            let mut state = self.regions[from].state.clone();
            let free = state.model;
            for steps in STEPS {
                let found = self.tried(&joined, a, state, free, steps, options);
                least = least.min((found.1 - apart) / variance);
                // What is far off after a few steps stays so.
                if !(ALIKE..=FAR * ALIKE).contains(&least) {
                    break;
                }
                state = found.0;
            }
            if least < ALIKE {
                break;
            }
        }
        least
    }

    /// Whether region k and the background are one scene.
    fn is_scenery(
        &mut self,
        k: usize,
        samples: &[Vec<Sample>],
        camera: &Camera,
        options: &Options,
    ) -> bool {
        let own = &samples[k];
        let both = samples[0].iter().chain(own).map(|s| s.matched);
        let found = epipolar_motion(&both.collect::<Vec<_>>(), camera)
            .filter(|f| f.model == MotionModel::Full)
            .map(|f| f.motion);
        let possible = |motion: &RigidMotion| may_explain(motion, own, camera);
        let motions = [Some(self.regions[0].state.motion()), found];
        let mut motions = motions.into_iter().flatten().filter(possible).peekable();
        if motions.peek().is_none() {
            return false;
        }
        let apart: f64 = [0, k].map(|k| self.cost_of(k, options)).iter().sum();
        let labels = self.labels.clone();
        let variance = f64::from(self.sigma * self.sigma);
        let limit = (SCENERY.0 * variance).max(SCENERY.1 * apart);
        let mut least = f64::INFINITY;
        for motion in motions {
            if motion.translation == DVec3::ZERO {
                continue;
            }
            let found = [k, 0].map(|k| {
                let state = self.under(&motion, k);
                self.tried(&labels, k, state, MotionModel::Still, STEPS[1], options)
            });
            // Mean ρ is 1 in each, so that the lengths of T say how near one is beside the other.
            let [near, far] = [0, 1].map(|n| found[n].0.translation.dot(motion.translation));
            if !(near > far / NEARER && near < far * NEARER) {
                continue;
            }
            least = least.min(found[0].1 + found[1].1);
            if least - apart < limit {
                break;
            }
        }
        least - apart < limit
    }

    /// Region k under another motion, at the depth at which it moves most as it does.
    fn under(&self, motion: &RigidMotion, k: usize) -> State {
        let region = &self.regions[k];
        let direction = motion.translation.normalize_or_zero();
        let camera = &self.scales[self.level].camera;
        let own = region.state.view(camera);
        let [rest, unit] = [0.0, 0.01].map(|t| View::new(camera, motion.matrix(), direction * t));
        let (mut along, mut square) = (0.0f64, 0.0f64);
        for (x, y) in self.owned(k) {
            let place = |v: usize| ((v << self.level) + (1 << self.level) / 2) as f32;
            let rho = region.state.surface.at(place(x), place(y));
            let [u, v] = own.target(x, y, rho);
            let ([a, b], [p, q]) = (rest.target(x, y, 1.0), unit.target(x, y, 1.0));
            let (dx, dy) = (f64::from(p - a), f64::from(q - b));
            along += f64::from(u - a) * dx + f64::from(v - b) * dy;
            square += dx * dx + dy * dy;
        }
        let length = 0.01 * along / square.max(1e-12);
        let mut state = State {
            translation: direction * length,
            rotation: motion.matrix(),
            ..region.state.clone()
        };
        // The background's own relief is mostly right; that of a small region may be its mirror image.
        if k > 0 {
            state.surface.rho.iter_mut().for_each(|rho| *rho = 1.0);
        }
        state
    }

    /// E of a region as it is.
    fn cost_of(&mut self, k: usize, options: &Options) -> f64 {
        let (labels, state) = (self.labels.clone(), self.regions[k].state.clone());
        self.tried(&labels, k, state, MotionModel::Still, 0, options)
            .1
    }

    /// Region k, of other labels, after so many steps; and its E.
    fn tried(
        &mut self,
        labels: &Grid<u8>,
        k: usize,
        mut state: State,
        free: MotionModel,
        steps: usize,
        options: &Options,
    ) -> (State, f64) {
        let Some(support) = Support::around(labels, k) else {
            return (state, 0.0);
        };
        let reach = self.reach_of(k, support.window);
        state.surface = state.surface.over(self.spacing(), &reach);
        let problem = Problem {
            scale: &self.scales[self.level],
            level: self.level,
            support,
            prior: self.prior(STIFFNESS[0], self.sigma, options),
        };
        let region = &mut self.regions[k];
        region.fresh = false;
        let estimator = &mut region.estimator;
        let energy = estimator.improve(&problem, &mut state, free, steps, false);
        (state, energy)
    }

    /// Gives what region `from` owns to region `into`.
    fn merge(&mut self, into: usize, from: usize, options: &Options) {
        let labels = joined(&self.labels, into, from);
        let state = self.regions[into].state.clone();
        let free = state.model;
        let (state, _) = self.tried(&labels, into, state, free, STEPS[1], options);
        self.labels = labels;
        self.regions[into].state = state;
        self.find_windows();
    }
}

/// Whether matches leave open that they move so, at whatever depth.
fn may_explain(motion: &RigidMotion, matches: &[Sample], camera: &Camera) -> bool {
    matches.len() < FEWEST || Carrier::new(motion, camera).share_explained(matches) >= POSSIBLE
}

/// Labels with those of `from` made `into`.
fn joined(labels: &Grid<u8>, into: usize, from: usize) -> Grid<u8> {
    labels.map(|l| {
        if usize::from(l) == from {
            into as u8
        } else {
            l
        }
    })
}

/// Pairs of neighbouring pixels of regions a < b, at a · `count` + b.
fn touching(labels: &Grid<u8>, count: usize) -> Vec<usize> {
    let mut pairs = vec![0; count * count];
    let mut see = |a: u8, b: u8| {
        if a != b {
            pairs[usize::from(a.min(b)) * count + usize::from(a.max(b))] += 1;
        }
    };
    for y in 0..labels.height() {
        let row = labels.row(y);
        row.windows(2).for_each(|w| see(w[0], w[1]));
        if y + 1 < labels.height() {
            row.iter()
                .zip(labels.row(y + 1))
                .for_each(|(a, b)| see(*a, *b));
        }
    }
    pairs
}

#[cfg(test)]
mod tests;
