//! The size at which frames are worked on.
//!
//! Both frames are shrunk by a whole number n, each pixel the mean of n × n, so that about as many pixels are left as
//! the option *Detail* says. n is the same both ways, so pixels stay square and f is divided by n. What is found is
//! brought back to the size of the frames by `upsampling.rs`, or to that of a picture smaller than it by `downsampling.rs`.

mod downsampling;
mod size;
mod upsampling;

pub(crate) use downsampling::downsampled;
pub use size::{WorkingSize, sizes};
pub(crate) use upsampling::Upsampling;

use std::rc::Rc;

use crate::camera::Camera;
use crate::curves::Shape;
use crate::error::Error;
use crate::frames::{Frame, FramePair, least_factor, shrunk_camera};
use crate::grid::Grid;
use crate::options::{Detail, MAX_CURVES};

/// The shorter side of frames that are worked on has at least so many pixels, where the frames do.
const SHORTEST: usize = 64;

/// Two frames as they are worked on.
pub(crate) struct Working {
    /// How many times they are shrunk.
    pub factor: usize,
    pub pair: Rc<FramePair>,
    pub camera: Camera,
}

impl Working {
    pub fn new(pair: &Rc<FramePair>, camera: &Camera, detail: Detail) -> Self {
        let factor = factor(pair.width(), pair.height(), detail);
        Self {
            factor,
            pair: if factor == 1 {
                pair.clone()
            } else {
                Rc::new(pair.shrunk(factor))
            },
            camera: shrunk_camera(camera, factor),
        }
    }

    /// The level sets of curves drawn on `frames`.
    pub fn level_sets(
        &self,
        shapes: &[Shape],
        frames: &FramePair,
    ) -> Result<Vec<Grid<f32>>, Error> {
        if shapes.len() > MAX_CURVES {
            return Err(Error::TooManyCurves(shapes.len()));
        }
        let (width, height) = (self.pair.width(), self.pair.height());
        let numbered = shapes.iter().enumerate();
        numbered
            .map(|(i, shape)| {
                shape.check(frames.width(), frames.height(), i)?;
                shape.shrunk(self.factor).level_set(width, height, i)
            })
            .collect()
    }
}

/// How many times frames of that size are shrunk.
pub(crate) fn factor(width: usize, height: usize, detail: Detail) -> usize {
    let pixels = width * height;
    let least = least_factor(pixels);
    let wanted = match detail.pixels() {
        Some(few) => (pixels as f64 / few as f64).sqrt(),
        None => 1.0,
    };
    let coarsest = (width.min(height) / SHORTEST).max(1);
    let wanted = wanted.min(coarsest as f64) / least as f64;
    least * wanted.round().max(1.0) as usize
}

/// The least number by which frames can be shrunk to be drawn with at most `pixels`. Never more than leaves [`SHORTEST`]
/// pixels of their shorter side, or than `worked`, for the work.
pub(crate) fn factor_to_draw(frame: &Frame, worked: usize, pixels: usize) -> usize {
    let step = frame.grey_factor();
    let all = frame.width() * frame.height();
    let most = (frame.width().min(frame.height()) / SHORTEST / step * step).max(worked);
    std::iter::once(1)
        .chain((step..=most).step_by(step))
        .find(|n| all / (n * n) <= pixels)
        .unwrap_or(most)
}
