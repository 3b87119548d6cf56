//! What can be asked, and what is answered; the same as `wasm.js` has.

use std::path::PathBuf;

use relievo::options::Preset;
use serde::{Deserialize, Serialize};

use crate::scores::Score;

/// A request.
#[derive(Deserialize)]
#[serde(tag = "work", rename_all = "lowercase")]
pub enum Request {
    /// Writes a sequence.
    Render {
        folder: PathBuf,
        scene: String,
        width: usize,
        height: usize,
    },
    /// Solves once without a clock and scores every pass.
    Trial { folder: PathBuf, preset: Preset },
    /// Solves against the clock. `usable` is the pass after which the picture is usable, from a trial.
    Solve {
        folder: PathBuf,
        preset: Preset,
        usable: Option<usize>,
    },
    /// Solves in a fresh process.
    Memory { folder: PathBuf, preset: Preset },
}

/// What a trial finds.
#[derive(Serialize)]
pub struct Trial {
    /// How the solve ended.
    pub status: relievo::Status,
    /// How far each pass is from the truth, the final one last.
    pub scores: Vec<Score>,
    /// How far the end of the following pair is, after a warm start; none where the solver has no warm start.
    pub next: Option<Score>,
}

/// Seconds of one solve.
#[derive(Serialize)]
pub struct Seconds {
    /// From frames and circles to the end.
    pub total: f64,
    /// Step 1, by the solver's own clock.
    pub motion: f64,
    /// Step 2.
    pub depth: f64,
    /// Step 3.
    pub curves: f64,
    /// To the first usable picture.
    pub usable: Option<f64>,
    /// From the third frame to the end of the following pair.
    pub next: Option<f64>,
}
