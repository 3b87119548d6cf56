//! Where depth can be known, and what is hidden in the second frame.

use super::{Picture, ViewParams, dimmed, mix};
use crate::frames::Frame;
use crate::interpretation::Interpretation;

/// Colour of what is hidden.
const HIDDEN: [u8; 3] = [255, 96, 64];

/// Confidence as grey, white = 1.
pub fn confidence(found: &Interpretation) -> Picture {
    found.confidence.map(|c| {
        let grey = (c.clamp(0.0, 1.0) * 255.0).round() as u8;
        [grey, grey, grey, 255]
    })
}

/// What is hidden in the second frame, over the dimmed first one.
pub fn occlusion(frame: &Frame, found: &Interpretation, params: &ViewParams) -> Picture {
    let mut picture = dimmed(frame, params.dim, 1);
    for (p, &hidden) in picture.data_mut().iter_mut().zip(found.occluded.data()) {
        if hidden != 0 {
            let [r, g, b] = mix([p[0], p[1], p[2]], HIDDEN, 0.9);
            *p = [r, g, b, 255];
        }
    }
    picture
}
