//! A plane of inverse depth: what a region's ρ is about, and how it goes on where the region has no pixels.
//!
//! ```text
//! min_{a, b, c}  Σ w_i ( ρ_i − a − b x_i − c y_i )²
//! ```
//!
//! ρ of a plane in space is linear in the pixel's place.

use crate::grid::Grid;
use crate::motion::solve_positive;

/// A plane over a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Its height in the middle of the grid, and its rise over a grid's width to the right and down.
    coefficients: [f64; 3],
    middle: [f64; 2],
    unit: f64,
}

impl Plane {
    /// The plane nearest to `rho` under `weight`; level at 1 when that leaves it open.
    pub fn fit(rho: &Grid<f32>, weight: &Grid<f32>) -> Self {
        let (width, height) = (rho.width(), rho.height());
        let mut plane = Self {
            coefficients: [1.0, 0.0, 0.0],
            middle: [width as f64 / 2.0, height as f64 / 2.0],
            unit: width as f64,
        };
        let mut normal = [[0.0; 3]; 3];
        let mut right = [0.0; 3];
        for y in 0..height {
            for x in 0..width {
                let w = f64::from(weight[(x, y)]);
                if w <= 0.0 {
                    continue;
                }
                let a = plane.basis(x as f64, y as f64);
                for i in 0..3 {
                    for j in 0..=i {
                        normal[i][j] += w * a[i] * a[j];
                    }
                    right[i] += w * a[i] * f64::from(rho[(x, y)]);
                }
            }
        }
        if let Some(found) = solve_positive(&normal, &right) {
            plane.coefficients = found;
        }
        plane
    }

    /// Its height at column `x` and row `y`, which may lie beyond the grid.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        let basis = self.basis(x, y);
        (0..3).map(|i| self.coefficients[i] * basis[i]).sum()
    }

    /// Its rise over a pixel to the right and down.
    pub fn slope(&self) -> [f64; 2] {
        [1, 2].map(|i| self.coefficients[i] / self.unit)
    }

    fn basis(&self, x: f64, y: f64) -> [f64; 3] {
        let [cx, cy] = self.middle;
        [1.0, (x - cx) / self.unit, (y - cy) / self.unit]
    }
}
