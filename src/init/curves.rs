//! Where bodies may be that move by themselves, by matches alone.
//!
//! 1. [`background`] finds the motion that explains most of the border or of the frame.
//! 2. A segment of continuous flow may be a body when that motion explains less than [`CARRIED`] of its matches, or leaves
//!    more of them on the median than of the others.
//!
//! What moves as the background would at another depth cannot be told from scenery.

use super::background::{CARRIED, background};
use super::epipolar::{FEWEST, median};
use super::field::field;
use super::lattice::Lattice;
use super::outline::at_pixels;
use super::sample::{Carrier, EXPLAINED, small_samples};
use super::segments::segments;
use crate::camera::Camera;
use crate::frames::FramePair;
use crate::grid::Grid;
use crate::ordered::ordered;

/// A body covers at least this share of the lattice.
const SMALLEST: f64 = 0.008;

/// Median χ² of the matches of a piece from which on it is looked at, before a background in translation and before one
/// that rests or turns: 0.45 and 1.4 are expected of what moves as the background does.
const SEEN_FULL: f64 = 2.0;
const SEEN_STILL: f64 = 3.0;
/// And how many times the median of all matches.
const UNUSUAL: f64 = 2.5;
/// Pieces looked at, at most.
const MOST: usize = 12;

/// Where bodies may be.
pub(crate) struct Candidates {
    /// A level set for each, above 0 inside, of the size of the frames; the largest first.
    pub level_sets: Vec<Grid<f32>>,
    /// The frames, halved where they are large, grey levels.
    pub frames: [Grid<f32>; 2],
    /// Their camera.
    pub camera: Camera,
}

/// What may move by itself. `camera` is the frames' own.
pub(crate) fn candidates(pair: &FramePair, camera: &Camera) -> Option<Candidates> {
    let small = small_samples(pair, camera);
    let (samples, camera, size) = (small.samples, small.camera, small.size);
    let lattice = Lattice::new(samples.iter().map(|s| &s.matched), size);
    let segments = segments(&samples, &lattice);
    let (motion, full) = background(&samples, &segments, &camera, size)?;
    let carrier = Carrier::new(&motion, &camera);
    let misfit: Vec<f64> = samples.iter().map(|s| carrier.misfit(s)).collect();
    let fewest = (SMALLEST * lattice.places() as f64) as usize;
    let shares = segments.shares(|k| misfit[k] < EXPLAINED);
    let middles = segments.medians(&misfit);
    let least = if full { SEEN_FULL } else { SEEN_STILL };
    let usual = least.max(UNUSUAL * median(misfit.clone()));
    let mut pieces = segments.members(|s| shares[s] <= CARRIED || middles[s] > usual);
    pieces.retain(|piece| 2 * piece.len() < samples.len());
    pieces.retain(|piece| piece.len() >= FEWEST);
    pieces.retain(|piece| piece.len() >= fewest);
    let mut found = ordered(pieces, |piece| -(piece.len() as f64));
    found.truncate(MOST);
    let level_set = |body: &Vec<usize>| at_pixels(&field(body, &samples, &lattice), size);
    Some(Candidates {
        level_sets: found.iter().map(level_set).collect(),
        frames: small.frames,
        camera,
    })
}
