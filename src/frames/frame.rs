//! One frame, and the pair of frames that everything starts from.
//!
//! Brightness is the luma of the frame as encoded (Rec. 709 weights on sRGB values), in grey levels
//! 0–255 with 16-bit input keeping its fraction. It is not linearised: encoded values have noise of
//! nearly equal size at all brightnesses, which is what least squares assumes.

use image::{DynamicImage, ImageDecoder, ImageError, ImageReader};
use std::io::Cursor;

use crate::error::Error;
use crate::file::png;
use crate::grid::Grid;

/// Shortest side of a frame, in pixels.
pub const MIN_SIDE: usize = 16;
/// Longest side of a frame, in pixels.
pub const MAX_SIDE: usize = 4096;

/// A picture, for the solver and for the eye.
///
/// ```
/// use relievo::file::png;
/// use relievo::{Frame, Grid};
///
/// let orange = png::write_rgb(&Grid::new(32, 24, [255, 128, 0]))?;
/// let frame = Frame::decode(&orange, "orange.png")?;
/// assert_eq!((frame.width(), frame.height()), (32, 24));
/// assert!((frame.grey[(5, 5)] - 145.8).abs() < 0.1); // 0.2126 R + 0.7152 G + 0.0722 B
///
/// let error = Frame::decode(b"no picture", "notes.txt").unwrap_err();
/// assert!(error.to_string().starts_with("notes.txt cannot be read as an image"));
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Brightness in grey levels, 0–255, not rounded.
    pub grey: Grid<f32>,
    /// Colours to show, sRGB, opaque.
    pub rgb: Grid<[u8; 3]>,
}

impl Frame {
    /// Reads a PNG, JPEG, PNM, WebP, BMP or TIFF file of 8 or 16 bits: grey, RGB, with or without
    /// alpha; only PNG without the feature `decoders`. Transparent parts are shown on mid grey. `name` is what error messages call it.
    ///
    /// # Errors
    /// [`Error::Decode`] for anything else, [`Error::Size`] outside the limits, [`Error::TooLarge`] far
    /// outside; the size is read from the header, before any pixel is unpacked.
    pub fn decode(bytes: &[u8], name: &str) -> Result<Self, Error> {
        let unreadable = |reason: String| Error::Decode {
            name: name.to_owned(),
            reason,
        };
        let open = || {
            ImageReader::new(Cursor::new(bytes))
                .with_guessed_format()
                .map_err(|e| unreadable(e.to_string()))
        };
        if bytes.is_empty() {
            return Err(unreadable("the file is empty".to_owned()));
        }
        if png::palette_breaks_off(bytes) {
            return Err(unreadable("its palette is cut short".to_owned()));
        }
        let refused = |e: ImageError| match e {
            ImageError::Limits(_) => Error::TooLarge {
                name: name.to_owned(),
            },
            other => unreadable(other.to_string()),
        };
        let (width, height) = open()?.into_dimensions().map_err(refused)?;
        check_size(name, width as usize, height as usize)?;
        if jpeg_breaks_off(bytes) {
            return Err(unreadable("the file is cut short".to_owned()));
        }
        let mut decoder = open()?.into_decoder().map_err(refused)?;
        let upright = decoder.orientation().map_err(refused)?;
        let mut picture = DynamicImage::from_decoder(decoder).map_err(refused)?;
        picture.apply_orientation(upright);
        Ok(Self::from_dynamic(&picture))
    }

    /// A frame of 8-bit sRGB values with alpha, four bytes a pixel in row order.
    ///
    /// # Errors
    /// [`Error::Size`] outside the limits, [`Error::Length`] unless there are
    /// `4 · width · height` bytes.
    pub fn from_rgba8(width: usize, height: usize, bytes: &[u8]) -> Result<Self, Error> {
        check_size("the frame", width, height)?;
        if bytes.len() != 4 * width * height {
            return Err(Error::Length {
                what: "an RGBA frame",
                width,
                height,
                expected: 4 * width * height,
                found: bytes.len(),
            });
        }
        let rgb: Vec<[f32; 3]> = bytes
            .chunks_exact(4)
            .map(|p| over_grey([p[0], p[1], p[2], p[3]].map(f32::from)))
            .collect();
        Ok(Self::from_colours(width, height, &rgb))
    }

