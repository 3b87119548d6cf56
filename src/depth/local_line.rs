//! Local linear regression: what is expected at every pixel of a quantity that is known here and there.
//!
//! ```text
//! m(x) = α of  min_{α, β} Σ_y G_s(y − x) w(y) ( v(y) − α − β·(y − x)/s )² + κ ( α² + ‖β‖² )
//! ```
//!
//! A mean over the same window lags behind wherever the window is cut off: at a region's curve it sees one side
//! only, and calls each surface that curves there bent. A line lags less (Cleveland 1979; Fan 1992). κ,
//! against weights w up to 1, pulls to 0 where little is known. G is cut at 3s; beyond the grid nothing is known.
//! m is smooth: it is computed for each block of 2×2 pixels and interpolated in between.

use crate::frames::{doubled, half_gaussian};
use crate::grid::Grid;

/// κ.
const UNKNOWN: f32 = 0.05;

/// m for `weighted` = w v, under `weight` = w, each pixel 0 to 1; `reach` is s, in pixels, 2 at least.
pub fn local_line(weight: &Grid<f32>, weighted: &Grid<f32>, reach: f64) -> Grid<f32> {
    let (width, height) = (weight.width(), weight.height());
    let of_blocks = by_blocks(&pooled(weight), &pooled(weighted), reach / 2.0);
    doubled(&of_blocks, width, height)
}

/// The mean of each 2×2 pixels, what lies beyond the grid being 0.
fn pooled(grid: &Grid<f32>) -> Grid<f32> {
    let (width, height) = (grid.width(), grid.height());
    Grid::from_fn(width.div_ceil(2), height.div_ceil(2), |x, y| {
        let columns = 2 * x..(2 * x + 2).min(width);
        let rows = 2 * y..(2 * y + 2).min(height);
        let sum: f32 = rows
            .map(|y| grid.row(y)[columns.clone()].iter().sum::<f32>())
            .sum();
        0.25 * sum
    })
}

fn by_blocks(weight: &Grid<f32>, weighted: &Grid<f32>, reach: f64) -> Grid<f32> {
    let kernel = half_gaussian(reach);
    let unit = reach as f32;
    // Σ G w (dx/s)^p (dy/s)^q for p + q up to 2, and the same of w v up to 1.
    let moments = |of: &Grid<f32>, most: i32| -> Vec<Vec<Grid<f32>>> {
        let of_row = |p: i32| {
            let rows = across(of, &kernel, p, unit);
            let each = 0..=most - p;
            each.map(|q| down(&rows, &kernel, q, unit)).collect()
        };
        (0..=most).map(of_row).collect()
    };
    let (w, v) = (moments(weight, 2), moments(weighted, 1));
    Grid::from_fn(weight.width(), weight.height(), |x, y| {
        let at = (x, y);
        let (a, b, c) = (w[0][0][at] + UNKNOWN, w[1][0][at], w[0][1][at]);
        let (d, e, f) = (w[2][0][at] + UNKNOWN, w[1][1][at], w[0][2][at] + UNKNOWN);
        // α by Cramer's rule; the matrix is positive definite, its eigenvalues at least κ.
        let minors = [d * f - e * e, c * e - b * f, b * e - c * d];
        let of_value = minors[0] * v[0][0][at] + minors[1] * v[1][0][at] + minors[2] * v[0][1][at];
        of_value / (a * minors[0] + b * minors[1] + c * minors[2])
    })
}

/// Σ G(d) (d/unit)^power `grid`(x + d) along rows.
fn across(grid: &Grid<f32>, kernel: &[f32], power: i32, unit: f32) -> Grid<f32> {
    let (width, height) = (grid.width(), grid.height());
    let reach = kernel.len() - 1;
    let (weights, mirror) = (factors(kernel, power, unit), mirror(power));
    let mut out = Grid::new(width, height, 0.0f32);
    let mut padded = vec![0.0f32; width + 2 * reach];
    for y in 0..height {
        padded[reach..reach + width].copy_from_slice(grid.row(y));
        for (d, &factor) in weights.iter().enumerate() {
            let ahead = &padded[reach + d..reach + d + width];
            let behind = &padded[reach - d..reach - d + width];
            let mirror = if d == 0 { 0.0 } else { mirror };
            for ((o, &a), &b) in out.row_mut(y).iter_mut().zip(ahead).zip(behind) {
                *o += factor * (a + mirror * b);
            }
        }
    }
    out
}

/// The same along columns.
fn down(grid: &Grid<f32>, kernel: &[f32], power: i32, unit: f32) -> Grid<f32> {
    let (width, height) = (grid.width(), grid.height());
    let (weights, mirror) = (factors(kernel, power, unit), mirror(power));
    let mut out = Grid::new(width, height, 0.0f32);
    for y in 0..height {
        for (d, &factor) in weights.iter().enumerate() {
            let below = (y + d < height).then_some((y + d, factor));
            let above = (d > 0 && y >= d).then(|| (y - d, factor * mirror));
            for (row, factor) in below.into_iter().chain(above) {
                for (o, &value) in out.row_mut(y).iter_mut().zip(grid.row(row)) {
                    *o += factor * value;
                }
            }
        }
    }
    out
}

fn factors(kernel: &[f32], power: i32, unit: f32) -> Vec<f32> {
    let each = kernel.iter().enumerate();
    each.map(|(d, &k)| k * (d as f32 / unit).powi(power))
        .collect()
}

/// The sign of (−d)^power.
fn mirror(power: i32) -> f32 {
    if power % 2 == 0 { 1.0 } else { -1.0 }
}
