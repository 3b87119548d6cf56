//! Where depth can be known, and what is hidden in the second frame.

use super::palette::Palette;
use super::{Picture, ViewParams, dimmed, mix};
use crate::error::Error;
use crate::frames::Frame;
use crate::interpretation::Interpretation;

/// Colour of what is hidden.
const HIDDEN: [u8; 3] = [255, 96, 64];

/// Confidence from 0 to 1 in colours of [`ViewParams::palette`].
///
/// # Errors
/// [`Error::Choice`] for an unknown palette.
pub fn confidence(found: &Interpretation, params: &ViewParams) -> Result<Picture, Error> {
    let palette = Palette::named(&params.palette)?;
    Ok(found.confidence.map(|c| {
        let [r, g, b] = palette.at(c);
        [r, g, b, 255]
    }))
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
