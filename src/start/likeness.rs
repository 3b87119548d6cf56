//! Whether two frames show the same things at all: how much of what patches show is there again.
//!
//! ```text
//! likeness = Σ 2 cov(I1(x), I2(x+w)) / Σ (var I1(x) + var I2(x+w))
//! ```
//!
//! over all patches, each with its displacement w: 1 where the second frame is the first one moved, 0
//! where it has nothing of it. Matching makes even noise a little alike.

use super::patches::{HALF, Patch};
use super::scale::Scale;

/// Likeness of the frames of a scale, in patches matched there.
pub(super) fn likeness(scale: &Scale, patches: &[Patch]) -> f64 {
    let (mut common, mut all) = (0.0, 0.0);
    for patch in patches {
        let [both, either] = of(scale, patch);
        common += both;
        all += either;
    }
    common / f64::max(all, f64::MIN_POSITIVE)
}

/// 2 cov and the sum of variances of one patch, times its number of pixels.
fn of(scale: &Scale, patch: &Patch) -> [f64; 2] {
    let (mut sum, mut product, mut squares) = ([0.0; 2], 0.0, 0.0);
    let side = 2 * HALF + 1;
    for i in 0..side * side {
        let [x, y] = [(patch.x, i % side), (patch.y, i / side)]
            .map(|(centre, at)| centre + at as f32 - HALF as f32);
        let first = f64::from(scale.first.bilinear(x, y));
        let moved = (x + patch.motion[0], y + patch.motion[1]);
        let second = f64::from(scale.second.bilinear(moved.0, moved.1));
        sum = [sum[0] + first, sum[1] + second];
        product += first * second;
        squares += first * first + second * second;
    }
    let count = (side * side) as f64;
    [
        2.0 * (product - sum[0] * sum[1] / count),
        squares - (sum[0] * sum[0] + sum[1] * sum[1]) / count,
    ]
}
