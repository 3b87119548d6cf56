//! Gaussian smoothing, G_σ * I: separable, cut at 3σ, the border repeated outwards.

use crate::grid::Grid;

/// `grid` smoothed with standard deviation `sigma` in pixels; unchanged when `sigma` is 0.
pub fn blur(grid: &Grid<f32>, sigma: f64) -> Grid<f32> {
    if sigma <= 0.0 {
        return grid.clone();
    }
    let kernel = half_gaussian(sigma);
    let (width, height) = (grid.width(), grid.height());
    let reach = kernel.len() - 1;
    let mut across = Grid::new(width, height, 0.0f32);
    let mut padded = vec![0.0f32; width + 2 * reach];
    for y in 0..height {
        let row = grid.row(y);
        padded[..reach].fill(row[0]);
        padded[reach..reach + width].copy_from_slice(row);
        padded[reach + width..].fill(row[width - 1]);
        let out = across.row_mut(y);
        for (o, &p) in out.iter_mut().zip(&padded[reach..]) {
            *o = kernel[0] * p;
        }
        for (i, &k) in kernel.iter().enumerate().skip(1) {
            for (x, o) in out.iter_mut().enumerate() {
                *o += k * (padded[reach + x - i] + padded[reach + x + i]);
            }
        }
    }
    let mut down = Grid::new(width, height, 0.0f32);
    for y in 0..height {
        let out = down.row_mut(y);
        for (i, &k) in kernel.iter().enumerate() {
            let above = across.row(y.saturating_sub(i));
            if i == 0 {
                for (o, &a) in out.iter_mut().zip(above) {
                    *o = k * a;
                }
            } else {
                let below = across.row((y + i).min(height - 1));
                for ((o, &a), &b) in out.iter_mut().zip(above).zip(below) {
                    *o += k * (a + b);
                }
            }
        }
    }
    down
}

/// The right half of the kernel, its centre first; all of it sums to 1.
pub(crate) fn half_gaussian(sigma: f64) -> Vec<f32> {
    let reach = (3.0 * sigma).ceil().max(1.0) as usize;
    let weights: Vec<f64> = (0..=reach)
        .map(|i| (-0.5 * (i as f64 / sigma).powi(2)).exp())
        .collect();
    let sum = weights[0] + 2.0 * weights[1..].iter().sum::<f64>();
    weights.iter().map(|w| (w / sum) as f32).collect()
}
