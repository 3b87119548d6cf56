//! Where depth leaps within a region: one surface ends there, and another goes on behind it.
//!
//! Solvers spread a leap over some pixels. It is one where 1/Z changes within [`REACH`] pixels by half of what it does
//! within [`BEYOND`]; a plane changes by a third. Between the least and the greatest 1/Z of the latter,
//!
//! ```text
//! ψ = (blurred 1/Z − (least + greatest)/2) / (greatest − least)
//! ```
//!
//! is positive on the nearer side and negative on the farther one; its zero is the outline between pixels. What lies in
//! between takes the depth of the side that it is on, so that nothing spans the leap.

use std::ops::{Range, RangeInclusive};

use crate::grid::Grid;
use crate::window::places;

/// Pixels on each side over which a leap may be spread.
const REACH: usize = 5;
/// Where, in pixels, it is looked whether a change goes on, and the least share of it all that a leap is.
const BEYOND: usize = 14;
const CONCENTRATED: f32 = 0.55;
/// The shares of the ranges of 1/Z and of Z that are drawn from which a change is a leap: less is a step within one thing.
const SHARE: [f32; 2] = [0.15, 0.12];
/// The least ratio of depths that is one: a shallow relief is drawn deeper than it is.
const RATIO: f32 = 1.12;
/// Binomial weights, σ ≈ 1.2 pixels: they round the stairs of labels and leave curves where they are.
pub(super) const LABELS: [f32; 7] = [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0];
/// The same, σ ≈ 1.6 pixels, for outlines within a region, which are found less exactly.
const DEPTHS: [f32; 11] = [
    1.0, 10.0, 45.0, 120.0, 210.0, 252.0, 210.0, 120.0, 45.0, 10.0, 1.0,
];

/// What makes a leap of a change of 1/Z.
#[derive(Clone, Copy)]
pub(super) struct Leap {
    /// Least differences of 1/Z and of Z.
    least: [f32; 2],
}

impl Leap {
    /// For a picture whose 1/Z goes from `far` to `near`.
    pub fn of(far: f32, near: f32) -> Self {
        Self {
            least: [SHARE[0] * (near - far), SHARE[1] * (1.0 / far - 1.0 / near)],
        }
    }

    /// A change half as large.
    pub fn half(self) -> Self {
        Self {
            least: self.least.map(|least| least / 2.0),
        }
    }

    /// Whether there is one between two inverse depths.
    pub fn between(self, a: f32, b: f32) -> bool {
        let (low, high) = (a.min(b), a.max(b));
        // Z's difference, times the product of both 1/Z.
        let apart = high - low;
        high > RATIO * low && (apart > self.least[0] || apart > self.least[1] * low * high)
    }
}

/// Where depth leaps within the regions of `labels`, row by row, with the least and the greatest 1/Z there and beyond.
fn leaping(rho: &Grid<f32>, labels: &Grid<u8>, leap: Leap) -> Vec<(Around, [f32; 2])> {
    let (low, high) = (least_near(rho), greatest_near(rho));
    let mut leaps = Vec::new();
    for y in 0..rho.height() {
        let windows = low.row(y).iter().zip(high.row(y));
        for (x, (&low, &high)) in windows.enumerate() {
            // Over all regions first, which is quick and never misses one.
            if !leap.between(low, high) {
                continue;
            }
            let around = Around::of(rho, labels, (x, y));
            if !leap.between(around.low, around.high) {
                continue;
            }
            let [low, high] = beyond(rho, labels, &around);
            // A steep plane goes on changing.
            if around.high - around.low > CONCENTRATED * (high - low) {
                leaps.push((around, [low, high]));
            }
        }
    }
    leaps
}

/// The least and the greatest 1/Z of a pixel's region around it and [`BEYOND`] it.
fn beyond(rho: &Grid<f32>, labels: &Grid<u8>, around: &Around) -> [f32; 2] {
    let (x, y) = around.at;
    let (mut low, mut high) = (around.low, around.high);
    for y in [y.checked_sub(BEYOND), Some(y), Some(y + BEYOND)] {
        for x in [x.checked_sub(BEYOND), Some(x), Some(x + BEYOND)] {
            let Some(place) = x.zip(y).filter(|p| p.0 < rho.width() && p.1 < rho.height()) else {
                continue;
            };
            if labels[place] == around.label {
                (low, high) = (low.min(rho[place]), high.max(rho[place]));
            }
        }
    }
    [low, high]
}

/// Sharpens the leaps of `rho` within the regions of `labels` and gives ψ, not a number where depth does not leap.
pub(super) fn sharpen(rho: &mut Grid<f32>, labels: &Grid<u8>, leap: Leap) -> Grid<f32> {
    let mut psi = Grid::new(rho.width(), rho.height(), f32::NAN);
    let leaps = leaping(rho, labels, leap);
    let blunt = rho.clone();
    for (around, [low, high]) in leaps {
        let range = around.high - around.low;
        let quarter = 0.25 * range;
        let side = around.mean(&blunt, labels, 0.0..=f32::INFINITY) - (low + high) / 2.0;
        psi[around.at] = side / (high - low);
        let here = blunt[around.at];
        if side >= 0.0 {
            if here < around.high - 0.1 * range {
                let nearest = around.high - quarter;
                rho[around.at] = around.mean(&blunt, labels, nearest..=f32::INFINITY);
            }
        } else if here > around.low + 0.1 * range {
            let farthest = around.low + quarter;
            rho[around.at] = around.mean(&blunt, labels, 0.0..=farthest);
        }
    }
    psi
}

