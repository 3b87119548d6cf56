//! The steps that improve one region: motion by itself, motion and depth together or in turn, depth by itself.
//!
//! Each starts from the constraint around what the region is at present and solves one linear system: `motion/joint.rs`
//! for both, the one of `depth/region_field.rs` for depth. None looks whether it has gained; passes go on until all stands
//! still (`history.rs`).

use glam::{DQuat, DVec3};

use super::evidence::Evidence;
use super::region::{RHO_RANGE, Region, certainty};
use crate::camera::RigidMotion;
use crate::depth::{Bends, Edges, Elliptic, FieldPrior};
use crate::grid::Grid;
use crate::motion::{Joint, JointStep, Kind, held, solve_positive};
use crate::warp::{Linearisation, RESIDUAL};

/// Angle, in radians, by which a step turns a motion that does not stand still: a fiftieth of a degree.
const TURNS: f64 = 3.5e-4;
/// The share of μ under which a motion is found that depth does not hold.
const FREE: f64 = 0.01;

/// What a step of a region starts from.
struct Footing {
    linearisation: Linearisation,
    weight: Grid<f32>,
    bends: Bends,
    edges: Edges,
    /// What a change of ρ costs besides smoothness, and how data and the prior of relief pull on ρ.
    data: Grid<f32>,
    force: Grid<f32>,
}

impl Footing {
    fn system(&self) -> Elliptic {
        let (width, height) = (self.weight.width(), self.weight.height());
        self.edges.system(width, height, self.data.data().to_vec())
    }
}

impl Region {
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
        self.motion = self.joint_step(evidence, &prior.softened(FREE)).motion;
        self.fit_depth(evidence, prior);
    }

    fn joint_step(&self, evidence: &Evidence, prior: &FieldPrior) -> Joint {
        let at = self.footing(evidence, prior);
        JointStep {
            rows: &at.linearisation.rows,
            weight: &at.weight,
            system: &at.system(),
            data: &at.data,
            force: &at.force,
            pull: &at.edges.pull(&at.bends),
            surface: evidence.surface.as_ref(),
            rotation_prior: evidence.rotation_prior(),
            kind: self.kind,
            keeps_shown: evidence.leaps,
            longest: evidence.longest(),
        }
        .solve(&self.motion)
    }

    /// Steps of motion and depth: `least`, and up to `most` while T still turns, or ω changes, by [`TURNS`] and more. How
    /// deep relief is and how far a body turns creep together, which takes dozens where two views hardly tell them apart.
    pub fn fit(&mut self, evidence: &Evidence, prior: &FieldPrior, [least, most]: [usize; 2]) {
        if self.kind == Kind::Still {
            return;
        }
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
        let at = self.footing(evidence, prior);
        let smoothing = at.edges.pull(&at.bends);
        let right = at.force.data().iter().zip(smoothing.data());
        let right: Vec<[f32; 1]> = right.map(|(f, p)| [f + p]).collect();
        let mut step = vec![[0.0f32; 1]; right.len()];
        at.system().solve(&right, &mut step, 1e-3, 20);
        self.add_depth(step.into_iter().map(|[d]| d));
    }

    fn footing(&self, evidence: &Evidence, prior: &FieldPrior) -> Footing {
        let linearisation = evidence.linearise(self);
        let weight = evidence.fitting_weights(&linearisation);
        let bends = self.bends(&linearisation, evidence, &weight);
        let (data, force) = self.data_term(&linearisation, &weight, evidence, prior);
        Footing {
            edges: prior.edges(&bends),
            linearisation,
            weight,
            bends,
            data,
            force,
        }
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

    fn add_depth(&mut self, step: impl Iterator<Item = f32>) {
        for (rho, d) in self.rho.data_mut().iter_mut().zip(step) {
            // No more than half of what is there: the linearisation holds no further.
            let limit = 0.5 * *rho + 0.1;
            *rho = (*rho + d.max(-limit).min(limit)).clamp(RHO_RANGE[0], RHO_RANGE[1]);
        }
    }
}
