//! Curves that are found rather than drawn: a polygon roughly on each thing that moves by itself.
//!
//! Matches say where bodies may be (`init/`); the coarse-to-fine solver takes its first scale from there, and merges what
//! one motion explains as well. What is left are the curves.

use std::rc::Rc;

use crate::camera::Camera;
use crate::curves::Shape;
use crate::frames::{Frame, FramePair};
use crate::init::{Candidates, candidates, outlines};
use crate::layered::Layered;
use crate::options::{MAX_CURVES, Options};
use crate::ordered::ordered;

/// Polygons roughly on the things that move by themselves, the largest first, at most
/// [`MAX_CURVES`]; none when one rigid motion explains both frames. Corners are in pixels of the frame, inside it, to
/// a tenth of a pixel. `camera` is the frames' own.
///
/// ```
/// use relievo::{FramePair, Options, Solver, scene, solver::find_curves};
///
/// let squares = scene::render("squares", 160, 120)?;
/// let [first, second] = squares.frames;
/// let (pair, camera) = (FramePair::new(first, second)?, squares.truth.camera);
/// let curves = find_curves(&pair, &camera);
/// assert_eq!(curves.len(), 2);
/// let solver = Solver::new(pair, camera, &curves, Options::default())?;
/// # Ok::<(), relievo::Error>(())
/// ```
pub fn find_curves(pair: &FramePair, camera: &Camera) -> Vec<Shape> {
    candidates(pair, camera)
        .filter(|c| !c.level_sets.is_empty())
        .and_then(|c| tested(c, [pair.width(), pair.height()]))
        .unwrap_or_default()
}

fn tested(candidates: Candidates, frame: [usize; 2]) -> Option<Vec<Shape>> {
    let [first, second] = candidates.frames.map(Frame::from_grey);
    let pair = FramePair::new(first.ok()?, second.ok()?).ok()?;
    let options = Options::default();
    let found = Layered::first_scale(
        Rc::new(pair),
        candidates.camera,
        candidates.level_sets,
        &options,
    );
    let curves: Vec<_> = found
        .iter()
        .filter_map(|level_set| {
            let each = outlines(level_set, frame).into_iter();
            each.max_by(|a, b| a.share.total_cmp(&b.share))
        })
        .collect();
    let mut curves = ordered(curves, |curve| -curve.share);
    curves.truncate(MAX_CURVES);
    let polygons = curves.into_iter().map(|outline| Shape::Polygon {
        points: outline.corners,
    });
    Some(polygons.collect())
}
