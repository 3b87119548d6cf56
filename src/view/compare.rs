//! What was found beside the truth, so that the eye can compare: the same colour for the same depth and the same speed.
//!
//! Two frames do not tell the scale of a region, so each region's depth is first brought to the truth's,
//! a = median(Z/Ẑ), as scores have it.

use super::ViewParams;
use super::flow::full_speed;
use super::span::Span;
use crate::error::Error;
use crate::file::parts::Parts;
use crate::interpretation::Interpretation;
use crate::score::depth_factors;

/// `found` with each region's depth in the truth's unit.
///
/// # Errors
/// [`Error::TruthDiffers`] when the two are of different sizes.
pub fn aligned(found: &Interpretation, truth: &Parts) -> Result<Interpretation, Error> {
    Ok(found.scaled(&depth_factors(found, truth)?))
}

/// `params` with the ends of the colours set where they are left open, as `truth` would have them.
pub fn same_colours(truth: &Interpretation, params: &ViewParams) -> ViewParams {
    let span = || Span::of(truth, true, |_| true).map(|s| [s.far, s.near].map(f64::from));
    let moves = truth.flow.u.data().iter().any(|u| u.is_finite());
    let speed = || moves.then(|| full_speed(truth, params).into());
    ViewParams {
        // The truth's own unit is the one to compare in.
        scales: Vec::new(),
        span: params.span.or_else(span),
        speed: params.speed.or_else(speed),
        ..params.clone()
    }
}
