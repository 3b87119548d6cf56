//! An unpacked picture: samples as its file holds them, turned upright on their way into a frame.

use std::sync::Arc;

use super::frame::{Frame, over_grey};
use super::lens::Lens;
use super::levels::Levels;
use crate::grid::Grid;

/// The orientation of a picture that is stored as it is seen, by EXIF's numbers.
pub(super) const UPRIGHT: u8 = 1;

/// Samples in row order, channel by channel within a pixel.
pub(crate) enum Samples {
    /// 0–255.
    Bytes(Vec<u8>),
    /// 0–65535.
    Words(Vec<u16>),
    /// 0–1.
    #[cfg_attr(not(feature = "decoders"), expect(dead_code))]
    Floats(Vec<f32>),
}

/// An unpacked picture.
pub(crate) struct Raw {
    /// Width and height as stored.
    pub(super) size: (usize, usize),
    /// 1 for grey, 2 for grey and alpha, 3 for RGB, 4 for RGB and alpha.
    pub channels: usize,
    pub samples: Samples,
    /// What makes it stand upright, 1–8 as EXIF counts.
    pub(super) orientation: u8,
    /// What its file says of the lens.
    pub lens: Option<Lens>,
}

impl Raw {
    /// The frame that it is.
    pub fn frame(&self) -> Frame {
        let frame = match &self.samples {
            Samples::Bytes(data) => self.frame_of(data),
            Samples::Words(data) => self.frame_of(data),
            Samples::Floats(data) => self.frame_of(data),
        };
        Frame {
            lens: self.lens,
            ..frame
        }
    }

    fn frame_of<S: Sample>(&self, data: &[S]) -> Frame {
        frame_of_rows(self.upright_size(), self.channels, &mut |y, row| {
            self.row(data, y, row);
        })
    }

    /// Width and height as it is seen.
    pub fn upright_size(&self) -> (usize, usize) {
        let (width, height) = self.size;
        if self.orientation > 4 {
            (height, width)
        } else {
            (width, height)
        }
    }

    /// Row `y` as it is seen.
    pub fn row<S: Copy>(&self, data: &[S], y: usize, row: &mut [S]) {
        for (x, pixel) in row.chunks_exact_mut(self.channels).enumerate() {
            let at = self.channels * self.place(x, y);
            pixel.copy_from_slice(&data[at..at + self.channels]);
        }
    }

    /// Number of the stored pixel that is seen at (x, y).
    fn place(&self, x: usize, y: usize) -> usize {
        let (w, h) = self.size;
        let (from_x, from_y) = match self.orientation {
            2 => (w - 1 - x, y),
            3 => (w - 1 - x, h - 1 - y),
            4 => (x, h - 1 - y),
            5 => (y, x),
            6 => (y, h - 1 - x),
            7 => (w - 1 - y, h - 1 - x),
            8 => (w - 1 - y, x),
            _ => (x, y),
        };
        from_y * w + from_x
    }
}

/// The frame of so many columns and rows whose samples `read(y, row)` tells, row by row.
pub(crate) fn frame_of_rows<S: Sample>(
    (width, height): (usize, usize),
    channels: usize,
    read: &mut dyn FnMut(usize, &mut [S]),
) -> Frame {
    let mut samples = vec![S::default(); channels * width];
    let mut frame = Frame::from_rows(width, height, &mut |y, out, known| {
        read(y, &mut samples);
        let pixels = samples.chunks_exact(channels);
        for ((p, out), known) in pixels.zip(out).zip(known) {
            let colour = match *p {
                [g] | [g, _] => [g.level(); 3],
                [r, g, b] | [r, g, b, _] => [r.level(), g.level(), b.level()],
                _ => [0.0; 3],
            };
            if let &([_, a] | [_, _, _, a]) = p {
                let [r, g, b] = colour;
                *out = over_grey([r, g, b, a.level()]);
                *known = a.level() > 0.0;
            } else {
                *out = colour;
            }
        }
    });
    frame.step = S::STEP;
    if S::STEP < 1.0 && Levels::of(&[&frame]).narrow() {
        let mut deep = Grid::new(width, height, [0u16; 3]);
        for y in 0..height {
            read(y, &mut samples);
            let pixels = samples.chunks_exact(channels);
            for (p, deep) in pixels.zip(deep.row_mut(y)) {
                *deep = [0, 1, 2].map(|c| p[if channels < 3 { 0 } else { c }].word());
            }
        }
        frame.deep = Some(Arc::new(deep));
    }
    frame
}

/// A sample as a file holds it.
pub(crate) trait Sample: Copy + Default {
    /// Grey levels in a step.
    const STEP: f32;

    /// In grey levels, 0–255.
    fn level(self) -> f32;

    /// In 16 bits.
    fn word(self) -> u16 {
        (257.0 * self.level()).round().clamp(0.0, 65_535.0) as u16
    }
}

impl Sample for u8 {
    const STEP: f32 = 1.0;

    fn level(self) -> f32 {
        f32::from(self)
    }
}

impl Sample for u16 {
    const STEP: f32 = 1.0 / 257.0;

    fn level(self) -> f32 {
        f32::from(self) / 257.0
    }
}

impl Sample for f32 {
    const STEP: f32 = 0.0;

    // Not-a-number is black.
    fn level(self) -> f32 {
        if self.is_nan() {
            return 0.0;
        }
        255.0 * self.clamp(0.0, 1.0)
    }
}

#[cfg(feature = "decoders")]
impl Samples {
    /// Samples that came channel after channel, pixel after pixel.
    pub fn interleaved(self, channels: usize) -> Self {
        fn of<S: Copy>(planes: &[S], channels: usize) -> Vec<S> {
            let count = planes.len() / channels;
            let pixel = |i| (0..channels).map(move |c| planes[c * count + i]);
            (0..count).flat_map(pixel).collect()
        }
        match self {
            Self::Bytes(data) => Self::Bytes(of(&data, channels)),
            Self::Words(data) => Self::Words(of(&data, channels)),
            Self::Floats(data) => Self::Floats(of(&data, channels)),
        }
    }
}
