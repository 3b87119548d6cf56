//! Where the solver stands, in numbers: what the page shows beside the pictures and motion.json holds.

use serde::Serialize;

use super::approach::pixels;
use super::weights::Weights;
use super::{Solver, Status};
use crate::camera::RigidMotion;
use crate::energy::Energy;
use crate::frames::Note;
use crate::motion_model::MotionModel;

/// Seconds spent in each step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
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
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
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
    pub model: MotionModel,
    /// Whether another motion, with another relief, explains the region as well: the flatter one is given, and
    /// confidence is at most one half.
    pub ambiguous: bool,
    /// Whether a rigid motion fits it. Where none does, T and ω are those that come nearest and mean nothing, and confidence
    /// is 0.
    pub rigid: bool,
    /// The label of another region, if one motion explains both as well as two do: they may be one thing, or it may be
    /// scenery at another depth.
    pub part_of: Option<usize>,
    /// Labels of the regions that it hides a part of.
    pub in_front_of: Vec<usize>,
}

/// The state of a solver.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Report {
    /// Passes made.
    pub iterations: usize,
    /// Whether there is more to do.
    pub status: Status,
    /// Scale at work, 0 the finest.
    pub level: usize,
    /// Number of scales.
    pub levels: usize,
    /// How many times frames are shrunk for the work.
    pub factor: usize,
    /// The terms of (7).
    pub energy: Terms,
    /// Total energy after each pass; comparable between passes with no break between them.
    pub history: Vec<f64>,
    /// Passes that had been made when energies became incomparable with those before: a finer scale began, weights
    /// were chosen anew, curves were drawn or the next frame was taken.
    pub breaks: Vec<usize>,
    /// What the last pass did; null before the first.
    pub last: Option<LastPass>,
    /// How good labels and flow are expected to be; null where that is not known.
    pub expected: Option<Expected>,
    /// Every region, the background first.
    pub regions: Vec<RegionReport>,
    /// The weights in force.
    pub weights: Weights,
    /// What a user should know of the frames; `warnings` has it in words.
    pub notes: Vec<Note>,
    /// What a user should know, in sentences.
    pub warnings: Vec<String>,
    /// Time spent.
    pub seconds: Times,
}

/// What a pass is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// Under `best`, first: image motion of a plane for every region, and labels by it.
    Planes,
    /// Then: candidate motions, the best of which is taken, with a surface.
    Search,
    /// Motion and surface improved, motion models compared once more, labels.
    Selection,
    /// Motion and surface improved, labels.
    Surfaces,
    /// Depth pixel by pixel where it has steps.
    Steps,
    /// Under `paper`: least squares, descent on depth, evolution of curves.
    Descent,
}

/// What a pass did.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct LastPass {
    /// What it was about.
    pub stage: Stage,
    /// The scale that it was made at, 0 the finest.
    pub level: usize,
    /// Pixels of the frame that changed region.
    pub changed: usize,
    /// Whether it raised the energy, and labels, motions and surfaces were put back.
    pub taken_back: bool,
    /// Regions of which it took motion and depth found anew, pixel by pixel; 0 for all stages but [`Stage::Steps`].
    pub adopted: usize,
}

/// How good a result is expected to be, as the scale at work allows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Expected {
    /// Mean error of the flow, pixels of the frame.
    pub flow: f64,
    /// Share of wrong labels, 0–1.
    pub labels: f64,
}

/// The terms of (7) and their sum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Terms {
    /// The terms.
    #[serde(flatten)]
    pub terms: Energy,
    /// Their sum.
    pub total: f64,
}

/// Seconds in each step, and altogether.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Times {
    /// Altogether.
    pub total: f64,
    /// By step.
    #[serde(flatten)]
    pub steps: Seconds,
}

impl RegionReport {
    /// A motion and its model, of which nothing else is known.
    pub(crate) fn new(label: usize, motion: &RigidMotion, model: MotionModel) -> Self {
        Self {
            label,
            pixels: 0,
            share: 0.0,
            translation: motion.translation.to_array(),
            rotation: motion.rotation.to_array(),
            model,
            ambiguous: false,
            rigid: true,
            part_of: None,
            in_front_of: Vec::new(),
        }
    }
}

impl Report {
    pub(super) fn of(solver: &Solver) -> Self {
        let mut regions = solver.approach.regions();
        let labels = solver.approach.labels();
        let (level, levels) = solver.approach.scale();
        let factor = solver.working.factor;
        let owned = pixels(labels, regions.len());
        for (region, pixels) in regions.iter_mut().zip(owned) {
            region.pixels = solver.in_frame(pixels, level);
            region.share = pixels as f64 / labels.len() as f64;
        }
        let energy = solver.energy();
        let steps = solver.seconds;
        Self {
            iterations: solver.iterations(),
            status: solver.status,
            level,
            levels,
            energy: Terms {
                terms: energy,
                total: energy.total(),
            },
            history: solver.history.energies.clone(),
            breaks: solver.history.breaks.clone(),
            factor,
            last: solver.history.last,
            expected: solver.approach.expected().map(|e| Expected {
                flow: e.flow * factor as f64,
                ..e
            }),
            warnings: (solver.pair.notes().iter().map(Note::to_string))
                .chain(warnings(&regions))
                .collect(),
            notes: solver.pair.notes().to_vec(),
            regions,
            weights: solver.approach.weights(),
            seconds: Times {
                total: steps.motion + steps.depth + steps.curves,
                steps,
            },
        }
    }
}

fn warnings(regions: &[RegionReport]) -> impl Iterator<Item = String> {
    let named = |label: usize| match label {
        0 => "the background".to_owned(),
        k => format!("region {k}"),
    };
    let vanished = regions.iter().filter(|r| r.pixels == 0);
    let vanished = vanished.map(|r| match r.label {
        0 => "The curves cover the whole frame. No background is left.".to_owned(),
        k => format!("Curve {k} has vanished: nothing moves differently where it was drawn."),
    });
    let present = || regions.iter().filter(|r| r.pixels > 0);
    let loose = present().filter(|r| !r.rigid).map(move |r| {
        let name = named(r.label);
        format!("No rigid motion fits {name}. It may bend, or several objects move in it.")
    });
    let parts = present().filter_map(move |r| {
        let (label, whole) = (r.label, named(r.part_of?));
        Some(format!(
            "One motion explains region {label} and {whole} as well as two do: they may be one."
        ))
    });
    let ambiguous = present().filter(|r| r.ambiguous).map(|r| {
        let name = match r.label {
            0 => "The background".to_owned(),
            k => format!("Region {k}"),
        };
        format!("{name}: two motions fit equally well. The one with less relief is shown.")
    });
    vanished.chain(loose).chain(parts).chain(ambiguous)
}
