//! From the bytes of an image file to a frame.
//!
//! The size is read from the header and checked before any pixel is unpacked. While a file is unpacked, memory holds
//! its samples (3 bytes a pixel in an 8-bit photo) beside the frame.

use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

use super::frame::{Frame, check_size};
use super::jpeg;
#[cfg(feature = "decoders")]
use super::lens::Lens;
use super::samples::Raw;
#[cfg(feature = "decoders")]
use super::tiff::{self, Pages};
use crate::error::Error;
use crate::file::png;

/// Bytes that a decoder may take for one picture: 16-bit RGB with alpha of the largest frame.
pub(super) const MOST_BYTES: u64 = 800_000_000;

impl Frame {
    /// Reads a PNG, JPEG, PNM, WebP, BMP, GIF or TIFF file of up to 16 bits: grey, colour, palettes, with or without
    /// alpha, of which PNG alone without the feature `decoders`; the first picture of a file that holds several. It is turned upright as its EXIF data says. Transparent
    /// parts are shown on mid grey. `name` is what error messages call it.
    ///
    /// # Errors
    /// [`Error::Decode`] for anything else, [`Error::Size`] and [`Error::Pixels`] outside the limits,
    /// [`Error::TooLarge`] far outside.
    pub fn decode(bytes: &[u8], name: &str) -> Result<Self, Error> {
        check_length(bytes, name)?;
        #[cfg(feature = "decoders")]
        if tiff::is_tiff(bytes) {
            let mut frame = first_page(bytes, name)?;
            frame.lens = Lens::of_tiff(bytes, frame.width(), frame.height());
            return Ok(frame);
        }
        picture(bytes, name)
    }
}

fn picture(bytes: &[u8], name: &str) -> Result<Frame, Error> {
    let refuse = |e| refused(name, e);
    if let Some(kind) = foreign(bytes) {
        return Err(unreadable(name, format!("it is {kind}")));
    }
    let open = || {
        let mut reader = ImageReader::new(Cursor::new(bytes));
        reader.limits(limits());
        let format = format_of(bytes).ok_or_else(|| unreadable(name, "it is no picture"))?;
        if !format.reading_enabled() {
            let kind = format
                .extensions_str()
                .first()
                .unwrap_or(&"")
                .to_uppercase();
            return Err(unreadable(
                name,
                format!("it is a picture of the kind {kind}"),
            ));
        }
        reader.set_format(format);
        Ok(reader)
    };
    if png::palette_breaks_off(bytes) {
        return Err(unreadable(name, "its palette is cut short"));
    }
    let (width, height) = open()?.into_dimensions().map_err(refuse)?;
    check_size(name, width as usize, height as usize)?;
    if jpeg::breaks_off(bytes) {
        return Err(unreadable(name, "the file is cut short"));
    }
    let mut decoder = open()?.into_decoder().map_err(refuse)?;
    #[cfg(feature = "decoders")]
    let exif = decoder.exif_metadata().ok().flatten();
    let upright = decoder.orientation().map_err(refuse)?;
    let picture = DynamicImage::from_decoder(decoder).map_err(refuse)?;
    let frame = Raw::new(picture, upright).frame();
    #[cfg(feature = "decoders")]
    let lens = exif.and_then(|exif| Lens::of_exif(exif, frame.width(), frame.height()));
    #[cfg(feature = "decoders")]
    let frame = Frame { lens, ..frame };
    Ok(frame)
}

#[cfg(feature = "decoders")]
fn first_page(bytes: &[u8], name: &str) -> Result<Frame, Error> {
    let refuse = |e: tiff::Refused| e.error(name);
    let mut pages = Pages::open(bytes).map_err(refuse)?;
    let (width, height) = pages.size().map_err(refuse)?;
    check_size(name, width as usize, height as usize)?;
    Ok(pages.read().map_err(refuse)?.frame())
}

pub(super) fn check_length(bytes: &[u8], name: &str) -> Result<(), Error> {
    if bytes.is_empty() {
        return Err(unreadable(name, "the file is empty"));
    }
    Ok(())
}

/// What the first bytes say that a file is.
pub(super) fn format_of(bytes: &[u8]) -> Option<ImageFormat> {
    image::guess_format(bytes).ok()
}

pub(super) fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    limits
}

pub(super) fn unreadable(name: &str, reason: impl Into<String>) -> Error {
    Error::Decode {
        name: name.to_owned(),
        reason: reason.into(),
    }
}

/// The decoder's complaint in a user's words.
pub(super) fn refused(name: &str, error: ImageError) -> Error {
    match error {
        ImageError::Limits(_) => Error::TooLarge {
            name: name.to_owned(),
        },
        ImageError::Unsupported(_) => unreadable(
            name,
            "its pixels are stored in a way that is seldom used; save it as grey or RGB of 8 or 16 bits",
        ),
        _ => unreadable(name, "the file is damaged or cut short"),
    }
}

/// What a file is that other programs open.
fn foreign(bytes: &[u8]) -> Option<&'static str> {
    const STARTS: [(&[u8], &str); 9] = [
        (b"\xff\x0a", "a JPEG XL picture"),
        (b"\0\0\0\x0cJXL ", "a JPEG XL picture"),
        (b"\0\0\0\x0cjP  ", "a JPEG 2000 picture"),
        (b"\x1a\x45\xdf\xa3", "a film (WebM or Matroska)"),
        (b"8BPS", "a Photoshop document"),
        (b"%PDF", "a PDF document"),
        (b"FUJIFILM", "a raw photo"),
        (b"v/1\x01", "an OpenEXR picture"),
        (b"<svg", "an SVG drawing"),
    ];
    if bytes.get(4..8) == Some(b"ftyp") {
        return Some(match bytes.get(8..12) {
            Some(b"avif" | b"avis") => "an AVIF picture",
            Some(b"heic" | b"heix" | b"hevc" | b"mif1" | b"msf1") => "a HEIC photo",
            Some(b"crx ") => "a raw photo",
            Some(b"qt  ") => "a film (MOV)",
            _ => "a film (MP4)",
        });
    }
    if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"AVI ") {
        return Some("a film (AVI)");
    }
    let start = STARTS.iter().find(|(start, _)| bytes.starts_with(start));
    start.map(|(_, kind)| *kind)
}
