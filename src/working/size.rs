//! What each detail costs: a solve takes time in proportion to the pixels that are worked on, bringing its result back in
//! proportion to those of the frames.

use serde::Serialize;

use super::factor;
use crate::options::Detail;

/// Seconds for the first scale, whatever the frames: WebAssembly on one busy core of a server.
const START: f64 = 0.3;
/// Nanoseconds a pixel that is worked on, for the first region and for each other.
const SOLVING: [f64; 2] = [1500.0, 600.0];
/// Nanoseconds a pixel of the frames.
const UPSAMPLING: f64 = 40.0;
/// Bytes a pixel of the frames: two of 7 bytes and a result of 18.
const FRAME: usize = 32;
/// Bytes a pixel that is worked on, for the first region and for each other.
const WORK: [usize; 2] = [145, 35];

/// A size at which frames can be worked on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct WorkingSize {
    /// The option that asks for it.
    pub detail: Detail,
    /// Columns of the frames as they are worked on.
    pub width: usize,
    /// Rows of them.
    pub height: usize,
    /// Seconds that a solve with the preset `best` is expected to take on the machine that was measured.
    pub seconds: f64,
    /// Bytes of memory that it takes, frames and result included.
    pub bytes: f64,
}

/// The sizes at which frames of `width × height` pixels with so many curves on them can be worked on, the smallest first.
pub fn sizes(width: usize, height: usize, curves: usize) -> Vec<WorkingSize> {
    let frame = (width * height) as f64;
    let each = SOLVING[0] + SOLVING[1] * curves as f64;
    let held = (WORK[0] + WORK[1] * curves) as f64;
    let size = |&detail: &Detail| {
        let n = factor(width, height, detail);
        let pixels = ((width / n) * (height / n)) as f64;
        WorkingSize {
            detail,
            width: width / n,
            height: height / n,
            seconds: START + 1e-9 * (each * pixels + UPSAMPLING * frame),
            bytes: held * pixels + FRAME as f64 * frame,
        }
    };
    Detail::ALL.iter().map(size).collect()
}
