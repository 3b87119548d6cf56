//! What the solver drives: one way to hold curves, motions and depth, and to carry out the three steps.
//!
//! The solver knows when a step is due and when to stop; an approach knows what is kept between steps.

use std::rc::Rc;

use super::report::{Expected, RegionReport, Stage};
use super::weights::Weights;
use crate::energy::Energy;
use crate::error::Error;
use crate::file::packed::{Packer, Unpacker};
use crate::frames::FramePair;
use crate::grid::Grid;
use crate::interpretation::Interpretation;
use crate::options::Options;

/// What follows a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Next {
    /// More of the same.
    Again,
    /// Something else, under which energies do not compare with those before: a finer scale, other weights.
    Another,
    /// Nothing.
    Done,
}

/// One way to carry out the three steps.
pub(crate) trait Approach {
    /// Step 1.
    fn find_motions(&mut self, options: &Options);

    /// Step 2.
    fn find_depth(&mut self, options: &Options);

    /// Whether step 2 has anything to do yet.
    ///
    /// # Errors
    /// A sentence that says what to do first.
    fn check_depth(&self) -> Result<(), Error> {
        Ok(())
    }

    /// Step 3.
    fn move_curves(&mut self, options: &Options);

    /// Ends a pass in which the share `changed` of all pixels changed region; `still` says that curves and energy
    /// have stood still for long enough.
    fn end_pass(&mut self, changed: f64, still: bool, options: &Options) -> Next;

    /// Settings have changed.
    fn reconsider(&mut self, options: &Options);

    /// Curves have been drawn anew: level sets of the frame's size.
    fn replace_curves(&mut self, level_sets: Vec<Grid<f32>>, options: &Options);

    /// The second frame has become the first of another pair: start from what is known.
    fn advance(&mut self, pair: Rc<FramePair>, options: &Options);

    /// The terms of (7).
    fn energy(&self, options: &Options) -> Energy;

    /// Who owns which pixel, at the scale at work.
    fn labels(&self) -> &Grid<u8>;

    /// The curves as level sets of the frame's size.
    fn level_sets(&self) -> Vec<Grid<f32>>;

    /// Every region, the background first; how much of the frame each owns is left open.
    fn regions(&self) -> Vec<RegionReport>;

    /// The weights in force.
    fn weights(&self) -> Weights;

    /// The scale at work, 0 the finest, and the number of scales.
    fn scale(&self) -> (usize, usize) {
        (0, 1)
    }

    /// How good labels and flow are expected to be; `None` where that is not known.
    fn expected(&self) -> Option<Expected> {
        None
    }

    /// What the pass under way does.
    fn stage(&self) -> Stage;

    /// Whether the last pass raised the energy, and was taken back.
    fn taken_back(&self) -> bool {
        false
    }

    /// Of how many regions the last pass took motion and depth found anew, pixel by pixel.
    fn adopted(&self) -> usize {
        0
    }

    /// Writes what is kept between passes.
    fn pack(&self, to: &mut Packer);

    /// Takes it over again.
    ///
    /// # Errors
    /// [`Error::File`] for what was not written so; then nothing is changed.
    fn unpack(&mut self, from: &mut Unpacker) -> Result<(), Error>;

    /// What the frames are taken for, at the frame's size.
    fn interpretation(&self, options: &Options) -> Interpretation;
}

/// Pixels that each of `regions` regions owns.
pub(super) fn pixels(labels: &Grid<u8>, regions: usize) -> Vec<usize> {
    let mut count = vec![0; regions];
    for &k in labels.data() {
        count[usize::from(k)] += 1;
    }
    count
}
