//! The inverse depth of one region: the system that both depth and the joint motion step solve.
//!
//! ```text
//! E(ρ) = Σ ω_i (r + a δρ)² + Σ_edges c_ij ( ρ_j − ρ_i − s_ij )² + κ Σ (ρ − 1)²
//! ```
//!
//! ρ = 1/Z makes the data term linear. s is the step that is expected (`bends.rs`), lagged: what is smoothed is how
//! ρ bends. c is (11) or (12) of the bend over ε, lagged; ε is in units of mean ρ per focal length, so that it
//! means a slope of the surface and not of pixels, and less on creases (`crease.rs`). Weights are in units of the
//! noise's variance. κ keeps relief that nothing shows from growing.

use super::bends::Bends;
use super::elliptic::Elliptic;
use crate::grid::Grid;
use crate::motion::solve_positive;
use crate::options::Diffusion;

/// Smoothness of a region's ρ.
#[derive(Clone, Debug)]
pub struct FieldPrior {
    /// (11) or (12).
    pub diffusion: Diffusion,
    /// Noise variance times the weight of smoothness, grey levels².
    pub strength: f64,
    /// ε, per pixel.
    pub epsilon: f64,
    /// The share of ε that holds for the step to the right, and for the one down, of every pixel; none for all of it.
    pub creases: Option<[Grid<f32>; 2]>,
    /// Weight of (ρ − 1)² at each pixel of the region, grey levels².
    pub relief: f64,
}

/// Weights of the edges to the right and below.
pub struct Edges {
    right: Vec<f32>,
    below: Vec<f32>,
}

impl FieldPrior {
    /// c for every edge.
    pub fn edges(&self, bends: &Bends) -> Edges {
        let (width, height) = (bends.right.width(), bends.right.height());
        let e2 = (self.epsilon * self.epsilon) as f32;
        let flat = (self.strength as f32) / e2;
        let share =
            |axis: usize, i: usize| self.creases.as_ref().map_or(1.0, |s| s[axis].data()[i]);
        let weight = |axis: usize, i: usize, r2: f32| match self.diffusion {
            Diffusion::Anisotropic => {
                let s = share(axis, i);
                flat / (1.0 + r2 / (e2 * s * s)).sqrt()
            }
            Diffusion::Isotropic => flat,
        };
        let mut right = vec![0.0; width * height];
        let mut below = vec![0.0; width * height];
        for y in 0..height {
            for x in 0..width {
                let i = y * width + x;
                let (dx, dy) = (bends.right.data()[i], bends.down.data()[i]);
                let r2 = dx * dx + dy * dy;
                if x + 1 < width {
                    right[i] = weight(0, i, r2);
                }
                if y + 1 < height {
                    below[i] = weight(1, i, r2);
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

    /// How smoothing pulls on the field as it is: minus half the energy's gradient.
    pub fn pull(&self, bends: &Bends) -> Grid<f32> {
        let (width, height) = (bends.right.width(), bends.right.height());
        let mut pull = Grid::new(width, height, 0.0f32);
        let out = pull.data_mut();
        for y in 0..height {
            for x in 0..width {
                let i = y * width + x;
                if x + 1 < width {
                    let flux = self.right[i] * bends.right.data()[i];
                    out[i] += flux;
                    out[i + 1] -= flux;
                }
                if y + 1 < height {
                    let flux = self.below[i] * bends.down.data()[i];
                    out[i] += flux;
                    out[i + width] -= flux;
                }
            }
        }
        pull
    }

    /// γ = Σ h/(h + Σc): how many of the field's values the data weights h determine, the rest being
    /// smoothed over. Pixel by pixel, which counts each neighbour as known.
    pub fn determined(&self, data: &Grid<f32>) -> f64 {
        let around = |i: usize| {
            let mut sum = self.right[i] + self.below[i];
            if i > 0 {
                sum += self.right[i - 1];
            }
            if i >= data.width() {
                sum += self.below[i - data.width()];
            }
            f64::from(sum)
        };
        let each = data.data().iter().enumerate();
        each.filter(|(_, h)| **h > 0.0)
            .map(|(i, &h)| f64::from(h) / (f64::from(h) + around(i)))
            .sum()
    }

    /// Σ c (bend)² over the pixels that are `owned`: how the field goes on elsewhere is no part of (7).
    pub fn energy(&self, bends: &Bends, owned: &Grid<f32>) -> f64 {
        let (right, down) = (bends.right.data(), bends.down.data());
        let each = owned.data().iter().enumerate().map(|(i, &own)| {
            let bent = self.right[i] * right[i] * right[i] + self.below[i] * down[i] * down[i];
            f64::from(own * bent)
        });
        each.sum()
    }
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

    /// Its rise over a pixel to the right and down.
    pub fn slope(&self) -> [f64; 2] {
        [1, 2].map(|i| self.coefficients[i] / self.unit)
    }

    fn basis(&self, x: f64, y: f64) -> [f64; 3] {
        let [cx, cy] = self.middle;
        [1.0, (x - cx) / self.unit, (y - cy) / self.unit]
    }
}
