//! The focal length, where the frames themselves tell it.
//!
//! f enters image motion by what turning does away from the middle of the frame. Through a wrong f one rigid motion no
//! longer explains all scenery, and matches are off their epipolar lines. So focal lengths are tried, each with the
//! motion that explains most, and
//!
//! ```text
//! f = argmin  n log Σ min(χ², 9) + (log(f/s) / log 2)²        s the frame's longer side
//! ```
//!
//! n being the number of matches over [`SHARED`], as their windows overlap, and the last term how lenses are spread
//! about a field of view of 53°. First every ⁴√2 ([`POWERS`]), then closer to the best. Most
//! frames tell little of f: only what beats the f they were given with by [`DECISIVE`] counts.

use std::ops::RangeInclusive;

use serde::Serialize;

use super::background::{scenery, whole_motion};
use super::sample::{Carrier, EXPLAINED, Sample, small_samples};
use crate::camera::Camera;
use crate::frames::FramePair;
use crate::ordered::ordered;

/// Powers of ⁴√2 that are tried as focal lengths, in longer sides of the frame: fields of view of 110° to 10°.
const POWERS: RangeInclusive<i32> = -6..=10;
/// Matches that share one independent observation.
const SHARED: f64 = 20.0;
/// 2 log of the odds that are asked for, e³⁰ to one: a wrong f looks better now and then.
const DECISIVE: f64 = 60.0;
/// 2 log of the odds between f and the ends of its range.
const DOUBTFUL: f64 = 4.0;
/// Times that the ratio between neighbours is halved.
const CLOSER: usize = 2;

/// A focal length that was found.
///
/// ```
/// use relievo::{FramePair, init, scene};
///
/// let flight = scene::render("flight", 120, 90)?;
/// let [first, second] = flight.frames;
/// let guess = flight.truth.camera;
/// match init::focal_length(&FramePair::new(first, second)?, &guess) {
///     Some(found) => println!("f is {:.0} pixels, {:.0} to {:.0}", found.focal, found.least, found.greatest),
///     None => println!("the frames do not tell f: {} is as good as any", guess.focal),
/// }
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FocalLength {
    /// f in pixels.
    pub focal: f64,
    /// Shorter than any that explains the frames nearly as well, among those tried.
    pub least: f64,
    /// Longer than any.
    pub greatest: f64,
}

/// The focal length at which one rigid motion explains two frames best; `None` when `camera`'s own does so about as
/// well, or when nothing but a rotation is seen. The principal point is `camera`'s.
pub fn focal_length(pair: &FramePair, camera: &Camera) -> Option<FocalLength> {
    let small = small_samples(pair, camera);
    let side = pair.width().max(pair.height()) as f64;
    let pixel = small.camera.focal / camera.focal;
    let chosen = scenery(&small.samples, &small.camera, small.size)?;
    let count = chosen.len() as f64 / SHARED;
    let cost = |focal: f64| {
        let camera = Camera {
            focal: focal * pixel,
            ..small.camera
        };
        let seen = small
            .samples
            .iter()
            .map(|s| Sample::new(s.matched, &camera));
        let samples: Vec<Sample> = seen.collect();
        let carrier = Carrier::new(&whole_motion(&samples, &camera)?, &camera);
        let each = samples.iter().map(|s| carrier.misfit(s).min(EXPLAINED));
        let unusual = (focal / side).ln() / std::f64::consts::LN_2;
        Some(count * each.sum::<f64>().ln() + unusual * unusual)
    };
    let given = cost(camera.focal).filter(|cost| cost.is_finite())?;
    let entry = |focal: f64| (focal, cost(focal).unwrap_or(f64::INFINITY));
    let mut step = std::f64::consts::SQRT_2.sqrt();
    let mut tried: Vec<(f64, f64)> = POWERS.map(|i| entry(side * step.powi(i))).collect();
    let least = |tried: &[(f64, f64)]| tried.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1));
    for _ in 0..CLOSER {
        step = step.sqrt();
        let (focal, _) = least(&tried)?;
        tried.extend([focal / step, focal * step].map(entry));
    }
    let (focal, best) = least(&tried)?;
    let tried = ordered(tried, |(focal, _)| *focal);
    let ends = [tried[0].0, tried[tried.len() - 1].0];
    let likely = |(_, cost): &(f64, f64)| *cost <= best + DOUBTFUL;
    let first = tried.iter().position(likely)?.saturating_sub(1);
    let last = (tried.iter().rposition(likely)? + 1).min(tried.len() - 1);
    (given - best >= DECISIVE && !ends.contains(&focal)).then_some(FocalLength {
        focal,
        least: tried[first].0,
        greatest: tried[last].0,
    })
}
