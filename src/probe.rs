//! What is found at one pixel.
//!
//! ```text
//! ψ ≈ I₂(x + u, y + v) − I₁(x, y)
//! ```
//!
//! To first order in the motion this is the ψ of the constraint, and unlike that it holds however far things move. Grey
//! levels 0–255, of the frames as they are: a change of light is part of it.

use serde::Serialize;

use crate::frames::FramePair;
use crate::interpretation::{Interpretation, Pixel};

/// One pixel of an interpretation. What is not known is not a number, and `null` in JSON.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Probe {
    /// Column, from 0.
    pub x: usize,
    /// Row, from 0.
    pub y: usize,
    /// 0 for the background, k inside the k-th curve.
    pub label: u8,
    /// Z, in units of its own for each region.
    pub depth: f32,
    /// How far depth is observable, 0–1.
    pub confidence: f32,
    /// Motion to the right, pixels per frame.
    pub u: f32,
    /// Motion downwards, pixels per frame.
    pub v: f32,
    /// Its length, pixels per frame.
    pub speed: f32,
    /// ψ, grey levels.
    pub psi: f32,
    /// Whether the point is hidden in the second frame.
    pub occluded: bool,
}

/// What `found` says of pixel `(x, y)` of `pair`'s first frame, each region's depth multiplied by its factor in
/// `scales` (1 where missing); `None` outside the frame.
pub fn probe(
    pair: &FramePair,
    found: &Interpretation,
    scales: &[f64],
    (x, y): (usize, usize),
) -> Option<Probe> {
    let inside = x < found.labels.width() && y < found.labels.height();
    inside.then(|| probe_of(pair, found.pixel((x, y)), scales, (x, y)))
}

/// The same where `pixel` is what was found at `(x, y)`, which lies in the frame.
pub fn probe_of(pair: &FramePair, pixel: Pixel, scales: &[f64], (x, y): (usize, usize)) -> Probe {
    let scale = scales.get(usize::from(pixel.label)).copied().unwrap_or(1.0);
    let Pixel { u, v, .. } = pixel;
    Probe {
        x,
        y,
        label: pixel.label,
        depth: pixel.depth * scale as f32,
        confidence: pixel.confidence,
        u,
        v,
        speed: u.hypot(v),
        psi: residual_of(pair, [u, v], (x, y)),
        occluded: pixel.occluded,
    }
}

/// ψ at a pixel of the frame; not a number where no motion is known.
pub(crate) fn residual(pair: &FramePair, found: &Interpretation, at: (usize, usize)) -> f32 {
    residual_of(pair, [found.flow.u[at], found.flow.v[at]], at)
}

fn residual_of(pair: &FramePair, [u, v]: [f32; 2], at: (usize, usize)) -> f32 {
    if !(u.is_finite() && v.is_finite()) {
        return f32::NAN;
    }
    // Brightness may be kept on fewer pixels than the frame has.
    let n = pair.first().grey_factor() as f32;
    let brightness = |frame: &crate::Frame, x: f32, y: f32| {
        let at = |c: f32| (c + 0.5) / n - 0.5;
        frame.grey.bilinear(at(x), at(y))
    };
    let (x, y) = (at.0 as f32, at.1 as f32);
    brightness(pair.second(), x + u, y + v) - brightness(pair.first(), x, y)
}
