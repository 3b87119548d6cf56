//! Files that hold more than one picture: what is kept of them.
//!
//! Frames count up to [`MOST_PIXELS`] pixels together.

use super::frame::Frame;
use super::samples::Raw;
use super::unpack::{each_picture, unreadable};
use crate::error::Error;

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

impl Kind {
    /// All there are.
    #[cfg(all(target_arch = "wasm32", feature = "javascript"))]
    pub(crate) const ALL: [Self; 4] = [Self::Still, Self::Animation, Self::Views, Self::Pages];

    /// What JavaScript calls it.
    #[cfg(target_arch = "wasm32")]
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Still => "still",
            Self::Animation => "animation",
            Self::Views => "views",
            Self::Pages => "pages",
        }
    }
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

/// Takes a picture and the seconds for which it is shown, 0 where the file does not say; whether there is room for more.
pub(crate) type Take<'a> = &'a mut dyn FnMut(Raw, f64) -> bool;

/// What a file holds, besides its pictures.
pub(crate) struct Contents {
    pub kind: Kind,
    /// Whether it holds more than can be read.
    pub cut: bool,
}

impl Film {
    /// Reads all pictures of a file: of an animated GIF, PNG or WebP, of an MPO file, or the pages of a TIFF file; else the one
    /// that [`Frame::decode`] reads. `name` is what error messages call it.
    ///
    /// # Errors
    /// Those of [`Frame::decode`].
    pub fn decode(bytes: &[u8], name: &str) -> Result<Self, Error> {
        let mut film = Self::new();
        let contents = each_picture(bytes, name, &mut |raw, seconds| {
            film.add(raw.frame(), seconds)
        })?;
        film.finished(contents, name)
    }

    /// A film without pictures.
    pub(crate) fn new() -> Self {
        Self {
            moments: Vec::new(),
            kind: Kind::Still,
            cut: false,
        }
    }

    /// Adds a picture, unless it is of another size; whether there is room for more.
    pub(crate) fn add(&mut self, frame: Frame, seconds: f64) -> bool {
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

    /// The film, once all pictures are in it.
    pub(crate) fn finished(mut self, contents: Contents, name: &str) -> Result<Self, Error> {
        self.cut |= contents.cut;
        self.kind = match self.moments.len() {
            0 => return Err(unreadable(name, "there is no picture in it")),
            1 => Kind::Still,
            _ => contents.kind,
        };
        Ok(self)
    }
}
