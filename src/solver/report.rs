//! Where the solver stands, in numbers: what the page shows beside the pictures and motion.json holds.

use serde::Serialize;

use super::approach::pixels;
use super::weights::Weights;
use super::{Solver, Status};
use crate::energy::Energy;
use crate::motion::Kind;

/// Seconds spent in each step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Seconds {
    /// Step 1.
    pub motion: f64,
    /// Step 2.
    pub depth: f64,
    /// Step 3.
    pub curves: f64,
}

/// One region.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RegionReport {
    /// 0 for the background, k for the k-th curve.
    pub label: usize,
    /// Pixels that it owns.
    pub pixels: usize,
    /// Their share of the frame, 0–1.
    pub share: f64,
    /// T, in units in which the region's mean 1/Z is 1.
    pub translation: [f64; 3],
    /// ω, in radians per frame.
    pub rotation: [f64; 3],
    /// still, rotation, translation or full.
    pub kind: Kind,
    /// Labels of the regions that it hides a part of.
    pub in_front_of: Vec<usize>,
}

/// The state of a solver.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Passes made.
    pub iterations: usize,
    /// Whether there is more to do.
    pub status: Status,
    /// Scale at work, 0 the finest.
    pub level: usize,
    /// Number of scales.
    pub levels: usize,
    /// Whether regions are taken for flat as yet, before depth is looked for.
    pub flat: bool,
    /// The terms of (7).
    pub energy: Terms,
    /// Total energy after each pass; comparable between passes of one scale, before and after curves settle.
    pub history: Vec<f64>,
    /// Passes that had been made when each finer scale was reached.
    pub refined: Vec<usize>,
    /// Passes that had been made each time that curves had settled: from then on brightness alone competes,
    /// and μ is less.
    pub settled: Vec<usize>,
    /// Passes that had been made each time that motions had come to rest: from then on every region has a μ of
    /// its own.
    pub rested: Vec<usize>,
    /// Every region, the background first.
    pub regions: Vec<RegionReport>,
    /// The weights in force.
    pub weights: Weights,
    /// What a user should know, in sentences.
    pub warnings: Vec<String>,
    /// Time spent.
    pub seconds: Times,
}

/// The terms of (7) and their sum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Terms {
    /// The terms.
    #[serde(flatten)]
    pub terms: Energy,
    /// Their sum.
    pub total: f64,
}

/// Seconds in each step, and altogether.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Times {
    /// Altogether.
    pub total: f64,
    /// By step.
    #[serde(flatten)]
    pub steps: Seconds,
}

impl Report {
    pub(super) fn of(solver: &Solver) -> Self {
        let motions = solver.approach.motions();
        let labels = solver.approach.labels();
        let behind = solver.approach.behind();
        let (level, levels) = solver.approach.scale();
        let regions: Vec<RegionReport> = motions
            .iter()
            .zip(pixels(labels, motions.len()))
            .enumerate()
            .map(|(label, ((motion, kind), pixels))| RegionReport {
                label,
                // At a coarser scale a pixel stands for four, sixteen, … of the frame's.
                pixels: pixels << (2 * level),
                share: pixels as f64 / labels.len() as f64,
                translation: motion.translation.to_array(),
                rotation: motion.rotation.to_array(),
                kind: *kind,
                in_front_of: behind.get(label).cloned().unwrap_or_default(),
            })
            .collect();
        let energy = solver.energy();
        let steps = solver.seconds;
        Self {
            iterations: solver.iterations(),
            status: solver.status,
            level,
            levels,
            flat: solver.approach.flat(),
            energy: Terms {
                terms: energy,
                total: energy.total(),
            },
            history: solver.history.energies.clone(),
            refined: solver.history.refined.clone(),
            settled: solver.history.settled.clone(),
            rested: solver.history.rested.clone(),
            warnings: warnings(&regions),
            regions,
            weights: solver.approach.weights(),
            seconds: Times {
                total: steps.motion + steps.depth + steps.curves,
                steps,
            },
        }
    }
}

fn warnings(regions: &[RegionReport]) -> Vec<String> {
    let vanished = regions.iter().filter(|r| r.pixels == 0);
    vanished
        .map(|r| match r.label {
            0 => "the curves have taken the whole frame: no background is left".to_owned(),
            k => format!("curve {k} has vanished: nothing moves differently where it was drawn"),
        })
        .collect()
}
