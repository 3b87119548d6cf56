//! The inverse depth of one region over the whole frame: the system that both depth and the joint motion
//! step solve.
//!
//! ```text
//! E(ρ) = Σ ω_i (r + a δρ)² + Σ_edges c_ij ( (ρ − plane)_i − (ρ − plane)_j )²
//! ```
//!
//! ρ = 1/Z makes the data term linear. Smoothing acts on what ρ departs from the plane that fits the
//! region best: ρ of a plane is linear in (x, y), so that a slanted wall costs nothing, and where there
//! is no data, beyond the region's curve, ρ goes on as the plane does. c is (11) or (12) of
//! ‖∇(ρ − plane)‖/ε, lagged; ε is in units of mean ρ per focal length, so that it means a slope of the
//! surface and not of pixels, and the weight is in units of the noise's variance.

use super::elliptic::Elliptic;
use crate::grid::Grid;
use crate::motion::solve_positive;
use crate::options::Diffusion;

/// Smoothness of a region's ρ.
#[derive(Clone, Copy, Debug)]
pub struct FieldPrior {
    /// (11) or (12).
    pub diffusion: Diffusion,
    /// Noise variance times the weight of smoothness, grey levels².
    pub strength: f64,
    /// ε, per pixel.
    pub epsilon: f64,
    /// Weight of (ρ − 1)² at each pixel of the region, grey levels².
    pub relief: f64,
}

/// Weights of the edges to the right and below.
pub struct Edges {
    right: Vec<f32>,
    below: Vec<f32>,
}

impl FieldPrior {
    /// c for every edge of `departure` = ρ − plane.
    pub fn edges(&self, departure: &Grid<f32>) -> Edges {
        let (width, height) = (departure.width(), departure.height());
        let e2 = (self.epsilon * self.epsilon) as f32;
        let flat = (self.strength as f32) / e2;
        let weight = |r2: f32| match self.diffusion {
            Diffusion::Anisotropic => flat / (1.0 + r2 / e2).sqrt(),
            Diffusion::Isotropic => flat,
        };
        let mut right = vec![0.0; width * height];
        let mut below = vec![0.0; width * height];
        for y in 0..height {
            for x in 0..width {
                let i = y * width + x;
                let here = departure.data()[i];
                let dx = if x + 1 < width {
                    departure.data()[i + 1] - here
                } else {
                    0.0
                };
                let dy = if y + 1 < height {
                    departure.data()[i + width] - here
                } else {
                    0.0
                };
                let c = weight(dx * dx + dy * dy);
                if x + 1 < width {
                    right[i] = c;
                }
                if y + 1 < height {
                    below[i] = c;
                }
            }
        }
        Edges { right, below }
    }
}

impl Edges {
    /// The operator with data weights `data` on the diagonal.
    pub fn system(&self, width: usize, height: usize, data: Vec<f32>) -> Elliptic {
        Elliptic::new(width, height, data, self.right.clone(), self.below.clone())
    }

    /// −L(departure): how smoothing pulls on the field as it is.
    pub fn pull(&self, departure: &Grid<f32>) -> Grid<f32> {
        let (width, height) = (departure.width(), departure.height());
        let mut pull = Grid::new(width, height, 0.0f32);
        let d = departure.data();
        let out = pull.data_mut();
        for y in 0..height {
            for x in 0..width {
                let i = y * width + x;
                if x + 1 < width {
                    let flux = self.right[i] * (d[i + 1] - d[i]);
                    out[i] += flux;
                    out[i + 1] -= flux;
                }
                if y + 1 < height {
                    let flux = self.below[i] * (d[i + width] - d[i]);
                    out[i] += flux;
                    out[i + width] -= flux;
                }
            }
        }
        pull
    }

    /// Σ c over the neighbours of pixel `i` in a frame `width` wide.
    pub fn around(&self, i: usize, width: usize) -> f64 {
        let mut sum = self.right[i] + self.below[i];
        if i > 0 {
            sum += self.right[i - 1];
        }
        if i >= width {
            sum += self.below[i - width];
        }
        f64::from(sum)
    }

    /// Σ c (difference)².
    pub fn energy(&self, departure: &Grid<f32>) -> f64 {
        let width = departure.width();
        let d = departure.data();
        let mut sum = 0.0;
        for i in 0..d.len() {
            if self.right[i] > 0.0 {
                sum += f64::from(self.right[i] * (d[i + 1] - d[i]).powi(2));
            }
            if self.below[i] > 0.0 {
                sum += f64::from(self.below[i] * (d[i + width] - d[i]).powi(2));
            }
        }
        sum
    }
}

/// The plane α + βx + γy nearest to `rho` under `weight`, at every pixel.
pub fn fitted_plane(rho: &Grid<f32>, weight: &Grid<f32>) -> Grid<f32> {
    let plane = Plane::fit(rho, weight);
    Grid::from_fn(rho.width(), rho.height(), |x, y| {
        plane.at(x as f64, y as f64) as f32
    })
}

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

    fn basis(&self, x: f64, y: f64) -> [f64; 3] {
        let [cx, cy] = self.middle;
        [1.0, (x - cx) / self.unit, (y - cy) / self.unit]
    }
}
