//! One region of the coarse-to-fine solver: its motion, its own inverse depth, and the steps that improve
//! them.

use glam::{DQuat, DVec3};

use super::evidence::Evidence;
use crate::camera::RigidMotion;
use crate::depth::{Bends, FieldPrior, Plane};
use crate::grid::Grid;
use crate::motion::{Joint, JointStep, Kind, held, solve_positive};
use crate::warp::{Linearisation, RESIDUAL, Scale};
use crate::window::Window;

/// Inverse depth is kept between these; the region's mean is 1.
pub(super) const RHO_RANGE: [f32; 2] = [0.02, 20.0];
/// Angle, in radians, by which a step turns a motion that does not stand still: a fiftieth of a degree.
const TURNS: f64 = 3.5e-4;
/// Pixels over which a surface's slope is taken for the same.
const SLOPE: f64 = 8.0;
/// The share of μ under which a motion is found that depth does not hold.
const FREE: f64 = 0.01;

/// A region.
#[derive(Clone, Debug)]
pub(super) struct Region {
    pub motion: RigidMotion,
    pub kind: Kind,
    pub rho: Grid<f32>,
    /// What the smoothness of its depth counts, as a share of μ.
    pub stiffness: f64,
    /// How much brighter its pixels become: bodies turn under their lamps. Grey levels.
    pub shade: Grid<f32>,
}