    /// A frame of brightness alone, in grey levels 0–255.
    ///
    /// # Errors
    /// [`Error::Size`] outside the limits.
    pub fn from_grey(grey: Grid<f32>) -> Result<Self, Error> {
        check_size("the frame", grey.width(), grey.height())?;
        let rgb = grey.map(|g| [g.round().clamp(0.0, 255.0) as u8; 3]);
        Ok(Self { grey, rgb })
    }

    /// A frame of sRGB colours 0–255 that need not be whole numbers; sizes must agree.
    pub(crate) fn from_colours(width: usize, height: usize, colours: &[[f32; 3]]) -> Self {
        let grey = Grid::from_fn(width, height, |x, y| luma(colours[y * width + x]));
        let rgb = Grid::from_fn(width, height, |x, y| {
            colours[y * width + x].map(|c| c.round().clamp(0.0, 255.0) as u8)
        });
        Self { grey, rgb }
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.grey.width()
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.grey.height()
    }

    fn from_dynamic(picture: &DynamicImage) -> Self {
        let wide = picture.to_rgba16();
        let (width, height) = (wide.width() as usize, wide.height() as usize);
        let colours: Vec<[f32; 3]> = wide
            .pixels()
            .map(|p| over_grey(p.0.map(|c| f32::from(c) / 257.0)))
            .collect();
        Self::from_colours(width, height, &colours)
    }
}

/// Two moments of one film, of the same size and with something to see in them.
///
/// ```
/// use relievo::{Error, Frame, FramePair, Grid};
///
/// let waves = |by: f32| Grid::from_fn(32, 24, |x, y| 128.0 + 50.0 * (0.4 * (x as f32 - by) + 0.3 * y as f32).sin());
/// let [first, second] = [0.0, 0.5].map(|by| Frame::from_grey(waves(by)).unwrap());
/// let pair = FramePair::new(first.clone(), second)?;
/// assert_eq!(pair.width(), 32);
///
/// assert_eq!(FramePair::new(first.clone(), first), Err(Error::FramesIdentical));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FramePair {
    first: Frame,
    second: Frame,
}

impl FramePair {
    /// Pairs two frames.
    ///
    /// # Errors
    /// [`Error::FramesDiffer`] in size, [`Error::FrameConstant`] when one has no contrast,
    /// [`Error::FramesIdentical`] when no pixel changes.
    pub fn new(first: Frame, second: Frame) -> Result<Self, Error> {
        if !first.grey.same_size(&second.grey) {
            return Err(Error::FramesDiffer {
                first: (first.width(), first.height()),
                second: (second.width(), second.height()),
            });
        }
        for (frame, which) in [(&first, "the first"), (&second, "the second")] {
            let data = frame.grey.data();
            if data.iter().all(|&g| g == data[0]) {
                return Err(Error::FrameConstant { which });
            }
        }
        if first.grey == second.grey {
            return Err(Error::FramesIdentical);
        }
        Ok(Self { first, second })
    }

    /// The frame whose labels, depth and motion are sought.
    pub fn first(&self) -> &Frame {
        &self.first
    }

    /// The frame that follows.
    pub fn second(&self) -> &Frame {
        &self.second
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.first.width()
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.first.height()
    }
}

fn check_size(name: &str, width: usize, height: usize) -> Result<(), Error> {
    let allowed = MIN_SIDE..=MAX_SIDE;
    if allowed.contains(&width) && allowed.contains(&height) {
        return Ok(());
    }
    Err(Error::Size {
        name: name.to_owned(),
        width,
        height,
    })
}

fn luma(rgb: [f32; 3]) -> f32 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}

fn over_grey(rgba: [f32; 4]) -> [f32; 3] {
    let a = rgba[3] / 255.0;
    [rgba[0], rgba[1], rgba[2]].map(|c| c * a + 128.0 * (1.0 - a))
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
