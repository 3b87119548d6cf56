//! An unpacked picture: samples as its file holds them, turned upright on their way into a frame.

use image::DynamicImage;
use image::metadata::Orientation;

use std::sync::Arc;

use super::frame::{Frame, over_grey};
use super::levels::Levels;
use crate::grid::Grid;

/// Samples in row order, channel by channel within a pixel.
pub(super) enum Samples {
    /// 0–255.
    Bytes(Vec<u8>),
    /// 0–65535.
    Words(Vec<u16>),
    /// 0–1.
    Floats(Vec<f32>),
}

/// An unpacked picture.
pub(super) struct Raw {
    /// Width and height as stored.
    pub size: (usize, usize),
    /// 1 for grey, 2 for grey and alpha, 3 for RGB, 4 for RGB and alpha.
    pub channels: usize,
    pub samples: Samples,
    /// What makes it stand upright.
    pub orientation: Orientation,
}

impl Raw {
    pub fn new(picture: DynamicImage, orientation: Orientation) -> Self {
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
        Self {
            size,
            channels,
            samples,
            orientation,
        }
    }

    /// The frame that it is.
    pub fn frame(&self) -> Frame {
        match &self.samples {
            Samples::Bytes(data) => self.frame_of(data),
            Samples::Words(data) => self.frame_of(data),
            Samples::Floats(data) => self.frame_of(data),
        }
    }

    fn frame_of<S: Sample>(&self, data: &[S]) -> Frame {
        let (width, height) = self.upright_size();
        let channels = self.channels;
        let mut frame = Frame::from_rows(width, height, |y, out, known| {
            for (x, (out, known)) in out.iter_mut().zip(known).enumerate() {
                let at = channels * self.place(x, y);
                let p = &data[at..at + channels];
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
            let deep = Grid::from_fn(width, height, |x, y| {
                let p = &data[channels * self.place(x, y)..][..channels];
                [0, 1, 2].map(|c| p[if channels < 3 { 0 } else { c }].word())
            });
            frame.deep = Some(Arc::new(deep));
        }
        frame
    }

    fn upright_size(&self) -> (usize, usize) {
        let (width, height) = self.size;
        match self.orientation {
            Orientation::Rotate90
            | Orientation::Rotate270
            | Orientation::Rotate90FlipH
            | Orientation::Rotate270FlipH => (height, width),
            _ => (width, height),
        }
    }

    /// Number of the stored pixel that is seen at (x, y).
    fn place(&self, x: usize, y: usize) -> usize {
        let (w, h) = self.size;
        let (from_x, from_y) = match self.orientation {
            Orientation::NoTransforms => (x, y),
            Orientation::FlipHorizontal => (w - 1 - x, y),
            Orientation::FlipVertical => (x, h - 1 - y),
            Orientation::Rotate180 => (w - 1 - x, h - 1 - y),
            Orientation::Rotate90 => (y, h - 1 - x),
            Orientation::Rotate270 => (w - 1 - y, x),
            Orientation::Rotate90FlipH => (y, x),
            Orientation::Rotate270FlipH => (w - 1 - y, h - 1 - x),
        };
        from_y * w + from_x
    }
}

/// A sample as a file holds it.
trait Sample: Copy {
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
