//! From the bytes of an image file to its samples.
//!
//! PNG files, animated ones as well, are read here; what opens others is behind the feature `decoders`. The size is read from the header and
//! checked before any pixel is unpacked. While a file is unpacked, memory holds its samples (3 bytes a pixel in an
//! 8-bit photo) beside the frame.

use super::apng;
use super::film::{Contents, Kind, Take};
use super::frame::{Frame, check_size};
use super::lens::{Lens, orientation};
use super::samples::{Raw, Samples, UPRIGHT};
#[cfg(feature = "decoders")]
use super::{others, pictures};
use crate::error::Error;
use crate::file::png::{self, Unread};

impl Frame {
    /// Reads a PNG, JPEG, PNM, WebP, BMP, GIF or TIFF file of up to 16 bits: grey, colour, palettes, with or without
    /// alpha; the first picture of a file that holds several. It is turned upright as its EXIF data says. Transparent
    /// parts are shown on mid grey. Without the feature `decoders` PNG files only are read. `name` is what error messages call it.
    ///
    /// # Errors
    /// [`Error::Decode`] for anything else, [`Error::Size`] and [`Error::Pixels`] outside the limits,
    /// [`Error::TooLarge`] far outside.
    pub fn decode(bytes: &[u8], name: &str) -> Result<Self, Error> {
        Ok(unpack(bytes, name)?.frame())
    }
}

/// The first picture of a file.
pub(crate) fn unpack(bytes: &[u8], name: &str) -> Result<Raw, Error> {
    check_length(bytes, name)?;
    if png::is_png(bytes) {
        return read_png(bytes, name);
    }
    #[cfg(feature = "decoders")]
    return others::unpack(bytes, name);
    #[cfg(not(feature = "decoders"))]
    Err(unreadable(name, "it is no PNG file"))
}

/// Hands the pictures of a file to `take`, in its order.
///
/// # Errors
/// Those of [`Frame::decode`].
pub(crate) fn each_picture(bytes: &[u8], name: &str, take: Take) -> Result<Contents, Error> {
    check_length(bytes, name)?;
    if png::is_png(bytes) {
        if let Some(contents) = apng::each_frame(bytes, name, take)? {
            return Ok(contents);
        }
        take(read_png(bytes, name)?, 0.0);
        return Ok(Contents {
            kind: Kind::Still,
            cut: false,
        });
    }
    #[cfg(feature = "decoders")]
    return pictures::each_picture(bytes, name, take);
    #[cfg(not(feature = "decoders"))]
    Err(unreadable(name, "it is no PNG file"))
}

fn read_png(bytes: &[u8], name: &str) -> Result<Raw, Error> {
    let refuse = |e| refused(name, e);
    let file = Unread::open(bytes).map_err(refuse)?;
    let size = (file.width as usize, file.height as usize);
    check_size(name, size.0, size.1)?;
    let exif = file.exif();
    let picture = file.read().map_err(refuse)?;
    Ok(Raw {
        size,
        channels: picture.channels,
        samples: match picture.samples {
            png::Samples::Bytes(data) => Samples::Bytes(data),
            png::Samples::Words(data) => Samples::Words(data),
        },
        orientation: exif.as_deref().map_or(UPRIGHT, orientation),
        lens: exif.and_then(|exif| Lens::of_exif(&exif, size.0, size.1)),
    })
}

/// What is said of a PNG that is not read.
pub(super) fn refused(name: &str, refused: png::Refused) -> Error {
    match refused {
        png::Refused::TooLarge => Error::TooLarge {
            name: name.to_owned(),
        },
        png::Refused::PaletteCutShort => unreadable(name, "its palette is cut short"),
        png::Refused::Damaged(_) => damaged(name),
    }
}

pub(crate) fn check_length(bytes: &[u8], name: &str) -> Result<(), Error> {
    if bytes.is_empty() {
        return Err(unreadable(name, "the file is empty"));
    }
    Ok(())
}

pub(super) fn damaged(name: &str) -> Error {
    unreadable(name, "the file is damaged or cut short")
}

pub(super) fn unreadable(name: &str, reason: impl Into<String>) -> Error {
    Error::Decode {
        name: name.to_owned(),
        reason: reason.into(),
    }
}
