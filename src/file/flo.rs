//! Middlebury .flo: the letters `PIEH`, width and height as 32-bit integers, then u and v of each
//! pixel in row order as 32-bit floats, all little-endian. A value above 1e9 in size is unknown.

use super::{bounded, unreadable};
use crate::error::Error;
use crate::grid::Grid;
use crate::interpretation::Flow;

const FORMAT: &str = "Middlebury .flo";
const UNKNOWN_ABOVE: f32 = 1e9;
const UNKNOWN: f32 = 1e10;

/// The bytes of a .flo file; u and v must have the same size. What is not finite becomes unknown.
pub fn write(flow: &Flow) -> Vec<u8> {
    let mut bytes = b"PIEH".to_vec();
    bytes.extend((flow.u.width() as i32).to_le_bytes());
    bytes.extend((flow.u.height() as i32).to_le_bytes());
    for (&u, &v) in flow.u.data().iter().zip(flow.v.data()) {
        let known = u.is_finite() && v.is_finite();
        for w in [u, v] {
            bytes.extend((if known { w } else { UNKNOWN }).to_le_bytes());
        }
    }
    bytes
}

/// Reads a .flo file; unknown flow becomes not-a-number. `name` is what error messages call it.
///
/// # Errors
/// [`Error::File`] for anything else, and for sides above the largest frame's.
pub fn read(bytes: &[u8], name: &str) -> Result<Flow, Error> {
    let wrong = |reason: String| unreadable(name, FORMAT, reason);
    if !bytes.starts_with(b"PIEH") {
        return Err(wrong("it does not begin with PIEH".to_owned()));
    }
    let mut words = bytes[4..].chunks_exact(4).map(|w| [w[0], w[1], w[2], w[3]]);
    let mut side = || {
        let word = words.next().map(i32::from_le_bytes).map(i64::from);
        word.ok_or_else(|| wrong("it ends before its size".to_owned()))
    };
    let (width, height) = (side()?, side()?);
    let (width, height) = bounded(name, FORMAT, width, height)?;
    let expected = 12 + 8 * width * height;
    if bytes.len() != expected {
        return Err(wrong(format!(
            "{width}×{height} pixels need {expected} bytes, but it has {}",
            bytes.len()
        )));
    }
    let mut flow = Flow {
        u: Grid::new(width, height, f32::NAN),
        v: Grid::new(width, height, f32::NAN),
    };
    for (i, pair) in bytes[12..].chunks_exact(8).enumerate() {
        let u = f32::from_le_bytes([pair[0], pair[1], pair[2], pair[3]]);
        let v = f32::from_le_bytes([pair[4], pair[5], pair[6], pair[7]]);
        if u.abs() <= UNKNOWN_ABOVE && v.abs() <= UNKNOWN_ABOVE {
            flow.u.data_mut()[i] = u;
            flow.v.data_mut()[i] = v;
        }
    }
    Ok(flow)
}
