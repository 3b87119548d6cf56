//! The focal length, where the frames themselves tell it.
//!
//! f enters image motion by what turning does away from the middle of the frame, (xy/f, f + x²/f): taken
//! through a wrong f, one rigid motion no longer carries all scenery at once. So focal lengths are tried,
//! and f is the one that gives the shortest description of the patches as bodies in rigid motion,
//!
//! ```text
//! f = argmin  change(f) + ( log(f/s) / log SPREAD )²        s the frame's longer side
//! ```
//!
//! change being what [`Bodies`] costs, −2 log of a likelihood, and the rest −2 log of how lenses are spread
//! about a field of view of 53°. First every ⁴√2 from [`SHORTEST`] to [`LONGEST`] sides, then ever
//! closer to the best. Most frames tell little of f, since little turns in them: only what beats by
//! [`DECISIVE`] the f they were given with, which is held to be as usual as any, counts.

use serde::Serialize;

use super::bodies::Bodies;
use super::look::Look;
use super::rigid::Search;
use crate::camera::Camera;
use crate::frames::FramePair;

/// Focal lengths tried, in longer sides of the frame: fields of view of 110° to 10°.
const SHORTEST: f64 = 0.354;
const LONGEST: f64 = 5.66;
/// Lenses in use are within this factor of the frame's side, to a standard deviation.
const SPREAD: f64 = 2.0;
/// 2 log of the odds that are asked for, e¹⁰ to one: among twenty focal lengths there is often one at
/// which two bodies happen to move alike.
const DECISIVE: f64 = 20.0;
/// 2 log of the odds between f and the ends of its range: two standard deviations.
const DOUBTFUL: f64 = 4.0;
/// Times that the ratio between neighbours is halved.
const CLOSER: usize = 2;

/// A focal length that was found.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FocalLength {
    /// f in pixels.
    pub focal: f64,
    /// Shorter than any that explains the frames nearly as well, among those tried.
    pub least: f64,
    /// Longer than any.
    pub greatest: f64,
}

/// The focal length at which rigid motions explain two frames best; `None` when `camera`'s own does so
/// about as well, or when the frames do not show the same things. The principal point is `camera`'s.
pub fn focal_length(pair: &FramePair, camera: &Camera) -> Option<FocalLength> {
    let look = Look::at(pair, camera)?;
    let side = pair.width().max(pair.height()) as f64;
    let pixel = look.sights.focal / camera.focal;
    let change = |focal: f64| Bodies::find(&look.through(pixel * focal), Search::THOROUGH).change;
    let cost = |focal: f64| {
        let unusual = (focal / side).ln() / SPREAD.ln();
        (focal, change(focal) + unusual * unusual)
    };
    let mut step = std::f64::consts::SQRT_2.sqrt();
    let count = ((LONGEST / SHORTEST).ln() / step.ln()).round() as i32;
    let mut tried: Vec<(f64, f64)> = (0..=count)
        .map(|i| cost(side * SHORTEST * step.powi(i)))
        .collect();
    let least = |tried: &[(f64, f64)]| tried.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1));
    for _ in 0..CLOSER {
        step = step.sqrt();
        let (focal, _) = least(&tried)?;
        tried.extend([focal / step, focal * step].map(cost));
    }
    let (focal, best) = least(&tried)?;
    // The ends lie beyond all that is likely: at the next that was tried and is not.
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    let likely = |(_, cost): &(f64, f64)| *cost <= best + DOUBTFUL;
    let first = tried.iter().position(likely)?.saturating_sub(1);
    let last = (tried.iter().rposition(likely)? + 1).min(tried.len() - 1);
    (change(camera.focal) - best >= DECISIVE).then_some(FocalLength {
        focal,
        least: tried[first].0,
        greatest: tried[last].0,
    })
}