/// What a region has within [`REACH`] of a pixel.
struct Around {
    at: (usize, usize),
    label: u8,
    low: f32,
    high: f32,
}

impl Around {
    fn of(rho: &Grid<f32>, labels: &Grid<u8>, at: (usize, usize)) -> Self {
        let label = labels[at];
        let (mut low, mut high) = (f32::INFINITY, 0.0f32);
        let (columns, rows) = within(rho, at);
        for y in rows {
            let values = &rho.row(y)[columns.clone()];
            for (&value, &other) in values.iter().zip(&labels.row(y)[columns.clone()]) {
                if other == label {
                    low = if value < low { value } else { low };
                    high = if value > high { value } else { high };
                }
            }
        }
        Self {
            at,
            label,
            low,
            high,
        }
    }

    /// The weighted mean of those values that are to be kept.
    fn mean(&self, rho: &Grid<f32>, labels: &Grid<u8>, keep: RangeInclusive<f32>) -> f32 {
        let (mut sum, mut weights) = (0.0, 0.0);
        let (columns, rows) = within(rho, self.at);
        let first = columns.start + REACH - self.at.0;
        for y in rows {
            let down = DEPTHS[y + REACH - self.at.1];
            let values = &rho.row(y)[columns.clone()];
            let owners = &labels.row(y)[columns.clone()];
            let pixels = values.iter().zip(owners).zip(&DEPTHS[first..]);
            for ((&value, &label), across) in pixels {
                if label == self.label && keep.contains(&value) {
                    let weight = across * down;
                    sum += value * weight;
                    weights += weight;
                }
            }
        }
        sum / f32::max(weights, 1e-9)
    }
}

/// Columns and rows of the picture within [`REACH`] of a pixel.
fn within(rho: &Grid<f32>, (x, y): (usize, usize)) -> (Range<usize>, Range<usize>) {
    let range = |at: usize, side: usize| at.saturating_sub(REACH)..(at + REACH + 1).min(side);
    (range(x, rho.width()), range(y, rho.height()))
}

/// The pixels around `at` that lie in the picture, with their weights.
pub(super) fn neighbourhood<const N: usize>(
    weights: &'static [f32; N],
    width: usize,
    height: usize,
    (x, y): (usize, usize),
) -> impl Iterator<Item = ((usize, usize), f32)> {
    let range = |at: usize, side: usize| at.saturating_sub(N / 2)..(at + N / 2 + 1).min(side);
    places(range(x, width), range(y, height)).map(move |near| {
        let [i, j] = [near.0 + N / 2 - x, near.1 + N / 2 - y];
        (near, weights[i] * weights[j])
    })
}

/// The least value within [`REACH`] of each pixel, of values that are all numbers. Windows are doubled: of 2 pixels, of
/// 4, of 8, and two of those that overlap are the 11.
pub(super) fn least_near(grid: &Grid<f32>) -> Grid<f32> {
    let (width, height) = (grid.width(), grid.height());
    let mut out = grid.clone();
    let mut padded = vec![0.0; width + 2 * REACH];
    for y in 0..height {
        let row = out.row_mut(y);
        padded[..REACH].fill(row[0]);
        padded[REACH..REACH + width].copy_from_slice(row);
        padded[REACH + width..].fill(row[width - 1]);
        for apart in [1, 2, 4] {
            // From the start on, so that what is read is not written yet.
            for i in 0..padded.len() - apart {
                padded[i] = lesser(padded[i], padded[i + apart]);
            }
        }
        lesser_of(row, &padded, &padded[OVERLAPPING..]);
    }
    // Rows the same way, the first and the last repeated.
    let rows = height + 2 * REACH;
    let mut ladder = Vec::with_capacity(rows * width);
    for y in 0..rows {
        ladder.extend_from_slice(out.row(y.saturating_sub(REACH).min(height - 1)));
    }
    for apart in [1, 2, 4] {
        for y in 0..rows - apart {
            let (here, below) = ladder[y * width..].split_at_mut(apart * width);
            for (value, &other) in here[..width].iter_mut().zip(&below[..width]) {
                *value = lesser(*value, other);
            }
        }
    }
    for y in 0..height {
        let (first, second) = (&ladder[y * width..], &ladder[(y + OVERLAPPING) * width..]);
        lesser_of(out.row_mut(y), first, second);
    }
    out
}

/// The greatest in the same way.
pub(super) fn greatest_near(grid: &Grid<f32>) -> Grid<f32> {
    let mut least = least_near(&grid.map(|value| -value));
    least
        .data_mut()
        .iter_mut()
        .for_each(|value| *value = -*value);
    least
}

/// Whether all pixels within [`REACH`] have the label of this one.
pub(super) fn one_label_near(labels: &Grid<u8>) -> Grid<bool> {
    let numbers = labels.map(f32::from);
    let (least, greatest) = (least_near(&numbers), greatest_near(&numbers));
    Grid::from_fn(labels.width(), labels.height(), |x, y| {
        least[(x, y)] == greatest[(x, y)]
    })
}

/// Columns of both sides of a window, itself included, and what two windows of 8 pixels are apart that make it up.
const WINDOW: usize = 2 * REACH + 1;
const OVERLAPPING: usize = WINDOW - 8;

/// Of numbers; one instruction, as `f32::min` is not.
fn lesser(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

fn lesser_of(out: &mut [f32], first: &[f32], second: &[f32]) {
    for (value, (&a, &b)) in out.iter_mut().zip(first.iter().zip(second)) {
        *value = lesser(a, b);
    }
}
