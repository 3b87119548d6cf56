//! Files that hold more than one picture: animations, pairs of views, pages.
//!
//! Frames of an animation are whole pictures, as long as each is shown beside it. An MPO file is one JPEG after
//! another; of those that follow the first, views are those of its size, and smaller ones (thumbnails, gain maps) are not.
//! Frames count up to [`MOST_PIXELS`] pixels together.

use image::codecs::gif::GifDecoder;
use image::codecs::png::PngDecoder;
use image::codecs::webp::WebPDecoder;
use image::metadata::Orientation;
use image::{AnimationDecoder, DynamicImage, ImageDecoder, ImageFormat};
use std::io::Cursor;

use super::decode::{check_length, format_of, limits, refused, unreadable};
use super::frame::{Frame, check_size};
use super::jpeg;
use super::samples::Raw;
use super::tiff::{self, Pages};
use crate::error::Error;
use crate::file::png;

/// Pixels of all frames together at most: 350 MB.
const MOST_PIXELS: usize = 50_000_000;

/// What the pictures of a file are to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// There is only one.
    Still,
    /// They follow each other in time.
    Animation,
    /// They show the same from several places.
    Views,
    /// They are pages of one document, which may be a film.
    Pages,
}

/// A picture of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// The picture.
    pub frame: Frame,
    /// Seconds for which it is shown; 0 where the file does not say.
    pub seconds: f64,
}

/// The pictures of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// In the order of the file, at least one, all of the size of the first.
    pub moments: Vec<Moment>,
    /// What they are to each other.
    pub kind: Kind,
    /// Whether the file holds more than fit.
    pub cut: bool,
}

impl Film {
    /// Reads all pictures of a file: of an animated GIF, PNG or WebP, of an MPO file, or the pages of a TIFF file; else the one
    /// that [`Frame::decode`] reads. `name` is what error messages call it.
    ///
    /// # Errors
    /// Those of [`Frame::decode`].
    pub fn decode(bytes: &[u8], name: &str) -> Result<Self, Error> {
        check_length(bytes, name)?;
        if tiff::is_tiff(bytes) {
            return pages(bytes, name);
        }
        let refuse = |e| refused(name, e);
        let cursor = || Cursor::new(bytes);
        match format_of(bytes) {
            Some(ImageFormat::Gif) => {
                let mut decoder = GifDecoder::new(cursor()).map_err(refuse)?;
                animation(&mut decoder, name)?;
                Self::of_animation(decoder, name)
            }
            Some(ImageFormat::WebP) => {
                let mut decoder = WebPDecoder::new(cursor()).map_err(refuse)?;
                animation(&mut decoder, name)?;
                if decoder.has_animation() {
                    return Self::of_animation(decoder, name);
                }
                Self::still(bytes, name)
            }
            Some(ImageFormat::Png) => {
                if png::palette_breaks_off(bytes) {
                    return Err(unreadable(name, "its palette is cut short"));
                }
                let mut decoder = PngDecoder::new(cursor()).map_err(refuse)?;
                animation(&mut decoder, name)?;
                if decoder.is_apng().map_err(refuse)? {
                    return Self::of_animation(decoder.apng().map_err(refuse)?, name);
                }
                Self::still(bytes, name)
            }
            Some(ImageFormat::Jpeg) => views(bytes, name),
            _ => Self::still(bytes, name),
        }
    }

    fn still(bytes: &[u8], name: &str) -> Result<Self, Error> {
        Ok(Self {
            moments: vec![Moment {
                frame: Frame::decode(bytes, name)?,
                seconds: 0.0,
            }],
            kind: Kind::Still,
            cut: false,
        })
    }

    fn of_animation<'a>(decoder: impl AnimationDecoder<'a>, name: &str) -> Result<Self, Error> {
        let mut film = Film::new(Kind::Animation);
        for shown in decoder.into_frames() {
            let shown = match shown {
                Ok(shown) => shown,
                // What came before the damage is worth having.
                Err(_) if film.moments.len() > 1 => {
                    film.cut = true;
                    break;
                }
                Err(e) => return Err(refused(name, e)),
            };
            let (milliseconds, per) = shown.delay().numer_denom_ms();
            let picture = DynamicImage::ImageRgba8(shown.into_buffer());
            let frame = Raw::new(picture, Orientation::NoTransforms).frame();
            if !film.add(
                frame,
                f64::from(milliseconds) / f64::from(per.max(1)) / 1000.0,
            ) {
                break;
            }
        }
        film.finished(name)
    }

    fn new(kind: Kind) -> Self {
        Self {
            moments: Vec::new(),
            kind,
            cut: false,
        }
    }

    /// Adds a picture, unless it is of another size; whether there is room for more.
    fn add(&mut self, frame: Frame, seconds: f64) -> bool {
        let alike = |first: &Moment| first.frame.rgb.same_size(&frame.rgb);
        let (pixels, count) = (frame.rgb.len(), self.moments.len());
        if self.moments.first().is_none_or(alike) {
            if count > 1 && (count + 1) * pixels > MOST_PIXELS {
                self.cut = true;
                return false;
            }
            self.moments.push(Moment { frame, seconds });
        }
        true
    }

    fn finished(mut self, name: &str) -> Result<Self, Error> {
        match self.moments.len() {
            0 => return Err(unreadable(name, "there is no picture in it")),
            1 => self.kind = Kind::Still,
            _ => {}
        }
        Ok(self)
    }
}

/// Checks the size of an animation and bounds its memory.
fn animation(decoder: &mut impl ImageDecoder, name: &str) -> Result<(), Error> {
    let (width, height) = decoder.dimensions();
    check_size(name, width as usize, height as usize)?;
    decoder.set_limits(limits()).map_err(|e| refused(name, e))
}

/// The JPEGs of a file, one behind the other.
fn views(bytes: &[u8], name: &str) -> Result<Film, Error> {
    let mut film = Film::still(bytes, name)?;
    film.kind = Kind::Views;
    let mut rest = jpeg::behind(bytes);
    while let Some(next) = rest {
        // What is no frame, such as a small thumbnail, is passed over.
        let room = Frame::decode(next, name).map_or(true, |frame| film.add(frame, 0.0));
        rest = jpeg::behind(next).filter(|_| room);
    }
    film.finished(name)
}

fn pages(bytes: &[u8], name: &str) -> Result<Film, Error> {
    let refuse = |e: tiff::Refused| e.error(name);
    let mut pages = Pages::open(bytes).map_err(refuse)?;
    let mut film = Film::new(Kind::Pages);
    loop {
        let first = film.moments.is_empty();
        let page = pages.size().map(|(width, height)| {
            let size = check_size(name, width as usize, height as usize);
            size.map(|()| pages.read())
        });
        match page.map_err(refuse).and_then(|page| page?.map_err(refuse)) {
            Ok(raw) => {
                if !film.add(raw.frame(), 0.0) {
                    break;
                }
            }
            Err(e) if first => return Err(e),
            // Thumbnails and what else lies behind.
            Err(_) => {}
        }
        if !pages.more() || pages.next().is_err() {
            break;
        }
    }
    film.finished(name)
}
