//! How far things move between two frames: whether depth can show in it, and whether it can be followed.
//!
//! ```text
//! d = 99th percentile of |x' − x| over the matches that hold together, pixels
//! followed = matches between the frames / matches of the first frame with itself
//! ```
//!
//! A match holds together with its neighbours on the lattice where most of them move as it does to [`ALIKE`] pixels.
//! The percentile is high since a small body before scenery at rest is motion, too; the second count tells lost matches
//! from places that have no texture.

use serde::Serialize;

use super::lattice::Lattice;
use super::matches::{Match, matches};
use crate::grid::Grid;

/// Neighbours move alike to this many pixels.
const ALIKE: f32 = 1.5;
/// Which of the displacements, in order, stands for the motion.
const QUANTILE: f64 = 0.99;
/// Share of the frame's longer side from which depth shows well: a displacement is good to a tenth of a pixel, and this
/// is three pixels and more on frames of the size that is measured.
const SEEN: f64 = 0.01;
/// Share of the longer side up to which it is followed: half of what a solver reaches where curves are drawn.
const REACHED: f64 = 0.07;
/// Share of the matches that have to be left.
const FOLLOWED: f64 = 0.5;

/// Whether two frames go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Too little motion to see depth by.
    Small,
    /// Enough to see, little enough to follow.
    Fit,
    /// Too much to follow, or another picture altogether.
    Large,
}

/// Motion between two frames.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Displacement {
    /// How far the faster things move, in shares of the frame's longer side; 0 where nothing can be matched.
    pub share: f64,
    /// Share of the textured places that are found again, 0–1.
    pub followed: f64,
    /// What that means.
    pub verdict: Verdict,
}

/// The motion between two frames of the same size, grey levels 0–255. Some 320 pixels a side are enough.
///
/// ```
/// use relievo::Grid;
/// use relievo::init::{Verdict, displacement};
///
/// let frame = |shift: f32| Grid::from_fn(160, 120, |x, y| {
///     let (x, y) = (x as f32 - shift, y as f32);
///     120.0 + 40.0 * (0.3 * x + (0.2 * y).sin()).sin() + 40.0 * (0.35 * y + (0.13 * x).cos()).sin()
/// });
/// assert_eq!(displacement(&frame(0.0), &frame(3.0)).verdict, Verdict::Fit);
/// ```
pub fn displacement(first: &Grid<f32>, second: &Grid<f32>) -> Displacement {
    let found = matches(first, second);
    let textured = matches(first, first).len();
    let side = first.width().max(first.height()) as f64;
    let mut lengths = holding_together(&found, first);
    lengths.sort_unstable_by(f32::total_cmp);
    let rank = (QUANTILE * lengths.len().saturating_sub(1) as f64).round() as usize;
    let share = lengths.get(rank).map_or(0.0, |&d| f64::from(d) / side);
    let followed = (lengths.len() as f64 / textured.max(1) as f64).min(1.0);
    let verdict = if textured > 0 && followed < FOLLOWED || share > REACHED {
        Verdict::Large
    } else if share < SEEN {
        Verdict::Small
    } else {
        Verdict::Fit
    };
    Displacement {
        share,
        followed,
        verdict,
    }
}

/// Lengths in pixels of the displacements that most of their neighbours share.
fn holding_together(found: &[Match], frame: &Grid<f32>) -> Vec<f32> {
    let lattice = Lattice::new(found, [frame.width(), frame.height()]);
    let holds = |m: &&Match| {
        let [dx, dy] = m.displacement();
        let (mut alike, mut others) = (0, 0);
        for other in lattice.around(m, 1) {
            let [u, v] = found[other].displacement();
            others += 1;
            alike += usize::from((u - dx).hypot(v - dy) < ALIKE);
        }
        others > 1 && 2 * alike > others
    };
    let lengths = found.iter().filter(holds).map(|m| {
        let [dx, dy] = m.displacement();
        dx.hypot(dy)
    });
    lengths.collect()
}
