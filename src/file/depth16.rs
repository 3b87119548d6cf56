//! Depth as a PNG of 16-bit grey, for programs that read no floats: value = scale · Z, rounded; read in whatever unit.
//!
//! 0 where depth is no finite number above 0; the largest value, 65535, there or farther. The scale, which motion.json
//! tells as `depth_scale`, makes the most of the range: the farthest depth is 65535, unless most pixels would then be
//! known less well than to one part in 4096. PFM (`pfm.rs`) keeps every bit instead.

use super::png::{self, Samples, Unread, wrong};
use super::{bounded, unreadable};
use crate::error::Error;
use crate::grid::Grid;

const FORMAT: &str = "16-bit grey PNG of depth";

/// The least that the median depth becomes: half a level is one part in 4096.
const MEDIAN: f32 = 2048.0;

/// Levels per unit of depth for [`write()`]; 1 where no depth is known.
pub fn scale(depth: &Grid<f32>) -> f64 {
    let mut known: Vec<f32> = (depth.data().iter().copied())
        .filter(|z| known(*z))
        .collect();
    if known.is_empty() {
        return 1.0;
    }
    let middle = known.len() / 2;
    let (_, &mut median, beyond) = known.select_nth_unstable_by(middle, f32::total_cmp);
    let farthest = beyond.iter().copied().fold(median, f32::max);
    f64::from(u16::MAX) / f64::from(farthest.min(f32::from(u16::MAX) / MEDIAN * median))
}

/// The bytes of the file.
///
/// # Errors
/// [`Error::File`] for a grid without pixels.
pub fn write(depth: &Grid<f32>, scale: f64) -> Result<Vec<u8>, Error> {
    let level = |z: f32| {
        if !known(z) {
            return 0;
        }
        (scale * f64::from(z)).round().clamp(1.0, u16::MAX.into()) as u16
    };
    png::write_grey16(&depth.map(level))
}

/// Reads such a file; what is unknown becomes not-a-number. `name` is what error messages call it.
///
/// # Errors
/// [`Error::File`] for anything else, and for sides above the largest frame's.
pub fn read(bytes: &[u8], name: &str) -> Result<Grid<f32>, Error> {
    let file = Unread::open(bytes).map_err(|e| wrong(name, FORMAT, e))?;
    let (width, height) = bounded(name, FORMAT, file.width.into(), file.height.into())?;
    let picture = file.read().map_err(|e| wrong(name, FORMAT, e))?;
    let (1, Samples::Words(samples)) = (picture.channels, picture.samples) else {
        return Err(unreadable(
            name,
            FORMAT,
            "its pixels are not one 16-bit number each",
        ));
    };
    let known = |sample: u16| {
        if sample == 0 {
            f32::NAN
        } else {
            f32::from(sample)
        }
    };
    Grid::from_vec(width, height, samples.into_iter().map(known).collect())
}

fn known(z: f32) -> bool {
    z.is_finite() && z > 0.0
}
