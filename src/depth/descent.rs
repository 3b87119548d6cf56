//! Depth by descent on Z, equation (9):
//!
//! ```text
//! ∂Z/∂t = 2 (s·T/Z²) ψ + μ div( g'(‖∇Z‖)/‖∇Z‖ ∇Z ),   Neumann border
//! ```
//!
//! which is minus the gradient of E(Z) = Σ ψ² + μ Σ g(‖∇Z‖) with ‖∇Z‖² of forward differences, exactly
//! so on the pixel grid. ψ = a/Z + b with a = s·T and b = It + q·ω of the region that owns the pixel.
//! Every pixel steps by its own curvature (a diagonal preconditioner): where T is large a common step
//! small enough to be stable would leave the rest standing. Each step is accepted only if the energy
//! falls, and halved otherwise; a pass stops after the given number of steps, or as soon as no step
//! down to a 64th lowers the energy any further.

use super::smoothness::Smoothness;
use crate::grid::Grid;

/// Depth is kept between these, in units in which a region's mean 1/Z is 1.
pub const NEAREST_FARTHEST: [f32; 2] = [0.02, 50.0];

/// The part of (7) that depends on Z, for given motions and labels.
pub struct DepthDescent<'a> {
    /// a = s·T at every pixel.
    pub slope: &'a Grid<f32>,
    /// b = It + q·ω at every pixel.
    pub offset: &'a Grid<f32>,
    /// g and μ.
    pub smoothness: Smoothness,
}

impl DepthDescent<'_> {
    /// E(Z): data and smoothness.
    pub fn energy(&self, z: &Grid<f32>) -> f64 {
        let (width, height) = (z.width(), z.height());
        let mut sum = 0.0;
        for y in 0..height {
            for x in 0..width {
                let at = (x, y);
                let psi = f64::from(self.slope[at]) / f64::from(z[at]) + f64::from(self.offset[at]);
                sum += psi * psi + self.smoothness.energy(gradient2(z, x, y));
            }
        }
        sum
    }

    /// ∂E/∂Z at every pixel, and the curvature bound that its step is scaled with.
    pub fn gradient(&self, z: &Grid<f32>) -> (Grid<f32>, Grid<f32>) {
        let (width, height) = (z.width(), z.height());
        let mut slope = Grid::new(width, height, 0.0f64);
        let mut bound = Grid::new(width, height, 0.0f64);
        for y in 0..height {
            for x in 0..width {
                let at = (x, y);
                let zc = f64::from(z[at]);
                let a = f64::from(self.slope[at]);
                let psi = a / zc + f64::from(self.offset[at]);
                let along = a / (zc * zc);
                slope[at] -= 2.0 * along * psi;
                bound[at] += 2.0 * along * along;
                // The forward differences of this pixel touch it and its right and lower neighbours.
                let c = self.smoothness.diffusivity(gradient2(z, x, y));
                for (nx, ny) in [(x + 1, y), (x, y + 1)] {
                    if nx < width && ny < height {
                        let d = f64::from(z[(nx, ny)]) - zc;
                        slope[(nx, ny)] += c * d;
                        slope[at] -= c * d;
                        bound[(nx, ny)] += 2.0 * c;
                        bound[at] += 2.0 * c;
                    }
                }
            }
        }
        (slope.map(|g| g as f32), bound.map(|g| g as f32))
    }

    /// Lowers E(Z) by at most `steps` steps.
    pub fn run(&self, z: &mut Grid<f32>, steps: usize) {
        let [nearest, farthest] = NEAREST_FARTHEST;
        let mut energy = self.energy(z);
        let mut rate = 1.0f32;
        for _ in 0..steps {
            let (slope, bound) = self.gradient(z);
            loop {
                let mut trial = z.clone();
                for ((t, &g), &c) in trial
                    .data_mut()
                    .iter_mut()
                    .zip(slope.data())
                    .zip(bound.data())
                {
                    // A pixel never moves by more than a fifth of its depth in one step.
                    let limit = 0.2 * *t;
                    let step = (rate * g / (c + 1e-12)).clamp(-limit, limit);
                    *t = (*t - step).clamp(nearest, farthest);
                }
                let found = self.energy(&trial);
                if found <= energy {
                    *z = trial;
                    energy = found;
                    rate = (2.0 * rate).min(1.0);
                    break;
                }
                rate *= 0.5;
                if rate < 1.0 / 64.0 {
                    return;
                }
            }
        }
    }
}

/// ‖∇Z‖² of forward differences; those across the frame's border are 0.
pub fn gradient2(z: &Grid<f32>, x: usize, y: usize) -> f64 {
    let here = f64::from(z[(x, y)]);
    let right = if x + 1 < z.width() {
        f64::from(z[(x + 1, y)]) - here
    } else {
        0.0
    };
    let below = if y + 1 < z.height() {
        f64::from(z[(x, y + 1)]) - here
    } else {
        0.0
    };
    right * right + below * below
}
