//! One region of the coarse-to-fine solver: its motion, its own inverse depth, and the steps that improve
//! them.

use glam::{DQuat, DVec3};

use super::evidence::Evidence;
use crate::camera::RigidMotion;
use crate::depth::{FieldPrior, fitted_plane};
use crate::grid::Grid;
use crate::motion::{Blocks, Candidate, JointStep, Kind, held, solve_positive};
use crate::warp::{Linearisation, RESIDUAL};

/// Inverse depth is kept between these; the region's mean is 1.
pub(super) const RHO_RANGE: [f32; 2] = [0.02, 20.0];
/// Search only replaces a motion that it beats by this share.
const BETTER: f64 = 0.97;

/// A region.
#[derive(Clone, Debug)]
pub(super) struct Region {
    pub motion: RigidMotion,
    pub kind: Kind,
    pub rho: Grid<f32>,
}

impl Region {
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            motion: RigidMotion::default(),
            kind: Kind::Full,
            rho: Grid::new(width, height, 1.0),
        }
    }

    /// A Gauss–Newton step of (T, ω) with depth held as it is: robust while nothing is known of depth.
    pub fn fit_flat(&mut self, evidence: &Evidence) {
        let linearisation = evidence.scale.linearise(&self.motion, &self.rho);
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

    /// Looks for a better motion anywhere on the sphere of directions, and depth with it.
    pub fn search(&mut self, evidence: &Evidence, prior: &FieldPrior, block: usize) {
        if !self.kind.translates() {
            return;
        }
        let flow = evidence.scale.linearise(&self.motion, &self.rho);
        let blocks = self.blocks(&flow, evidence, block);
        let rotates = self.kind.rotates();
        let present = blocks.judge(self.motion.translation, rotates);
        if let Some(found) = blocks.search(rotates)
            && present.is_none_or(|p| found.cost < BETTER * p.cost)
        {
            self.adopt(&found, &flow, evidence, prior);
        }
    }

    /// Takes a kind of motion on: parts of the motion that it forbids go, and what is left is found anew.
    pub fn become_kind(
        &mut self,
        kind: Kind,
        evidence: &Evidence,
        prior: &FieldPrior,
        block: usize,
    ) {
        if kind == self.kind && kind == Kind::Full {
            return;
        }
        let flow = evidence.scale.linearise(&self.motion, &self.rho);
        self.kind = kind;
        if !kind.rotates() {
            self.motion.rotation = DVec3::ZERO;
        }
        if !kind.translates() {
            self.motion.translation = DVec3::ZERO;
            self.rho.data_mut().fill(1.0);
            return;
        }
        let blocks = self.blocks(&flow, evidence, block);
        if let Some(found) = blocks.search(kind.rotates()) {
            self.adopt(&found, &flow, evidence, prior);
        }
    }

    fn blocks(&self, flow: &Linearisation, evidence: &Evidence, side: usize) -> Blocks {
        let weight = evidence.weights(flow);
        let prior = evidence.rotation_prior();
        Blocks::gather(&evidence.scale.camera, flow, &weight, side, prior)
    }

    /// Takes over a motion whose T has length 1, and finds its depth for the flow known so far.
    fn adopt(
        &mut self,
        found: &Candidate,
        flow: &Linearisation,
        evidence: &Evidence,
        prior: &FieldPrior,
    ) {
        // T's length is open: keep the size that goes with a depth around 1.
        let size = self.motion.translation.length().max(1e-3);
        self.motion = RigidMotion {
            translation: found.motion.translation * size,
            rotation: found.motion.rotation,
        };
        self.depth_for_flow(flow, evidence, prior);
        self.normalise(evidence.owned);
    }

    /// Depth anew, for the motion as it is, from the constraint around the *flow* that is known:
    /// needed when the motion has jumped and the present depth means nothing for it.
    fn depth_for_flow(&mut self, flow: &Linearisation, evidence: &Evidence, prior: &FieldPrior) {
        let scale = evidence.scale;
        let weight = evidence.weights(flow);
        let n = weight.len();
        let width = scale.width();
        let mut data = vec![0.0f32; n];
        let mut right = vec![[0.0f32; 1]; n];
        for i in 0..n {
            let w = weight.data()[i];
            if w <= 0.0 {
                continue;
            }
            let [ix, iy] = flow.gradient.data()[i].map(f64::from);
            let [u, v] = flow.flow.data()[i].map(f64::from);
            let it = f64::from(flow.rows.data()[i][RESIDUAL]) - ix * u - iy * v;
            let (px, py) = ((i % width) as f64 + 0.5 * u, (i / width) as f64 + 0.5 * v);
            let c = crate::constraint::Coefficients::at(&scale.camera, px, py, ix, iy);
            let slope = c.s.dot(self.motion.translation) as f32;
            let offset = (it + c.q.dot(self.motion.rotation)) as f32;
            data[i] = w * slope * slope;
            right[i] = [-w * slope * offset];
        }
        let flat = Grid::new(width, scale.height(), 0.0f32);
        let edges = prior.edges(&flat);
        let mut rho = vec![[1.0f32; 1]; n];
        edges
            .system(width, scale.height(), data)
            .solve(&right, &mut rho, 1e-4, 60);
        for (out, [rho]) in self.rho.data_mut().iter_mut().zip(rho) {
            *out = rho;
        }
    }

    /// Motion and depth together: one joint step.
    pub fn fit_jointly(&mut self, evidence: &Evidence, prior: &FieldPrior) {
        let linearisation = evidence.scale.linearise(&self.motion, &self.rho);
        let weight = evidence.weights(&linearisation);
        let departure = self.departure(&linearisation, &weight);
        let edges = prior.edges(&departure);
        let step = JointStep {
            rows: &linearisation.rows,
            weight: &weight,
            system: &edges.system(
                weight.width(),
                weight.height(),
                data_term(&linearisation, &weight),
            ),
            pull: &edges.pull(&departure),
            rotation_prior: evidence.rotation_prior(),
            kind: self.kind,
            longest: evidence.longest(),
        }
        .solve(&self.motion);
        self.motion = step.motion;
        if self.kind.translates() {
            self.add_depth(step.depth_step.data().iter().copied());
        }
    }

    /// Depth alone, for the motion as it is.
    pub fn fit_depth(&mut self, evidence: &Evidence, prior: &FieldPrior) {
        if !self.kind.translates() {
            return;
        }
        let linearisation = evidence.scale.linearise(&self.motion, &self.rho);
        let weight = evidence.weights(&linearisation);
        let departure = self.departure(&linearisation, &weight);
        let edges = prior.edges(&departure);
        let pull = edges.pull(&departure);
        let system = edges.system(
            weight.width(),
            weight.height(),
            data_term(&linearisation, &weight),
        );
        let right: Vec<[f32; 1]> = linearisation
            .rows
            .data()
            .iter()
            .zip(weight.data())
            .zip(pull.data())
            .map(|((row, w), p)| [p - w * row[0] * row[RESIDUAL]])
            .collect();
        let mut step = vec![[0.0f32; 1]; right.len()];
        system.solve(&right, &mut step, 1e-3, 20);
        self.add_depth(step.into_iter().map(|[d]| d));
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

    /// ρ less the plane that fits it best where depth shows.
    pub fn departure(&self, linearisation: &Linearisation, weight: &Grid<f32>) -> Grid<f32> {
        let mut certain = weight.clone();
        for (c, row) in certain.data_mut().iter_mut().zip(linearisation.rows.data()) {
            *c *= row[0] * row[0];
        }
        let mut departure = fitted_plane(&self.rho, &certain);
        for (d, &rho) in departure.data_mut().iter_mut().zip(self.rho.data()) {
            *d = rho - *d;
        }
        departure
    }

    fn add_depth(&mut self, step: impl Iterator<Item = f32>) {
        for (rho, d) in self.rho.data_mut().iter_mut().zip(step) {
            // No more than half of what is there: the linearisation holds no further.
            let limit = 0.5 * *rho + 0.1;
            *rho = (*rho + d.max(-limit).min(limit)).clamp(RHO_RANGE[0], RHO_RANGE[1]);
        }
    }
}

/// ω a².
fn data_term(linearisation: &Linearisation, weight: &Grid<f32>) -> Vec<f32> {
    let rows = linearisation.rows.data().iter();
    rows.zip(weight.data())
        .map(|(row, w)| w * row[0] * row[0])
        .collect()
}
