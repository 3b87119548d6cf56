//! Semi-global matching: smoothing of a cost volume along four paths (Hirschmüller 2008).
//!
//! ```text
//! L_r(x, k) = C(x, k) + min( L_r(x−r, k), L_r(x−r, k±1) + P1, min_i L_r(x−r, i) + P2 ) − min_i L_r(x−r, i)
//! S(x, k)   = Σ_r L_r(x, k)            r = ±(1, 0), ±(0, 1)
//! ```
//!
//! P1 is for a change of depth by one label, P2 for any larger one; P2 is less where the picture has an edge:
//! P2 = max(60/(1 + |ΔI|/8), 20), ΔI in grey levels. Costs are bytes, sums saturate at 255.

use crate::grid::Grid;

/// P1, in units of the costs.
const SMALL_STEP: u8 = 6;
/// P2 where the picture is even.
const LARGE_STEP: f32 = 60.0;
/// Least P2.
const LEAST_STEP: f32 = 20.0;
/// Grey levels at which P2 has halved.
const EDGE: f32 = 8.0;

/// S for `costs` of `labels` values a pixel, pixels in row order; `guide` is the picture.
pub fn aggregate(costs: &[u8], labels: usize, guide: &Grid<f32>) -> Vec<u16> {
    debug_assert_eq!(costs.len(), labels * guide.len());
    let mut sums = vec![0u16; costs.len()];
    for forward in [true, false] {
        scan(costs, labels, guide, forward, &mut sums);
    }
    sums
}

/// A path's values at one pixel, with a label that nothing takes before the first and after the last.
struct Path {
    values: Vec<u8>,
    least: u8,
}

impl Path {
    fn new(labels: usize) -> Self {
        let mut path = Self {
            values: vec![u8::MAX; labels + 2],
            least: 0,
        };
        path.begin();
        path
    }

    /// Before the first pixel of a path every label costs nothing.
    fn begin(&mut self) {
        let end = self.values.len() - 1;
        self.values[1..end].fill(0);
        self.least = 0;
    }
}

/// The paths that come from the left and from above, or with `forward` false from the right and from below.
fn scan(costs: &[u8], labels: usize, guide: &Grid<f32>, forward: bool, sums: &mut [u16]) {
    let (width, height) = (guide.width(), guide.height());
    let mut before = Path::new(labels);
    let mut here = Path::new(labels);
    let mut above: Vec<Path> = (0..width).map(|_| Path::new(labels)).collect();
    for row in 0..height {
        let y = if forward { row } else { height - 1 - row };
        let last = if forward {
            y.checked_sub(1)
        } else {
            Some(y + 1)
        };
        let greys = guide.row(y);
        let greys_before = last.filter(|&y| y < height).map(|y| guide.row(y));
        before.begin();
        let mut grey_before = None;
        for column in 0..width {
            let x = if forward { column } else { width - 1 - column };
            let i = (y * width + x) * labels;
            let cost = &costs[i..i + labels];
            let sum = &mut sums[i..i + labels];
            let penalty = |grey: Option<f32>| {
                let step = grey.map_or(f32::MAX, |grey| (grey - greys[x]).abs());
                (LARGE_STEP / (1.0 + step / EDGE)).max(LEAST_STEP) as u8
            };
            advance(cost, &before, penalty(grey_before), &mut here, sum);
            std::mem::swap(&mut before, &mut here);
            let large = penalty(greys_before.map(|greys| greys[x]));
            advance(cost, &above[x], large, &mut here, sum);
            std::mem::swap(&mut above[x], &mut here);
            grey_before = Some(greys[x]);
        }
    }
}

/// One step along a path, from `from` to `to`.
fn advance(cost: &[u8], from: &Path, large: u8, to: &mut Path, sum: &mut [u16]) {
    let n = cost.len();
    let least = from.least;
    let most = least.saturating_add(large);
    let (below, same, above) = (
        &from.values[..n],
        &from.values[1..n + 1],
        &from.values[2..n + 2],
    );
    let out = &mut to.values[1..n + 1];
    let sum = &mut sum[..n];
    let mut smallest = u8::MAX;
    for k in 0..n {
        let near = below[k].min(above[k]).saturating_add(SMALL_STEP);
        let best = same[k].min(near).min(most);
        let value = (best - least).saturating_add(cost[k]);
        out[k] = value;
        smallest = smallest.min(value);
        sum[k] += u16::from(value);
    }
    to.least = smallest;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_the_least_sum_of_costs_and_steps() {
        // A single row: both ways along it, the sum less the cost counted twice is the least total by a label.
        let (labels, width) = (16, 6);
        let cost = |x: usize, k: usize| ((x * 31 + k * 17 + x * k * 7) % 40) as u8;
        let costs: Vec<u8> = (0..width * labels)
            .map(|i| cost(i / labels, i % labels))
            .collect();
        let guide = Grid::new(width, 1, 100.0);
        let mut sums = vec![0u16; costs.len()];
        scan(&costs, labels, &guide, true, &mut sums);
        // Brute force: Viterbi with plain numbers.
        let step = |a: usize, b: usize| match a.abs_diff(b) {
            0 => 0,
            1 => i32::from(SMALL_STEP),
            _ => LARGE_STEP as i32,
        };
        let mut path: Vec<i32> = (0..labels).map(|k| i32::from(cost(0, k))).collect();
        for x in 1..width {
            let least = *path.iter().min().unwrap();
            path = (0..labels)
                .map(|k| {
                    let from = (0..labels).map(|i| path[i] + step(i, k)).min().unwrap();
                    from - least + i32::from(cost(x, k))
                })
                .collect();
            for k in 0..labels {
                // The path from above has one pixel: the cost itself.
                let expected = path[k] + i32::from(cost(x, k));
                assert_eq!(i32::from(sums[x * labels + k]), expected, "{x} {k}");
            }
        }
    }

    #[test]
    fn a_speck_of_doubt_follows_its_surroundings() {
        let labels = 16;
        let guide = Grid::new(9, 9, 50.0);
        let costs: Vec<u8> = (0..81 * labels)
            .map(|i| match (i / labels, i % labels) {
                (40, k) => 20 - (k == 12) as u8 * 9,
                (_, k) => 10 * usize::abs_diff(k, 3).min(4) as u8,
            })
            .collect();
        let sums = aggregate(&costs, labels, &guide);
        let at = &sums[40 * labels..41 * labels];
        let best = (0..labels).min_by_key(|&k| at[k]).unwrap();
        assert_eq!(best, 3);
    }
}
