//! Leaps of a region: to another T, another kind of motion, another depth of relief.
//!
//! The steps of `region.rs` go downhill from where a region is. Here it leaves that valley: T is looked for
//! over all directions with depth eliminated block by block (`motion/eliminated.rs`), or the motion is changed
//! to one that shows nearly the same; then depth is found anew from the flow known so far, since the depth
//! that the region had means nothing for the new motion.

use glam::DVec3;

use super::evidence::Evidence;
use super::region::{RHO_RANGE, Region};
use crate::camera::RigidMotion;
use crate::constraint::Coefficients;
use crate::depth::{Bends, FieldPrior};
use crate::grid::Grid;
use crate::motion::{Blocks, Candidate, Kind};
use crate::warp::{Linearisation, RESIDUAL};

/// Side of the blocks in which depth is eliminated, in pixels.
const BLOCK: usize = 8;
/// Search only replaces a motion that it beats by this share.
const BETTER: f64 = 0.97;

impl Region {
    /// Looks for a better motion anywhere on the sphere of directions, and depth with it.
    pub fn search(&mut self, evidence: &Evidence, prior: &FieldPrior) {
        if !self.kind.translates() {
            return;
        }
        let flow = evidence.linearise(self);
        let blocks = self.blocks(&flow, evidence);
        let rotates = self.kind.rotates();
        let present = blocks.judge(self.motion.translation, rotates);
        if let Some(found) = blocks.search(rotates)
            && present.is_none_or(|p| found.cost < BETTER * p.cost)
        {
            self.adopt(&found, &flow, evidence, prior);
        }
    }

    /// Takes a kind of motion on: parts of the motion that it forbids go, and what is left is found anew.
    pub fn become_kind(&mut self, kind: Kind, evidence: &Evidence, prior: &FieldPrior) {
        if kind == self.kind && kind == Kind::Full {
            return;
        }
        let flow = evidence.linearise(self);
        self.kind = kind;
        if !kind.rotates() {
            self.motion.rotation = DVec3::ZERO;
        }
        if !kind.translates() {
            self.motion.translation = DVec3::ZERO;
            self.rho.data_mut().fill(1.0);
            return;
        }
        let blocks = self.blocks(&flow, evidence);
        if let Some(found) = blocks.search(kind.rotates()) {
            self.adopt(&found, &flow, evidence, prior);
        }
    }

    fn blocks(&self, flow: &Linearisation, evidence: &Evidence) -> Blocks {
        let weight = evidence.weights(flow);
        let prior = evidence.rotation_prior();
        Blocks::gather(&evidence.scale.camera, flow, &weight, BLOCK, prior)
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
        self.normalise(&evidence.owned);
    }

    /// Depth anew, for the motion as it is, from the constraint around the *flow* that is known:
    /// needed when the motion has jumped and the present depth means nothing for it.
    fn depth_for_flow(&mut self, flow: &Linearisation, evidence: &Evidence, prior: &FieldPrior) {
        let scale = evidence.scale;
        let weight = evidence.weights(flow);
        let n = weight.len();
        let (width, height) = (weight.width(), weight.height());
        let mut data = vec![0.0f32; n];
        let mut right = vec![[0.0f32; 1]; n];
        for i in 0..n {
            let w = weight.data()[i];
            data[i] = prior.relief as f32 * evidence.owned.data()[i];
            right[i] = [data[i]];
            if w <= 0.0 {
                continue;
            }
            let [ix, iy] = flow.gradient.data()[i].map(f64::from);
            let [u, v] = flow.flow.data()[i].map(f64::from);
            let it = f64::from(flow.rows.data()[i][RESIDUAL]) - ix * u - iy * v;
            let (x, y) = flow.window.place(i);
            let (px, py) = (x as f64 + 0.5 * u, y as f64 + 0.5 * v);
            let c = Coefficients::at(&scale.camera, px, py, ix, iy);
            let slope = c.s.dot(self.motion.translation) as f32;
            let offset = (it + c.q.dot(self.motion.rotation)) as f32;
            data[i] += w * slope * slope;
            right[i][0] -= w * slope * offset;
        }
        let flat = Grid::new(width, height, 0.0f32);
        let edges = prior.edges(&Bends::of(&flat));
        let mut rho = vec![[1.0f32; 1]; n];
        edges
            .system(width, height, data)
            .solve(&right, &mut rho, 1e-4, 60);
        for (out, [rho]) in self.rho.data_mut().iter_mut().zip(rho) {
            *out = rho.clamp(RHO_RANGE[0], RHO_RANGE[1]);
        }
    }

    /// The motion with relief `depth` times as deep that shows nearly the same: what a narrow view
    /// confuses (the bas-relief ambiguity; at −1 near and far change places, Necker's cube).
    pub fn scale_relief(&mut self, depth: f64, evidence: &Evidence, prior: &FieldPrior) {
        let flow = evidence.linearise(self);
        let t = self.motion.translation;
        let rest = (1.0 - 1.0 / depth) * t;
        self.motion.translation = DVec3::new(t.x / depth, t.y / depth, t.z);
        self.motion.rotation += DVec3::new(-rest.y, rest.x, 0.0);
        self.depth_for_flow(&flow, evidence, prior);
        self.normalise(&evidence.owned);
    }
}
