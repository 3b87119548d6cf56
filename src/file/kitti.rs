//! KITTI's flow: a PNG of 16-bit RGB, u = (R − 32768)/64 and v = (G − 32768)/64 in pixels where B is not 0, unknown
//! where it is.

use image::{DynamicImage, ImageFormat, ImageReader};
use std::io::Cursor;

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
    let wrong = |reason: String| unreadable(name, FORMAT, reason);
    let open = || ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    let size = open().into_dimensions().map_err(|e| wrong(e.to_string()))?;
    let (width, height) = bounded(name, FORMAT, size.0.into(), size.1.into())?;
    let DynamicImage::ImageRgb16(picture) = open().decode().map_err(|e| wrong(e.to_string()))?
    else {
        return Err(wrong(
            "its pixels are not three 16-bit numbers each".to_owned(),
        ));
    };
    let samples = picture.into_raw();
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
    let picture = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    let bound = |(width, height): (u32, u32)| bounded("", FORMAT, width.into(), height.into());
    let size = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png).into_dimensions();
    if !size.is_ok_and(|size| bound(size).is_ok()) {
        return false;
    }
    matches!(picture.decode(), Ok(DynamicImage::ImageRgb16(it)) if it.pixels().all(|p| p.0[2] <= 1))
}
