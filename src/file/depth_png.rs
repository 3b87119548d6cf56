//! Depth or disparity as a PNG of 16-bit grey, in a unit of its own; unknown where it is 0.

use image::{DynamicImage, ImageFormat, ImageReader};
use std::io::Cursor;

use super::{bounded, unreadable};
use crate::error::Error;
use crate::grid::Grid;

const FORMAT: &str = "16-bit grey PNG of depth";

/// Reads such a file; what is unknown becomes not-a-number. `name` is what error messages call it.
///
/// # Errors
/// [`Error::File`] for anything else, and for sides above the largest frame's.
pub fn read(bytes: &[u8], name: &str) -> Result<Grid<f32>, Error> {
    let wrong = |reason: String| unreadable(name, FORMAT, reason);
    let open = || ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    let size = open().into_dimensions().map_err(|e| wrong(e.to_string()))?;
    let (width, height) = bounded(name, FORMAT, size.0.into(), size.1.into())?;
    let DynamicImage::ImageLuma16(picture) = open().decode().map_err(|e| wrong(e.to_string()))?
    else {
        return Err(wrong(
            "its pixels are not one 16-bit number each".to_owned(),
        ));
    };
    let known = |sample: u16| {
        if sample == 0 {
            f32::NAN
        } else {
            f32::from(sample)
        }
    };
    Grid::from_vec(
        width,
        height,
        picture.into_raw().into_iter().map(known).collect(),
    )
}
