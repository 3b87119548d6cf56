//! A result judged by matches, which know nothing of labels and depth: whether a rigid motion fits a region at all, and
//! how far flow is off.
//!
//! What a rigid motion carries lies on lines that it lays through the second frame, whatever its depth. A region whose
//! matches, but for a few, do not, neither under its own motion nor under the one that they agree on best, is no rigid body:
//! it bends, or more than one thing moves there. Matches whose windows reach beyond the region do not count.
//!
//! Matches end within a few tenths of a pixel of where they should, but for a tenth of them. The mean of the distances
//! between them and the flow that exceed a pixel ([`FAR`]) is within a factor of 2.5 of the true error on recorded pairs.

use std::rc::Rc;

use super::solver::Layered;
use crate::camera::{Camera, RigidMotion};
use crate::init::{
    Carrier, MATCH_RADIUS as HALF, Match, Sample, Small, epipolar_motion, small_samples,
};
use crate::window::places;

/// Share of a region's matches that a rigid motion explains.
const RIGID: f64 = 0.75;
/// Matches below which nothing is said.
pub(super) const FEWEST: usize = 40;
/// Pixels of the frames that matches are of, from which on flow is far from one.
const FAR: f32 = 1.0;

impl Layered {
    /// Matches between the frames, halved where they are large.
    pub(super) fn small(&mut self) -> Rc<Small> {
        let camera = &self.scales[0].camera;
        let small = || Rc::new(small_samples(&self.pair, camera));
        self.small.get_or_insert_with(small).clone()
    }

    /// The matches whose windows lie in a region, of each, by the labels as they are; and the camera that sees them.
    pub(super) fn owned_matches(&mut self) -> (Vec<Vec<Sample>>, Camera) {
        let small = self.small();
        let (labels, [width, height]) = (&self.labels, small.size);
        let label = |x: usize, y: usize| {
            let place = |v: usize, from: usize, to: usize| (v * to / from).min(to - 1);
            labels[(
                place(x, width, labels.width()),
                place(y, height, labels.height()),
            )]
        };
        let mut samples = vec![Vec::new(); self.regions.len()];
        for sample in &small.samples {
            let [x, y] = sample.matched.at.map(|v| v as usize);
            let own = label(x, y);
            let (left, top) = (x.saturating_sub(HALF), y.saturating_sub(HALF));
            let mut around = places(left..x + HALF + 1, top..y + HALF + 1);
            if around.all(|(x, y)| label(x, y) == own) {
                samples[usize::from(own)].push(*sample);
            }
        }
        (samples, small.camera)
    }

    /// Says of each region whether a rigid motion fits it.
    pub(super) fn judge_rigidity(&mut self) {
        let (samples, camera) = self.owned_matches();
        for (region, own) in self.regions.iter_mut().zip(&samples) {
            region.rigid = own.len() < FEWEST || {
                let explained =
                    |motion: &RigidMotion| Carrier::new(motion, &camera).share_explained(own);
                let matches: Vec<Match> = own.iter().map(|s| s.matched).collect();
                explained(&region.state.motion()) >= RIGID
                    || epipolar_motion(&matches, &camera)
                        .is_some_and(|found| explained(&found.motion) >= RIGID)
            };
        }
    }

    /// Σ of the distances of flow from matches, where they are far, over the number of matches, in pixels of the frame.
    pub(super) fn distance_from_matches(&mut self) -> f64 {
        let small = self.small();
        let labels = self.frame_labels();
        let factor = self.pair.width() as f32 / small.size[0] as f32;
        let camera = &self.scales[0].camera;
        let views: Vec<_> = self.regions.iter().map(|r| r.state.view(camera)).collect();
        let distance = |sample: &Sample| {
            let [x, y] = sample.matched.at.map(|v| ((v + 0.5) * factor) as usize);
            let (x, y) = (x.min(labels.width() - 1), y.min(labels.height() - 1));
            let k = usize::from(labels[(x, y)]);
            let [to_x, to_y] = views[k].target(x, y, self.regions[k].rho(x, y));
            let [dx, dy] = sample.matched.displacement().map(|d| d * factor);
            (to_x - x as f32 - dx).hypot(to_y - y as f32 - dy)
        };
        let far = small.samples.iter().map(distance);
        let sum: f64 = far.filter(|d| *d > FAR * factor).map(f64::from).sum();
        sum.max(0.0) / small.samples.len().max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use crate::camera::Camera;
    use crate::frames::{Frame, FramePair};
    use crate::grid::Grid;
    use crate::options::Options;
    use crate::solver::{Solver, Status};

    fn texture(x: f32, y: f32) -> f32 {
        120.0
            + 35.0 * (0.6 * x + 0.25 * y).sin() * (0.5 * y - 0.3 * x).cos()
            + 25.0 * (0.21 * x - 0.4 * y + 2.0 * (0.07 * x).sin()).sin()
    }

    /// Solves a picture of which (x, y) in the second frame shows (x, y) − `flow` in the first, without a curve.
    fn solved(flow: impl Fn(f32, f32) -> [f32; 2]) -> Solver {
        let frame = |t: f32| {
            let value = |x: usize, y: usize| {
                let (x, y) = (x as f32, y as f32);
                let [u, v] = flow(x, y);
                texture(x - t * u, y - t * v)
            };
            Frame::from_grey(Grid::from_fn(160, 120, value)).unwrap()
        };
        let pair = FramePair::new(frame(0.0), frame(1.0)).unwrap();
        let camera = Camera::centred(160.0, 160, 120).unwrap();
        let mut solver = Solver::new(pair, camera, &[], Options::default()).unwrap();
        while solver.step() == Status::Running {}
        solver
    }

    #[test]
    fn what_bends_is_not_rigid_and_its_depth_not_believed() {
        let solver = solved(|x, y| [2.5 * (0.12 * y).sin(), 2.5 * (0.1 * x).sin()]);
        let report = solver.report();
        assert!(!report.regions[0].rigid);
        let flow = report.expected.unwrap().flow;
        assert!(flow > 0.3, "flow is said to be right to {flow} px");
        assert!(
            report
                .warnings
                .iter()
                .any(|w| w.contains("No rigid motion fits"))
        );
        assert!(
            solver
                .interpretation()
                .confidence
                .data()
                .iter()
                .all(|c| *c == 0.0)
        );
    }

    #[test]
    fn what_moves_alike_at_all_depths_is_rigid() {
        let solver = solved(|x, y| [1.5 + (0.05 * x).sin() + 0.5 * (0.11 * y).cos(), 0.0]);
        let report = solver.report();
        assert!(report.regions[0].rigid && report.expected.unwrap().flow < 0.1);
    }
}
