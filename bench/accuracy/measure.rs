//! One solve and how far it is from the truth, region by region.

use relievo::MotionModel;
use relievo::score::{Scores, compare};
use relievo::{Camera, Frame, FramePair, Interpretation, Options, Shape, Solver, Status};

use crate::Failure;

/// What a solve reached.
#[derive(Clone, Debug)]
pub struct Figures {
    /// AEE, AAE and labels as [`compare`] has them.
    pub scores: Scores,
    /// The background, then each curve's region.
    pub regions: Vec<Region>,
    /// Passes made.
    pub passes: usize,
    /// How it ended.
    pub status: Status,
    /// The largest relative rise of the energy over ten passes at most; energies of different
    /// scales do not compare.
    pub rise: Option<f64>,
}

/// One region of the truth and what was found for it.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    /// Its true share of the frame.
    pub share: f64,
    /// What its motion truly is, as far as that shows.
    pub truly: MotionModel,
    /// What its motion was found to be.
    pub kind: MotionModel,
    /// Where T truly shows, how it compares.
    pub heading: Option<Heading>,
    /// Error of the rotation in degrees.
    pub rotation_off: Option<f64>,
    /// Depth's relative error, and a flat guess's, where depth truly shows.
    pub depth: Option<[f64; 2]>,
    /// Mean confidence over it.
    pub confidence: f64,
}

/// How a translation compares with one that truly shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Heading {
    /// By an angle in degrees.
    Off(f64),
    /// None was found.
    Missed,
}

impl Figures {
    /// What `solver` has found, against the truth.
    pub fn of(solver: &Solver, truth: &Interpretation) -> Result<Self, Failure> {
        let found = solver.interpretation();
        let scores = compare(&found, truth)?;
        let report = solver.report();
        let region = |k: usize| {
            let (share, truly) = seen(truth, k);
            let reported = report.regions.get(k);
            let translates = truly.translates();
            let own = truth.labels.data().iter().zip(found.confidence.data());
            let own: Vec<f64> = own
                .filter(|(l, _)| usize::from(**l) == k)
                .map(|(_, c)| f64::from(*c))
                .collect();
            Region {
                share,
                truly,
                kind: reported.map_or(MotionModel::Still, |r| r.model),
                heading: translates.then(|| match scores.translation_angle[k] {
                    Some(angle) => Heading::Off(angle),
                    None => Heading::Missed,
                }),
                rotation_off: scores.rotation_error[k].map(f64::to_degrees),
                depth: (scores.depth_error[k].zip(scores.flat_depth_error[k]))
                    .filter(|_| translates)
                    .map(<[f64; 2]>::from),
                confidence: own.iter().sum::<f64>() / own.len().max(1) as f64,
            }
        };
        Ok(Self {
            regions: (0..truth.regions()).map(region).collect(),
            passes: solver.iterations(),
            status: solver.status(),
            rise: (report.levels == 1).then(|| rise(solver.history())),
            scores,
        })
    }

    /// Share of wrong labels; none where there is one region, and nothing to be wrong.
    pub fn labels_wrong(&self) -> Option<f64> {
        (self.regions.len() > 1).then_some(self.scores.labels_wrong)
    }

    /// The least intersection over union of all regions, where there are several.
    pub fn least_iou(&self) -> Option<f64> {
        let known = self.scores.iou.iter().copied().flatten();
        (self.regions.len() > 1).then(|| known.fold(1.0, f64::min))
    }
}

/// Solves a pair of frames to its end.
pub fn solve(
    frames: &[Frame; 2],
    camera: Camera,
    curves: &[Shape],
    options: Options,
) -> Result<Solver, Failure> {
    let [first, second] = frames.clone();
    let mut solver = Solver::new(FramePair::new(first, second)?, camera, curves, options)?;
    while solver.step() == Status::Running {}
    Ok(solver)
}

/// Region k's share of the frame, and what its true motion is as far as it shows.
pub fn seen(truth: &Interpretation, k: usize) -> (f64, MotionModel) {
    let inside = truth.labels.data().iter().filter(|l| usize::from(**l) == k);
    let share = inside.count() as f64 / truth.labels.len() as f64;
    (share, truth.models()[k])
}

fn rise(history: &[f64]) -> f64 {
    let passes = history.iter().enumerate();
    let rises = passes.flat_map(|(i, before)| {
        let later = history.iter().skip(i + 1).take(10);
        later.map(move |after| after / before - 1.0)
    });
    rises.fold(0.0, f64::max)
}
