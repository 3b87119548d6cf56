//! The two frames at one scale, ready to be compared where a motion leads.
//!
//! The first frame has its brightness and gradient at every pixel; the second is a cubic spline, whose value and
//! gradient are read at any place. Both frames are smoothed first: the noise that a spline lets through depends on
//! where between pixels it is read, which draws motion towards whole pixels. Labels are judged by frames that are not
//! smoothed, or outlines would be mixtures of both sides. Grey levels, pixels of this scale; a pixel of the next coarser
//! scale covers 2×2 of this one.

use crate::camera::Camera;
use crate::frames::{FramePair, Lighting, Spline, blur, gradient, halved, halved_camera};
use crate::grid::Grid;
use crate::options::Options;

/// A scale whose shorter side has fewer pixels than this is too coarse to show anything.
const SHORTEST: usize = 24;

/// The frames at one scale.
pub(crate) struct Scale {
    pub width: usize,
    pub height: usize,
    pub camera: Camera,
    /// Brightness of the first frame.
    pub first: Grid<f32>,
    /// Its gradient, ∂/∂x and ∂/∂y.
    pub gradient: [Grid<f32>; 2],
    /// The second frame.
    pub second: Spline,
    /// Brightness of the first frame before it was smoothed.
    pub plain: Grid<f32>,
    /// The second frame before it was smoothed.
    pub plain_second: Spline,
}

/// All scales, the finest first, of frames smoothed and the first in the light of the second as the options ask.
pub(crate) fn pyramid(pair: &FramePair, camera: Camera, options: &Options) -> Vec<Scale> {
    let lighting = if options.lighting {
        Lighting::between(&pair.first().grey, &pair.second().grey)
    } else {
        Lighting::default()
    };
    let (gain, offset) = (lighting.gain as f32, lighting.offset as f32);
    let mut plain = [
        pair.first().grey.map(|v| gain * v + offset),
        (*pair.second().grey).clone(),
    ];
    let mut smooth = [0, 1].map(|n: usize| blur(&plain[n], options.smoothing));
    let mut camera = camera;
    let mut scales = Vec::new();
    loop {
        let (w, h) = (plain[0].width(), plain[0].height());
        let half = |frames: &[Grid<f32>; 2]| [halved(&frames[0]), halved(&frames[1])];
        let coarser = (w.min(h) / 2 >= SHORTEST).then(|| (half(&smooth), half(&plain)));
        scales.push(Scale::new(smooth, plain, camera));
        let Some(next) = coarser else {
            return scales;
        };
        (smooth, plain) = next;
        camera = halved_camera(&camera);
    }
}

impl Scale {
    /// From both frames as smoothed and as they were.
    pub fn new(smooth: [Grid<f32>; 2], plain: [Grid<f32>; 2], camera: Camera) -> Self {
        let ([first, second], [plain, plain_second]) = (smooth, plain);
        Self {
            width: first.width(),
            height: first.height(),
            camera,
            gradient: gradient(&first),
            second: Spline::through(&second),
            first,
            plain,
            plain_second: Spline::through(&plain_second),
        }
    }

    /// Whether the second frame has something to compare with at (x, y): a pixel reaches half of one beyond its
    /// centre.
    #[inline(always)]
    pub fn contains(&self, x: f32, y: f32) -> bool {
        x > -0.5 && y > -0.5 && x < self.width as f32 - 0.5 && y < self.height as f32 - 0.5
    }
}
