//! PNG: pictures for people, and labels with one byte a pixel (0 = background, k = k-th curve).

use image::codecs::png::PngEncoder;
use image::{ColorType, DynamicImage, ExtendedColorType, ImageEncoder, ImageFormat, ImageReader};
use std::io::Cursor;

use super::{bounded, unreadable};
use crate::error::Error;
use crate::grid::Grid;

const FORMAT: &str = "8-bit grey PNG";

/// The bytes of a picture with alpha, sRGB.
///
/// # Errors
/// [`Error::File`] for a picture without pixels.
pub fn write_rgba(picture: &Grid<[u8; 4]>) -> Result<Vec<u8>, Error> {
    encode(
        picture,
        picture.data().as_flattened(),
        ExtendedColorType::Rgba8,
    )
}

/// The bytes of an sRGB picture.
///
/// # Errors
/// [`Error::File`] for a picture without pixels.
pub fn write_rgb(picture: &Grid<[u8; 3]>) -> Result<Vec<u8>, Error> {
    encode(
        picture,
        picture.data().as_flattened(),
        ExtendedColorType::Rgb8,
    )
}

/// The bytes of labels, one grey byte a pixel.
///
/// # Errors
/// [`Error::File`] for labels without pixels.
pub fn write_labels(labels: &Grid<u8>) -> Result<Vec<u8>, Error> {
    encode(labels, labels.data(), ExtendedColorType::L8)
}

/// The bytes of a grey picture of 16 bits a pixel.
///
/// # Errors
/// [`Error::File`] for a picture without pixels.
pub fn write_grey16(values: &Grid<u16>) -> Result<Vec<u8>, Error> {
    // The encoder takes them in the order of this machine.
    let bytes: Vec<u8> = (values.data().iter())
        .flat_map(|value| value.to_ne_bytes())
        .collect();
    encode(values, &bytes, ExtendedColorType::L16)
}

/// Reads labels. `name` is what error messages call the file.
///
/// # Errors
/// [`Error::File`] unless it is a PNG of 8-bit grey, of sides up to the largest frame's.
pub fn read_labels(bytes: &[u8], name: &str) -> Result<Grid<u8>, Error> {
    let wrong = |reason: String| unreadable(name, FORMAT, reason);
    let open = || ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    if palette_breaks_off(bytes) {
        return Err(wrong("its palette is cut short".to_owned()));
    }
    let size = open().into_dimensions().map_err(|e| wrong(e.to_string()))?;
    let (width, height) = bounded(name, FORMAT, size.0.into(), size.1.into())?;
    match open().decode().map_err(|e| wrong(e.to_string()))? {
        DynamicImage::ImageLuma8(picture) => Grid::from_vec(width, height, picture.into_raw()),
        other => Err(wrong(format!(
            "its pixels are {}, not one grey byte each",
            kind(other.color())
        ))),
    }
}

/// Whether the bytes are a PNG whose palette ends within a colour. The decoder would panic.
pub(crate) fn palette_breaks_off(bytes: &[u8]) -> bool {
    let Some(mut rest) = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n") else {
        return false;
    };
    // Chunks: the length of the data, four letters, the data, a checksum.
    while let Some((length, after)) = rest.split_first_chunk::<4>() {
        let length = u32::from_be_bytes(*length) as usize;
        if after.starts_with(b"PLTE") && !length.is_multiple_of(3) {
            return true;
        }
        rest = after.get(length.saturating_add(8)..).unwrap_or_default();
    }
    false
}

fn encode<T: Copy>(
    grid: &Grid<T>,
    bytes: &[u8],
    colour: ExtendedColorType,
) -> Result<Vec<u8>, Error> {
    let mut out = Vec::new();
    PngEncoder::new(&mut out)
        .write_image(bytes, grid.width() as u32, grid.height() as u32, colour)
        .map_err(|e| unreadable("the picture", "PNG", e.to_string()))?;
    Ok(out)
}

fn kind(colour: ColorType) -> String {
    let channels = match colour.channel_count() {
        1 => "grey",
        2 => "grey with alpha",
        3 => "RGB",
        _ => "RGB with alpha",
    };
    let bits = 8 * colour.bytes_per_pixel() / colour.channel_count();
    format!("{bits}-bit {channels}")
}