impl Region {
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            motion: RigidMotion::default(),
            kind: Kind::Full,
            stiffness: 1.0,
            rho: Grid::new(width, height, 1.0),
            shade: Grid::new(width, height, 0.0),
        }
    }

    /// The same with depth in `window` alone.
    pub fn cropped(&self, window: &Window) -> Self {
        Self {
            rho: window.crop(&self.rho),
            shade: window.crop(&self.shade),
            ..*self
        }
    }

    /// The constraint around what it is at present, for depth in `window` alone.
    pub fn linearise(&self, scale: &Scale, window: Window) -> Linearisation {
        let mut line = scale.linearise(&self.motion, &self.rho, window);
        for (row, shade) in line.rows.data_mut().iter_mut().zip(self.shade.data()) {
            row[RESIDUAL] -= shade;
        }
        line
    }

    /// Takes over what has been found in `window`; beyond it depth goes on as the plane does that fits it
    /// best where it is `certain`.
    pub fn take(&mut self, part: &Self, window: &Window, certain: &Grid<f32>) {
        let plane = Plane::fit(&part.rho, certain);
        let (left, top) = (window.left as f64, window.top as f64);
        self.rho = Grid::from_fn(self.rho.width(), self.rho.height(), |x, y| {
            let rho = plane.at(x as f64 - left, y as f64 - top) as f32;
            rho.clamp(RHO_RANGE[0], RHO_RANGE[1])
        });
        window.paste(&part.rho, &mut self.rho);
        self.shade.data_mut().fill(0.0);
        window.paste(&part.shade, &mut self.shade);
        self.motion = part.motion;
        self.kind = part.kind;
        self.stiffness = part.stiffness;
    }

    /// A Gauss–Newton step of (T, ω) with depth held as it is: robust while nothing is known of depth.
    pub fn fit_flat(&mut self, evidence: &Evidence) {
        let linearisation = evidence.linearise(self);
        let weight = evidence.weights(&linearisation);
        let mut normal = [[0.0; 6]; 6];
        let mut right = [0.0; 6];
        for (row, &w) in linearisation.rows.data().iter().zip(weight.data()) {
            if w > 0.0 {
                for i in 0..6 {
                    let wb = f64::from(w * row[1 + i]);
                    right[i] -= wb * f64::from(row[RESIDUAL]);
                    for j in 0..=i {
                        normal[i][j] += wb * f64::from(row[1 + j]);
                    }
                }
            }
        }
        let prior = 4.0 * evidence.rotation_prior();
        let w = self.motion.rotation.to_array();
        for i in 0..3 {
            normal[i][i] *= 1.0 + 1e-6;
            normal[3 + i][3 + i] += prior;
            right[3 + i] -= prior * w[i];
        }
        if let Some(x) = solve_positive(&normal, &right) {
            let x = held(x, evidence.longest());
            let turn = DQuat::from_scaled_axis(DVec3::new(x[3], x[4], x[5]));
            self.motion = RigidMotion {
                translation: turn * self.motion.translation + DVec3::new(x[0], x[1], x[2]),
                rotation: (turn * DQuat::from_scaled_axis(self.motion.rotation)).to_scaled_axis(),
            };
        }
    }

    /// Motion and depth together: one joint step.
    fn fit_jointly(&mut self, evidence: &Evidence, prior: &FieldPrior) {
        let step = self.joint_step(evidence, prior);
        self.motion = step.motion;
        if self.kind.translates() {
            self.add_depth(step.depth_step.data().iter().copied());
        }
    }

    /// Motion by a joint step in which depth is all but free, then depth alone, as smooth as it is to be. Where depth leaps,
    /// smoothness has T turn until leaps are smaller, by several degrees.
    fn fit_in_turn(&mut self, evidence: &Evidence, prior: &FieldPrior) {
        let free = FieldPrior {
            strength: FREE * prior.strength,
            ..prior.clone()
        };
        self.motion = self.joint_step(evidence, &free).motion;
        self.fit_depth(evidence, prior);
    }

    fn joint_step(&self, evidence: &Evidence, prior: &FieldPrior) -> Joint {
        let linearisation = evidence.linearise(self);
        let weight = evidence.fitting_weights(&linearisation);
        let bends = self.bends(&linearisation, evidence, &weight);
        let edges = prior.edges(&bends);
        let (data, force) = self.data_term(&linearisation, &weight, evidence, prior);
        JointStep {
            rows: &linearisation.rows,
            weight: &weight,
            system: &edges.system(weight.width(), weight.height(), data.clone().into_vec()),
            data: &data,
            force: &force,
            pull: &edges.pull(&bends),
            surface: evidence.surface.as_ref(),
            rotation_prior: evidence.rotation_prior(),
            kind: self.kind,
            keeps_shown: evidence.leaps,
            longest: evidence.longest(),
        }
        .solve(&self.motion)
    }

    /// Steps of motion and depth: `least`, and up to `most` while T still turns, or ω changes, by [`TURNS`] and more. How deep relief is
    /// and how far a body turns creep together, which takes dozens where two views hardly tell them apart.
    pub fn fit(&mut self, evidence: &Evidence, prior: &FieldPrior, [least, most]: [usize; 2]) {
        for taken in 1..=most {
            let before = self.motion;
            if evidence.leaps {
                self.fit_in_turn(evidence, prior);
            } else {
                self.fit_jointly(evidence, prior);
            }
            self.normalise(&evidence.owned);
            // T = 0 has no direction: not a number, which `max` leaves out.
            let turned = before.translation.angle_between(self.motion.translation);
            let turned = turned.max((self.motion.rotation - before.rotation).length());
            if taken >= least && turned < TURNS {
                break;
            }
        }
    }

    /// Depth alone, for the motion as it is.
    pub fn fit_depth(&mut self, evidence: &Evidence, prior: &FieldPrior) {
        if !self.kind.translates() {
            return;
        }
        let linearisation = evidence.linearise(self);
        let weight = evidence.fitting_weights(&linearisation);
        let bends = self.bends(&linearisation, evidence, &weight);
        let edges = prior.edges(&bends);
        let (data, force) = self.data_term(&linearisation, &weight, evidence, prior);
        let system = edges.system(weight.width(), weight.height(), data.into_vec());
        let smoothing = edges.pull(&bends);
        let right = force.data().iter().zip(smoothing.data());
        let right: Vec<[f32; 1]> = right.map(|(f, p)| [f + p]).collect();
        let mut step = vec![[0.0f32; 1]; right.len()];
        system.solve(&right, &mut step, 1e-3, 20);
        self.add_depth(step.into_iter().map(|[d]| d));
    }

    /// What a change of ρ costs besides smoothness, ω a² + κ, and how data and the prior of relief pull on ρ as it is,
    /// −(ω a r + κ (ρ − 1)).
    fn data_term(
        &self,
        linearisation: &Linearisation,
        weight: &Grid<f32>,
        evidence: &Evidence,
        prior: &FieldPrior,
    ) -> (Grid<f32>, Grid<f32>) {
        let mut data = certainty(linearisation, weight);
        let mut force = weight.clone();
        for (i, (d, f)) in data.data_mut().iter_mut().zip(force.data_mut()).enumerate() {
            let row = &linearisation.rows.data()[i];
            let relief = prior.relief as f32 * evidence.owned.data()[i];
            *d += relief;
            *f = relief * (1.0 - self.rho.data()[i]) - *f * row[0] * row[RESIDUAL];
        }
        (data, force)
    }

    /// What the relief of the owned pixels costs.
    pub fn relief_energy(&self, prior: &FieldPrior, evidence: &Evidence) -> f64 {
        let owned = evidence.owned.data().iter().zip(self.rho.data());
        prior.relief
            * owned
                .map(|(&w, &rho)| f64::from(w * (rho - 1.0).powi(2)))
                .sum::<f64>()
    }

    /// Mean ρ over the owned pixels back to 1, T with it; turned round if most of it is behind the camera.
    pub fn normalise(&mut self, owned: &Grid<f32>) {
        let (mut sum, mut count) = (0.0f64, 0.0f64);
        for (&rho, &w) in self.rho.data().iter().zip(owned.data()) {
            sum += f64::from(rho * w);
            count += f64::from(w);
        }
        if count < 1.0 || sum.abs() < 1e-3 * count {
            return;
        }
        let mean = sum / count;
        self.motion.translation *= mean;
        for rho in self.rho.data_mut() {
            *rho = (*rho / mean as f32).clamp(RHO_RANGE[0], RHO_RANGE[1]);
        }
    }

    /// How ρ departs from the surfaces that are free, or from its own slope: what is smoothed.
    pub fn bends(
        &self,
        linearisation: &Linearisation,
        evidence: &Evidence,
        weight: &Grid<f32>,
    ) -> Bends {
        let owned = &evidence.owned;
        match evidence.uncharged() {
            Some(surface) => {
                Bends::about_slope(&surface.departure(&self.rho), owned, [0.0; 2], SLOPE)
            }
            None => {
                let plane = Plane::fit(&self.rho, &certainty(linearisation, weight));
                Bends::about_slope(&self.rho, owned, plane.slope(), SLOPE)
            }
        }
    }

    fn add_depth(&mut self, step: impl Iterator<Item = f32>) {
        for (rho, d) in self.rho.data_mut().iter_mut().zip(step) {
            // No more than half of what is there: the linearisation holds no further.
            let limit = 0.5 * *rho + 0.1;
            *rho = (*rho + d.max(-limit).min(limit)).clamp(RHO_RANGE[0], RHO_RANGE[1]);
        }
    }
}

/// ω a²: how far the pixels tell depth.
pub(super) fn certainty(linearisation: &Linearisation, weight: &Grid<f32>) -> Grid<f32> {
    let mut certain = weight.clone();
    for (c, row) in certain.data_mut().iter_mut().zip(linearisation.rows.data()) {
        *c *= row[0] * row[0];
    }
    certain
}
