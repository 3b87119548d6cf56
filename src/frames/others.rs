//! Files that are no PNG: JPEG, PNM, WebP, BMP, GIF and TIFF.

use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use std::io::Cursor;
use zune_jpeg::JpegDecoder;
use zune_jpeg::errors::DecodeErrors;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::frame::check_size;
use super::jpeg;
use super::lens::{Lens, orientation};
use super::samples::{Raw, Samples, UPRIGHT};
use super::tiff::{self, Pages};
use super::unpack::{damaged, unreadable};
use crate::error::Error;
use crate::file::png::MOST_BYTES;

/// What is said of pixels that no decoder here knows.
const SELDOM: &str =
    "its pixels are stored in a way that is seldom used; save it as grey or RGB of 8 or 16 bits";

/// The first picture of such a file.
pub(crate) fn unpack(bytes: &[u8], name: &str) -> Result<Raw, Error> {
    if tiff::is_tiff(bytes) {
        return first_page(bytes, name);
    }
    if jpeg::is_jpeg(bytes) {
        return read_jpeg(bytes, name);
    }
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
    let (width, height) = open()?.into_dimensions().map_err(refuse)?;
    check_size(name, width as usize, height as usize)?;
    let mut decoder = open()?.into_decoder().map_err(refuse)?;
    let exif = decoder.exif_metadata().ok().flatten();
    let upright = decoder.orientation().map_err(refuse)?;
    let picture = DynamicImage::from_decoder(decoder).map_err(refuse)?;
    let lens = exif.and_then(|exif| Lens::of_exif(&exif, width as usize, height as usize));
    Ok(Raw {
        orientation: upright.to_exif(),
        lens,
        ..raw(picture)
    })
}

fn read_jpeg(bytes: &[u8], name: &str) -> Result<Raw, Error> {
    let refuse = |error| match error {
        DecodeErrors::Unsupported(_) => unreadable(name, SELDOM),
        DecodeErrors::LargeDimensions(_) => Error::TooLarge {
            name: name.to_owned(),
        },
        _ => damaged(name),
    };
    let options = DecoderOptions::default()
        .set_strict_mode(false)
        .set_max_width(usize::MAX)
        .set_max_height(usize::MAX);
    // Of the type that pages of TIFF files have as well, or the decoder would be there twice.
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes.to_vec()), options);
    decoder.decode_headers().map_err(refuse)?;
    let size = decoder.dimensions().ok_or_else(|| damaged(name))?;
    check_size(name, size.0, size.1)?;
    if jpeg::breaks_off(bytes) {
        return Err(unreadable(name, "the file is cut short"));
    }
    let (channels, colours) = match decoder.input_colorspace() {
        Some(ColorSpace::Luma) => (1, ColorSpace::Luma),
        _ => (3, ColorSpace::RGB),
    };
    decoder.set_options(options.jpeg_set_out_colorspace(colours));
    let data = decoder.decode().map_err(refuse)?;
    let exif = decoder.exif().map(Vec::as_slice);
    Ok(Raw {
        size,
        channels,
        samples: Samples::Bytes(data),
        orientation: exif.map_or(UPRIGHT, orientation),
        lens: exif.and_then(|exif| Lens::of_exif(exif, size.0, size.1)),
    })
}

fn first_page(bytes: &[u8], name: &str) -> Result<Raw, Error> {
    let refuse = |e: tiff::Refused| e.error(name);
    let mut pages = Pages::open(bytes).map_err(refuse)?;
    let (width, height) = pages.size().map_err(refuse)?;
    let (width, height) = (width as usize, height as usize);
    check_size(name, width, height)?;
    Ok(Raw {
        lens: Lens::of_tiff(bytes, width, height),
        ..pages.read().map_err(refuse)?
    })
}

/// The samples of an unpacked picture that stands upright.
pub(super) fn raw(picture: DynamicImage) -> Raw {
    let size = (picture.width() as usize, picture.height() as usize);
    let (channels, samples) = match picture {
        DynamicImage::ImageLuma8(p) => (1, Samples::Bytes(p.into_raw())),
        DynamicImage::ImageLumaA8(p) => (2, Samples::Bytes(p.into_raw())),
        DynamicImage::ImageRgb8(p) => (3, Samples::Bytes(p.into_raw())),
        DynamicImage::ImageRgba8(p) => (4, Samples::Bytes(p.into_raw())),
        DynamicImage::ImageLuma16(p) => (1, Samples::Words(p.into_raw())),
        DynamicImage::ImageLumaA16(p) => (2, Samples::Words(p.into_raw())),
        DynamicImage::ImageRgb16(p) => (3, Samples::Words(p.into_raw())),
        DynamicImage::ImageRgba16(p) => (4, Samples::Words(p.into_raw())),
        other => (4, Samples::Floats(other.to_rgba32f().into_raw())),
    };
    Raw {
        size,
        channels,
        samples,
        orientation: UPRIGHT,
        lens: None,
    }
}

/// What the first bytes say that a file is.
pub(super) fn format_of(bytes: &[u8]) -> Option<ImageFormat> {
    image::guess_format(bytes).ok()
}

pub(super) fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES as u64);
    limits
}

/// The decoder's complaint in a user's words.
pub(super) fn refused(name: &str, error: ImageError) -> Error {
    match error {
        ImageError::Limits(_) => Error::TooLarge {
            name: name.to_owned(),
        },
        ImageError::Unsupported(_) => unreadable(name, SELDOM),
        _ => damaged(name),
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
