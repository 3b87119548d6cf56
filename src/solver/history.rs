//! The passes that a solver has made, and whether it goes on. It stops as
//! - *converged* when the approach has nothing more to do. Under `paper` that is when, for [`STILL_PASSES`] running, at
//!   most `tolerance` of all pixels change region and the energy changes by less than a thousandth;
//! - *exhausted* (out of iterations) after `max_passes` since the curves were drawn;
//! - *diverged* when the energy is no longer a finite number.

use serde::Serialize;

use super::approach::Next;
use super::report::LastPass;
use crate::options::Options;

/// Where the solver stands.
///
/// ```
/// use relievo::Status;
///
/// let said = |status: Status| match status {
///     Status::Running => "there is more to do",
///     Status::Converged => "done",
///     Status::Exhausted => "all passes are used up: look at it, or allow more",
///     Status::Diverged => "the result means nothing",
/// };
/// assert_eq!(said(Status::Converged), "done");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// There is more to do.
    Running,
    /// Curves and energy stand still.
    Converged,
    /// All passes allowed are used up.
    Exhausted,
    /// The energy is not a finite number.
    Diverged,
}

/// Passes for which all must stand still.
const STILL_PASSES: usize = 3;
/// Relative change of energy that counts as standing still.
const STILL_ENERGY: f64 = 1e-3;

/// What has been passed through. Passes are counted by how many had been made.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    /// The total energy after each pass.
    pub energies: Vec<f64>,
    /// When something began under which energies do not compare with those before: a finer scale, other weights.
    pub breaks: Vec<usize>,
    /// When the curves were drawn last.
    pub(super) drawn: usize,
    /// Passes for which all has stood still.
    pub(super) still: usize,
    /// What the last pass did.
    pub last: Option<LastPass>,
}

impl History {
    /// Enters a pass after which the energy is so much, and in which that share of all pixels has changed region;
    /// whether all stands still.
    pub fn enter(&mut self, energy: f64, changed: f64, tolerance: f64) -> bool {
        let comparable = self.breaks.last() != Some(&self.energies.len());
        let before = self.energies.last().filter(|_| comparable);
        let level = before.is_some_and(|e| (e - energy).abs() <= STILL_ENERGY * e.abs());
        self.still = if level && changed <= tolerance {
            self.still + 1
        } else {
            0
        };
        self.energies.push(energy);
        self.still >= STILL_PASSES
    }

    /// Where the solver stands after a pass that `next` follows.
    pub fn leave(&mut self, next: Next, options: &Options) -> Status {
        if next == Next::Another {
            self.breaks.push(self.energies.len());
            self.still = 0;
        }
        if self.energies.last().is_some_and(|e| !e.is_finite()) {
            Status::Diverged
        } else if next == Next::Done {
            Status::Converged
        } else if self.used_up(options) {
            Status::Exhausted
        } else {
            Status::Running
        }
    }

    /// Curves are drawn anew, or there is another pair: passes allowed are counted from here.
    pub fn draw(&mut self) {
        self.drawn = self.energies.len();
        self.breaks.push(self.drawn);
    }

    /// Something has been changed, and what stood still may move again; where the solver stands then.
    pub fn resume(&mut self, options: &Options) -> Status {
        self.still = 0;
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
