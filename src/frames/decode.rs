//! From the bytes of an image file to a frame.
//!
//! The size is read from the header and checked before any pixel is unpacked. While a file is unpacked, memory holds
//! its samples (3 bytes a pixel in an 8-bit photo) beside the frame.

use image::{DynamicImage, ImageDecoder, ImageError, ImageReader, Limits};
use std::io::Cursor;

use super::frame::{Frame, check_size};
use super::samples::Raw;
use crate::error::Error;

/// Bytes that a decoder may take for one picture: 16-bit RGB with alpha of the largest frame.
const MOST_BYTES: u64 = 800_000_000;

impl Frame {
    /// Reads a PNG, JPEG, PNM, WebP, BMP or TIFF file of up to 16 bits: grey, RGB, with or without
    /// alpha, and turns it upright as its EXIF data says. Transparent parts are shown on mid grey. `name` is what error
    /// messages call it.
    ///
    /// # Errors
    /// [`Error::Decode`] for anything else, [`Error::Size`] and [`Error::Pixels`] outside the limits,
    /// [`Error::TooLarge`] far outside.
    pub fn decode(bytes: &[u8], name: &str) -> Result<Self, Error> {
        if bytes.is_empty() {
            return Err(unreadable(name, "the file is empty"));
        }
        let refused = |e| refused(name, e);
        let (width, height) = open(bytes, name)?.into_dimensions().map_err(refused)?;
        check_size(name, width as usize, height as usize)?;
        if jpeg_breaks_off(bytes) {
            return Err(unreadable(name, "the file is cut short"));
        }
        let mut decoder = open(bytes, name)?.into_decoder().map_err(refused)?;
        let upright = decoder.orientation().map_err(refused)?;
        let picture = DynamicImage::from_decoder(decoder).map_err(refused)?;
        Ok(Raw::new(picture, upright).frame())
    }
}

fn open<'a>(bytes: &'a [u8], name: &str) -> Result<ImageReader<Cursor<&'a [u8]>>, Error> {
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format();
    let mut reader = reader.map_err(|e| unreadable(name, e.to_string()))?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    Ok(reader)
}

fn unreadable(name: &str, reason: impl Into<String>) -> Error {
    Error::Decode {
        name: name.to_owned(),
        reason: reason.into(),
    }
}

fn refused(name: &str, error: ImageError) -> Error {
    match error {
        ImageError::Limits(_) => Error::TooLarge {
            name: name.to_owned(),
        },
        other => unreadable(name, other.to_string()),
    }
}

/// Whether the bytes are a JPEG without an end. The decoder would fill what is missing with grey and say
/// nothing, and a solver would take the grey for a scene.
fn jpeg_breaks_off(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0xff, 0xd8]) && jpeg_end(&bytes[2..]).is_none()
}

/// Walks a JPEG's segments (`FF marker length …`, with coded data after those that start a scan) from
/// behind its start to its end of image; `None` when they stop before.
fn jpeg_end(mut rest: &[u8]) -> Option<()> {
    loop {
        let start = rest.windows(2).position(|pair| {
            // In coded data zero is stuffing and D0–D7 restart them; FF may be repeated anywhere.
            pair[0] == 0xff && !matches!(pair[1], 0x00 | 0xd0..=0xd7 | 0xff)
        })?;
        let marker = rest[start + 1];
        rest = &rest[start + 2..];
        match marker {
            0xd9 => return Some(()),
            // The only other one without a length.
            0x01 => {}
            _ => {
                let length = u16::from_be_bytes(*rest.first_chunk()?);
                rest = rest.get(usize::from(length.max(2))..)?;
            }
        }
    }
}
