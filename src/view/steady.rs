//! Depth without what nobody would believe: where it is barely observable, it is its region's around it.
//!
//! ```text
//! 1/Z' = c/Z + (1 − c) · (G ∗ c/Z) / (G ∗ c)      c the confidence, full from ½ on; G a Gaussian
//! ```
//!
//! within each region. Where even G ∗ c is next to nothing, depth is not known. Pixels that stand out singly take their
//! neighbourhood's median, and what is left is averaged over five by five pixels, never across a leap.

use super::leaps::{Leap, greatest_near, least_near, one_label_near};
use crate::frames::blur;
use crate::grid::Grid;
use crate::interpretation::Interpretation;
use crate::window::{Places, Window, places};

/// σ of G as a share of the longer side, and at most, in pixels.
const WIDTH: (f32, f32) = (1.0 / 40.0, 10.0);
/// Confidence from which a depth is taken as it is.
const FULL: f32 = 0.5;
/// The least G ∗ c of a known depth.
const SUPPORT: f32 = 0.04;

/// Steadies `rho` in the regions that are `known`; gives whether each pixel's depth is.
pub(super) fn steadied(rho: &mut Grid<f32>, found: &Interpretation, known: &[bool]) -> Grid<bool> {
    let (width, height) = (rho.width(), rho.height());
    let sigma = (WIDTH.0 * width.max(height) as f32).min(WIDTH.1);
    let mut told = found.labels.map(|label| known[usize::from(label)]);
    let trust = found
        .confidence
        .map(|c| if c > 0.0 { (c / FULL).min(1.0) } else { 0.0 });
    for k in (0..=u8::MAX)
        .take(known.len())
        .filter(|&k| known[usize::from(k)])
    {
        let own = |i: usize| found.labels.data()[i] == k;
        let doubtful = (0..rho.len()).any(|i| own(i) && trust.data()[i] < 1.0);
        let Some(w) = Window::around(width, height, own).filter(|_| doubtful) else {
            continue;
        };
        let place = |x: usize, y: usize| (w.left + x, w.top + y);
        let masked = |value: &dyn Fn((usize, usize)) -> f32| {
            let inside = Grid::from_fn(w.width, w.height, |x, y| {
                let at = place(x, y);
                if found.labels[at] == k {
                    value(at)
                } else {
                    0.0
                }
            });
            blur(&inside, f64::from(sigma))
        };
        let weights = masked(&|at| trust[at]);
        let sums = masked(&|at| trust[at] * rho[at]);
        for y in 0..w.height {
            for x in 0..w.width {
                let at = place(x, y);
                if found.labels[at] != k {
                    continue;
                }
                let weight = weights[(x, y)];
                told[at] = weight > SUPPORT;
                let around = sums[(x, y)] / weight;
                if around > 0.0 {
                    rho[at] = trust[at] * rho[at] + (1.0 - trust[at]) * around;
                }
            }
        }
    }
    told
}

/// Replaces `rho` by the median of its region within two pixels, where it changes by half a leap nearby.
pub(super) fn median(rho: &mut Grid<f32>, labels: &Grid<u8>, leap: Leap) {
    let (low, high) = (least_near(rho), greatest_near(rho));
    let leap = leap.half();
    let noisy = rho.clone();
    let mut values = Vec::with_capacity(25);
    for y in 0..rho.height() {
        for x in 0..rho.width() {
            if !leap.between(low[(x, y)], high[(x, y)]) {
                continue;
            }
            values.clear();
            let own = around(&noisy, (x, y)).filter(|&p| labels[p] == labels[(x, y)]);
            values.extend(own.map(|p| noisy[p]));
            let middle = values.len() / 2;
            rho[(x, y)] = *values.select_nth_unstable_by(middle, f32::total_cmp).1;
        }
    }
}

/// Replaces `rho` by the mean of its region within two pixels, but for what lies across a leap. Pixels count in pairs on
/// opposite sides, so that a plane stays one.
pub(super) fn mean(rho: &mut Grid<f32>, labels: &Grid<u8>, leap: Leap) {
    let noisy = rho.clone();
    let (width, height) = (rho.width(), rho.height());
    // Where nothing is near that does not count, which is nearly everywhere, nothing need be asked.
    let (low, high) = (least_near(rho), greatest_near(rho));
    let one_label = one_label_near(labels);
    let sums = sums_of_five(&noisy);
    for y in 0..height {
        for x in 0..width {
            let at = (x, y);
            let here = noisy[at];
            let alike = one_label[at] && !leap.between(low[at], high[at]);
            if alike && x.min(y) >= 2 && x + 2 < width && y + 2 < height {
                rho[at] = (y - 2..y + 3).map(|y| sums[(x, y)]).sum::<f32>() / 25.0;
                continue;
            }
            let counts = |p| labels[p] == labels[at] && !leap.between(noisy[p], here);
            let (mut sum, mut count) = (here, 1.0);
            for p in around(&noisy, at).take_while(|&p| p != at) {
                let q = (2 * x - p.0, 2 * y - p.1);
                if counts(p) && counts(q) {
                    sum += noisy[p] + noisy[q];
                    count += 2.0;
                }
            }
            rho[at] = sum / count;
        }
    }
}

/// Of each pixel and the two on each side of it, where there are.
fn sums_of_five(grid: &Grid<f32>) -> Grid<f32> {
    let mut sums = Grid::new(grid.width(), grid.height(), 0.0);
    for y in 0..grid.height() {
        let Some(inner) = grid.width().checked_sub(4) else {
            break;
        };
        let row = grid.row(y);
        for (sum, five) in sums.row_mut(y)[2..2 + inner].iter_mut().zip(row.windows(5)) {
            *sum = five.iter().sum();
        }
    }
    sums
}

/// The pixels within two of `at`, fewer at the border, always as many on both sides.
fn around(grid: &Grid<f32>, (x, y): (usize, usize)) -> Places {
    let range = |at: usize, side: usize| {
        let reach = at.min(side - 1 - at).min(2);
        at - reach..at + reach + 1
    };
    places(range(x, grid.width()), range(y, grid.height()))
}
