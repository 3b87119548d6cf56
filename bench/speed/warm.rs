//! Going on with the following frame, where the solver can.
//!
//! A method of the solver's own is preferred to a trait's. So [`WarmStart::next`] answers as long as the solver has no
//! `next`, and gives way to it without a change to those who call it.

use relievo::{Frame, Solver};

/// What a solver without a warm start answers.
pub struct Missing;

/// `next` for a solver that has none.
pub trait WarmStart {
    /// Takes the second frame for the first, and `frame` for the second.
    fn next(&mut self, frame: Frame) -> Result<(), Missing>;
}

impl WarmStart for Solver {
    fn next(&mut self, _: Frame) -> Result<(), Missing> {
        Err(Missing)
    }
}
