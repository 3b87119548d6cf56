//! Curves that are found rather than drawn: a polygon roughly on each thing that moves by itself.
//!
//! 1. [`background`] finds the motion that explains most of the border or of the frame.
//! 2. Before a background that rests or turns, whatever else moves is a body, parted along seams of its flow. Before a
//!    background in translation, a segment of smooth flow is one when the background's motion explains less than
//!    [`CARRIED`] of its matches; so is a large part of a segment that is off by much.
//! 3. [`joined`] joins what one rigid motion carries across gaps in the texture; each body gets its outline.
//!
//! What moves as the background would at another depth cannot be told from scenery.

use super::background::{CARRIED, UNEXPLAINED, background};
use super::epipolar::median;
use super::lattice::Lattice;
use super::outline::{Outline, outlines};
use super::pieces::{field, joined};
use super::sample::{Carrier, small_samples};
use super::segments::segments;
use crate::camera::Camera;
use crate::curves::Shape;
use crate::frames::FramePair;
use crate::options::MAX_CURVES;

/// A body covers at least this share of the lattice.
const SMALLEST: f64 = 0.008;

/// Fewest matches of a piece of one.
const FEW: usize = 12;
/// χ² above which a match does not follow a background in translation, whose T and R are less certain.
const OFF_SCENERY: f64 = 14.0;
/// Residual of such matches, over the usual one, above which they are thought wrong.
const ALIKE: f64 = 1.5;
/// Median χ² of what does not follow the background though its flow continues it.
const STRONG: f64 = 25.0;

/// Polygons roughly on the things that move by themselves, the largest first, at most
/// [`MAX_CURVES`]; none when one rigid motion explains both frames. Corners are in pixels of the frame, inside it, to
/// a tenth of a pixel. `camera` is the frames' own.
///
/// ```
/// use relievo::{FramePair, Options, Solver, init, scene};
///
/// let squares = scene::render("squares", 160, 120)?;
/// let [first, second] = squares.frames;
/// let (pair, camera) = (FramePair::new(first, second)?, squares.truth.camera);
/// let curves = init::find_curves(&pair, &camera);
/// assert_eq!(curves.len(), 2);
/// let solver = Solver::new(pair, camera, &curves, Options::default())?;
/// # Ok::<(), relievo::Error>(())
/// ```
pub fn find_curves(pair: &FramePair, camera: &Camera) -> Vec<Shape> {
    let frame = [pair.width(), pair.height()];
    let small = small_samples(pair, camera);
    let (samples, camera, size) = (small.samples, small.camera, small.size);
    let lattice = Lattice::new(&samples, size);
    let everything = vec![true; samples.len()];
    let whole = || segments(&samples, &lattice, &everything);
    let Some((motion, full)) = background(&samples, whole, &camera, size) else {
        return Vec::new();
    };
    let carrier = Carrier::new(&motion, &camera);
    let misfit: Vec<f64> = samples.iter().map(|s| carrier.misfit(s)).collect();
    let wanted: Vec<bool> = misfit
        .iter()
        .map(|&m| m > if full { OFF_SCENERY } else { UNEXPLAINED })
        .collect();
    let fewest = (SMALLEST * lattice.places() as f64) as usize;
    let mut left = wanted.clone();
    let mut pieces = Vec::new();
    if full {
        let segments = whole();
        let shares = segments.shares(|k| !wanted[k]);
        pieces = segments.members(|s| shares[s] <= CARRIED);
        pieces.retain(|piece| piece.len() >= fewest && 2 * piece.len() < samples.len());
        pieces.iter().flatten().for_each(|&k| left[k] = false);
    }
    let mut others = segments(&samples, &lattice, &left).members(|_| true);
    if full {
        let residual = |k: usize| f64::from(samples[k].matched.residual);
        let usual = median((0..samples.len()).map(residual).collect());
        others.retain(|piece| {
            let of =
                |value: &dyn Fn(usize) -> f64| median(piece.iter().map(|&k| value(k)).collect());
            piece.len() >= 2 * fewest
                && of(&|k| misfit[k]) > STRONG
                && of(&residual) < ALIKE * usual
        });
    }
    pieces.extend(others);
    pieces.retain(|piece| piece.len() >= FEW);
    let mut found = joined(pieces, &samples, &lattice, &camera);
    found.retain(|piece| piece.len() >= fewest);
    let mut curves: Vec<Outline> = found
        .iter()
        .filter_map(|body| {
            let field = field(body, &samples, &lattice);
            let each = outlines(&field, size, frame).into_iter();
            each.max_by(|a, b| a.share.total_cmp(&b.share))
        })
        .collect();
    curves.sort_by(|a, b| b.share.total_cmp(&a.share));
    curves.truncate(MAX_CURVES);
    let polygon = |outline: Outline| Shape::Polygon {
        points: outline.corners,
    };
    curves.into_iter().map(polygon).collect()
}
