//! Results as files that other programs read: flow, depth, labels, motion, pictures, surfaces.

pub mod depth16;
pub mod flo;
pub mod glb;
pub mod kept;
pub mod kind;
pub mod kitti;
pub mod motion;
pub(crate) mod packed;
pub mod parts;
pub mod pfm;
pub mod ply;
pub mod png;
pub mod result;

use crate::error::Error;
use crate::frames::{MAX_PIXELS, MAX_SIDE};

fn unreadable(name: &str, format: &'static str, reason: impl Into<String>) -> Error {
    Error::File {
        name: name.to_owned(),
        format,
        reason: reason.into(),
    }
}

/// The size as pixels if it is one that can be worked on; asked before anything is allocated.
fn bounded(
    name: &str,
    format: &'static str,
    width: i64,
    height: i64,
) -> Result<(usize, usize), Error> {
    let allowed = 1..=MAX_SIDE as i64;
    if allowed.contains(&width) && allowed.contains(&height) && width * height <= MAX_PIXELS as i64
    {
        return Ok((width as usize, height as usize));
    }
    Err(unreadable(
        name,
        format,
        format!(
            "it says it is {width}×{height} pixels; both sides must lie between 1 and {MAX_SIDE}, and {} megapixels are the most",
            MAX_PIXELS / 1_000_000
        ),
    ))
}
