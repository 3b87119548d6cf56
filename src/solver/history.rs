//! The passes that a solver has made, and whether it goes on. It stops as
//! - *converged* when, for [`STILL_PASSES`] running, at most `tolerance` of all pixels change region and the energy
//!   changes by less than a thousandth, and nothing more is due; or when, motions being held, energy has not fallen by
//!   that much for [`VAIN_PASSES`], since pixels of a rim and their depth may step to and fro for ever,
//! - *exhausted* (out of iterations) after `max_passes` since the curves were drawn,
//! - *diverged* when the energy is no longer a finite number.

use serde::Serialize;

use super::approach::Approach;
use crate::options::Options;

/// Where the solver stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// There is more to do.
    Running,
    /// Curves and energy stand still, or step to and fro to no purpose.
    Converged,
    /// All passes allowed are used up.
    Exhausted,
    /// The energy is not a finite number.
    Diverged,
}

/// Passes for which all must stand still.
const STILL_PASSES: usize = 3;
/// Passes for which energy must not have fallen where motions are held.
const VAIN_PASSES: usize = 6;
/// Relative change of energy that counts as standing still.
const STILL_ENERGY: f64 = 1e-3;

/// What has been passed through. Passes are counted by how many had been made.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    /// The total energy after each pass.
    pub energies: Vec<f64>,
    /// When each finer scale was reached.
    pub refined: Vec<usize>,
    /// When curves had settled, each time.
    pub settled: Vec<usize>,
    /// When motions had come to rest, each time.
    pub rested: Vec<usize>,
    /// When the curves were drawn last.
    drawn: usize,
    /// Passes for which all has stood still.
    still: usize,
    /// Whether energy has not fallen for long, motions being held.
    in_vain: bool,
}

/// What an approach tells of where it is.
#[derive(Clone, Copy)]
pub(super) struct Stage {
    scale: (usize, usize),
    settled: bool,
    rests: bool,
}

impl Stage {
    pub fn of(approach: &dyn Approach) -> Self {
        Self {
            scale: approach.scale(),
            settled: approach.settled(),
            rests: approach.rests(),
        }
    }
}

impl History {
    /// Enters a pass of `stage` after which the energy is so much, and in which that share of all pixels has changed region;
    /// whether going on is of no use, as far as these tell.
    pub fn enter(&mut self, energy: f64, changed: f64, stage: Stage, tolerance: f64) -> bool {
        let before = self.energies.last();
        let level = before.is_some_and(|e| (e - energy).abs() <= STILL_ENERGY * e.abs());
        self.still = if level && changed <= tolerance {
            self.still + 1
        } else {
            0
        };
        self.energies.push(energy);
        self.in_vain = stage.rests && self.has_stopped_falling();
        self.idle()
    }

    fn idle(&self) -> bool {
        self.still >= STILL_PASSES || self.in_vain
    }

    /// Whether the last passes, since motions were held, have brought no less energy than those before.
    fn has_stopped_falling(&self) -> bool {
        let held = &self.energies[self.rested.last().copied().unwrap_or(0)..];
        let Some(first) = held.len().checked_sub(VAIN_PASSES) else {
            return false;
        };
        let least = |part: &[f64]| part.iter().copied().fold(f64::INFINITY, f64::min);
        let (before, last) = held.split_at(first);
        // Of no pass the least is infinite.
        least(last) > (1.0 - STILL_ENERGY) * least(before)
    }

    /// Enters what the pass has led to, and whether `more` is due.
    pub fn leave(&mut self, before: Stage, after: Stage, more: bool) {
        let now = self.energies.len();
        if after.scale != before.scale {
            self.refined.push(now);
        }
        if after.settled && !before.settled {
            self.settled.push(now);
        }
        if after.rests && !before.rests {
            self.rested.push(now);
        }
        if more {
            self.still = 0;
            self.in_vain = false;
        }
    }

    /// Where the solver stands after a pass.
    pub fn status(&self, options: &Options) -> Status {
        if self.energies.last().is_some_and(|e| !e.is_finite()) {
            Status::Diverged
        } else if self.idle() {
            Status::Converged
        } else if self.used_up(options) {
            Status::Exhausted
        } else {
            Status::Running
        }
    }

    /// Curves are drawn anew: passes allowed are counted from here.
    pub fn draw(&mut self) {
        self.drawn = self.energies.len();
    }

    /// Something has been changed, and what stood still may move again; where the solver stands then.
    pub fn resume(&mut self, options: &Options) -> Status {
        self.still = 0;
        self.in_vain = false;
        if self.used_up(options) {
            Status::Exhausted
        } else {
            Status::Running
        }
    }

    fn used_up(&self, options: &Options) -> bool {
        self.energies.len() - self.drawn >= options.max_passes
    }
}
