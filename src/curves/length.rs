//! The length of a curve read off its level set: ∫ δ(φ) |∇φ|, δ being a hat one pixel wide on each side.

use crate::grid::Grid;

/// Length of the zero line of φ, in pixels.
pub fn length(phi: &Grid<f32>) -> f64 {
    let width = phi.width();
    let mut sum = 0.0;
    for y in 0..phi.height() {
        let above = phi.row(y.saturating_sub(1));
        let below = phi.row((y + 1).min(phi.height() - 1));
        let here = phi.row(y);
        for (x, p) in here.iter().enumerate().filter(|(_, p)| p.abs() < 1.0) {
            let gx = here[(x + 1).min(width - 1)] - here[x.saturating_sub(1)];
            let gy = below[x] - above[x];
            sum += f64::from((1.0 - p.abs()) * 0.5 * gx.hypot(gy));
        }
    }
    sum
}
