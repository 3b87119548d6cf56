//! KITTI's flow: a PNG of 16-bit RGB, u = (R − 32768)/64 and v = (G − 32768)/64 in pixels where B is not 0, unknown
//! where it is.

use super::png::{Samples, Unread, wrong};
use super::{bounded, unreadable};
use crate::error::Error;
use crate::grid::Grid;
use crate::interpretation::Flow;

const FORMAT: &str = "16-bit RGB PNG of flow";

/// Reads such a file; unknown flow becomes not-a-number. `name` is what error messages call it.
///
/// # Errors
/// [`Error::File`] for anything else, and for sides above the largest frame's.
pub fn read(bytes: &[u8], name: &str) -> Result<Flow, Error> {
    let file = Unread::open(bytes).map_err(|e| wrong(name, FORMAT, e))?;
    let (width, height) = bounded(name, FORMAT, file.width.into(), file.height.into())?;
    let picture = file.read().map_err(|e| wrong(name, FORMAT, e))?;
    let (3, Samples::Words(samples)) = (picture.channels, picture.samples) else {
        return Err(unreadable(
            name,
            FORMAT,
            "its pixels are not three 16-bit numbers each",
        ));
    };
    let of = |channel: usize| {
        Grid::from_fn(width, height, |x, y| {
            let at = 3 * (y * width + x);
            let known = samples[at + 2] != 0;
            let value = (f32::from(samples[at + channel]) - 32_768.0) / 64.0;
            if known { value } else { f32::NAN }
        })
    };
    Ok(Flow { u: of(0), v: of(1) })
}

/// Whether a PNG is such a file, and no picture: the third number of a pixel says only whether the others are known.
pub(super) fn is_flow(bytes: &[u8]) -> bool {
    let bound = |file: &Unread| bounded("", FORMAT, file.width.into(), file.height.into()).is_ok();
    let picture = Unread::open(bytes)
        .ok()
        .filter(bound)
        .and_then(|file| file.read().ok());
    picture.is_some_and(|picture| match (picture.channels, picture.samples) {
        (3, Samples::Words(samples)) => samples.as_chunks::<3>().0.iter().all(|p| p[2] <= 1),
        _ => false,
    })
}
