//! Depth as brightness or colour: near is light.

use super::palette::Palette;
use super::span::Span;
use super::{Picture, ViewParams, hatched, mix};
use crate::error::Error;
use crate::grid::Grid;
use crate::interpretation::Interpretation;

/// Shown where two frames do not tell depth.
const UNKNOWN: [u8; 3] = [104, 106, 112];
/// Lines across it.
const HATCHING: [u8; 3] = [122, 124, 130];
/// Confidence from which a depth is shown without fading.
const FULL: f32 = 0.5;

/// Depth in colours of [`ViewParams::palette`], linear in 1/Z over [`ViewParams::span`] or the robust
/// span of the whole frame or of each region. Depth that is not observable fades into hatched grey.
///
/// # Errors
/// [`Error::Choice`] for an unknown palette.
pub fn depth(found: &Interpretation, params: &ViewParams) -> Result<Picture, Error> {
    let palette = Palette::named(&params.palette)?;
    let regions = found.labels.data().iter().copied().max().unwrap_or(0);
    let regions = usize::from(regions) + 1;
    let spans: Vec<Option<Span>> = if let Some(ends) = params.span {
        let [far, near] = ends.map(|rho| rho as f32);
        vec![Some(Span { far, near }); regions]
    } else if params.per_region {
        let of_region = |k| Span::of(found, false, |i| usize::from(found.labels.data()[i]) == k);
        (0..regions).map(of_region).collect()
    } else {
        vec![Span::of(found, false, |_| true); regions]
    };
    let (width, height) = (found.depth.width(), found.depth.height());
    Ok(Grid::from_fn(width, height, |x, y| {
        let unknown = if hatched(x, y) { HATCHING } else { UNKNOWN };
        let span = spans[usize::from(found.labels[(x, y)])];
        let trust = (found.confidence[(x, y)] / FULL).clamp(0.0, 1.0);
        let [r, g, b] = match span {
            Some(span) => mix(
                unknown,
                palette.at(span.nearness(found.depth[(x, y)])),
                trust,
            ),
            None => unknown,
        };
        [r, g, b, 255]
    }))
}
