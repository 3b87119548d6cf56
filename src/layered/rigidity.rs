//! Whether a rigid motion fits a region at all: a judgement on matches, which know nothing of depth.
//!
//! What a rigid motion carries lies on lines that it lays through the second frame, whatever its depth. A region whose
//! matches, but for a few, do not (χ² ≥ [`UNEXPLAINED`]), neither under its own motion nor under the one that they agree on
//! best, is no rigid body: it bends, or more than one thing moves there. Matches whose windows reach beyond the region do
//! not count. Frames of the first scale are fine enough.

use super::solver::Layered;
use crate::camera::RigidMotion;
use crate::frames::halved;
use crate::init::{Carrier, Match, Sample, epipolar_motion, matches};

/// χ² above which a match is not explained.
const UNEXPLAINED: f64 = 9.0;
/// Share of a region's matches that a rigid motion explains.
const RIGID: f64 = 0.75;
/// Matches below which nothing is said.
const FEWEST: usize = 40;
/// Half the side of a match's window, pixels.
const HALF: usize = 4;

impl Layered {
    /// Says of each region whether a rigid motion fits it.
    pub(super) fn judge_rigidity(&mut self) {
        let level = self.first;
        let scale = &self.scales[level];
        let second = &self.pair.second().grey;
        let mut other = (**second).clone();
        for _ in 0..level {
            other = halved(&other);
        }
        let all = matches(&scale.plain, &other);
        let label = |x: usize, y: usize| {
            let place = |v: usize, most: usize| ((v << level) >> self.level).min(most - 1);
            self.labels[(
                place(x, self.labels.width()),
                place(y, self.labels.height()),
            )]
        };
        let owner = |m: &Match| {
            let [x, y] = m.at.map(|v| v as usize);
            let (xs, ys) = (
                [x.saturating_sub(HALF), x + HALF],
                [y.saturating_sub(HALF), y + HALF],
            );
            let own = label(x, y);
            let inside = xs.iter().all(|&x| ys.iter().all(|&y| label(x, y) == own));
            inside.then_some(usize::from(own))
        };
        let owners: Vec<Option<usize>> = all.iter().map(owner).collect();
        for (k, region) in self.regions.iter_mut().enumerate() {
            let own: Vec<Match> = (all.iter().zip(&owners))
                .filter(|(_, o)| **o == Some(k))
                .map(|(m, _)| *m)
                .collect();
            region.rigid = true;
            if own.len() < FEWEST {
                continue;
            }
            let camera = &scale.camera;
            let samples: Vec<Sample> = own.iter().map(|m| Sample::new(*m, camera)).collect();
            let explained = |motion: &RigidMotion| {
                let carrier = Carrier::new(motion, camera);
                let near = samples.iter().filter(|s| carrier.misfit(s) < UNEXPLAINED);
                near.count() as f64 / samples.len() as f64
            };
            let share = explained(&region.state.motion());
            let best = epipolar_motion(&own, camera).map_or(0.0, |found| explained(&found.motion));
            region.rigid = share.max(best) >= RIGID;
        }
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
        assert!(solver.report().regions[0].rigid);
    }
}
