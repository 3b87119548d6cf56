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
const RIGID: f64 = 0.7;
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
            if std::env::var("PROBE").is_ok() {
                eprintln!(
                    "PROBE rigid {k} of {} own {share:.3} best {best:.3}",
                    own.len()
                );
            }
            region.rigid = share.max(best) >= RIGID;
        }
    }
}
