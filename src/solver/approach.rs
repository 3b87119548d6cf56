//! What the solver drives: one way to hold curves, motions and depth, and to carry out the three steps.
//!
//! The solver knows when a step is due and when to stop; an approach knows what is kept between steps.

use crate::camera::RigidMotion;
use crate::energy::Energy;
use crate::grid::Grid;
use crate::interpretation::Interpretation;
use crate::motion::Kind;
use crate::options::Options;

use super::weights::Weights;

/// One way to carry out the three steps.
pub(crate) trait Approach {
    /// Step 1.
    fn find_motions(&mut self, options: &Options);

    /// Step 2.
    fn find_depth(&mut self, options: &Options);

    /// Step 3.
    fn move_curves(&mut self, options: &Options);

    /// Ends a pass. `still` says that curves and energy have stood still for long enough, or been to and fro; returns
    /// whether there is something more to do all the same, such as a finer scale.
    fn end_pass(&mut self, still: bool, options: &Options) -> bool;

    /// Settings have changed.
    fn reconsider(&mut self, options: &Options);

    /// Curves have been drawn anew: level sets of the frame's size.
    fn replace_curves(&mut self, level_sets: Vec<Grid<f32>>, options: &Options);

    /// The terms of (7).
    fn energy(&self, options: &Options) -> Energy;

    /// Who owns which pixel, at the scale at work.
    fn labels(&self) -> &Grid<u8>;

    /// The curves as level sets of the frame's size.
    fn level_sets(&self) -> Vec<Grid<f32>>;

    /// The motion of each region and what kind it is.
    fn motions(&self) -> Vec<(RigidMotion, Kind)>;

    /// For each region those of which it hides a part; empty as long as nobody has asked.
    fn behind(&self) -> Vec<Vec<usize>>;

    /// The weights in force.
    fn weights(&self) -> Weights;

    /// The scale at work, 0 the finest, and the number of scales.
    fn scale(&self) -> (usize, usize);

    /// Whether curves are where they should be, to the pixel, so that other weights and another ξ hold.
    fn settled(&self) -> bool {
        false
    }

    /// Whether motions are held by now, so that other weights hold for depth.
    fn rests(&self) -> bool {
        false
    }

    /// Whether regions are taken for flat as yet, so that step 2 leaves depth alone.
    fn flat(&self) -> bool;

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
