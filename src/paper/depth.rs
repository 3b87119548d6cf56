//! Step 2: depth by descent on Z, equation (9):
//!
//! ```text
//! (9)  ∂Z/∂t = 2 (s·T/Z²) ψ + μ div( g'(‖∇Z‖)/‖∇Z‖ ∇Z ),   Neumann border
//! ```
//!
//! which is minus the gradient of E(Z) = Σ ψ² + μ Σ g(‖∇Z‖) with ‖∇Z‖² of forward differences, exactly so on the
//! pixel grid. ψ = a/Z + b with a = s·T and b = It + q·ω of the region that owns the pixel.
//!
//! Every pixel steps by its own curvature (a diagonal preconditioner): where T is large a common step small enough to
//! be stable would leave the rest standing. Each step is accepted only if the energy does not rise, and halved otherwise;
//! a pass stops after the given number of steps, or as soon as no step down to a 64th lowers the energy any further.
//! A step walks over the rows once: energy, gradient and curvature of where it ends are found together.

use std::mem::swap;

use super::rows::{least, most, sum};
use super::smoothness::Smoothness;
use crate::grid::Grid;

/// Depth is kept between these, in units in which a region's mean 1/Z is 1: beyond, a pixel moves less than a fiftieth or
/// more than fifty times as far as its region, which only noise claims.
pub const NEAREST_FARTHEST: [f32; 2] = [0.02, 50.0];
/// Greatest change of a pixel in one step, as a share of its depth: a/Z is far from its tangent beyond.
const LARGEST_CHANGE: f32 = 0.2;
/// Least share of a full step that is tried.
const LEAST_RATE: f32 = 1.0 / 64.0;
/// Keeps pixels that nothing tells of, where gradient and curvature are both 0, where they are.
const TINY: f32 = 1e-12;

/// The part of (7) that depends on Z, for given motions and labels, and room to work in.
pub struct DepthDescent {
    /// a = s·T at every pixel.
    pub slope: Grid<f32>,
    /// b = It + q·ω at every pixel.
    pub offset: Grid<f32>,
    step: Grid<f32>,
    trial: Grid<f32>,
    trial_step: Grid<f32>,
    rows: Rows,
}

impl DepthDescent {
    /// Room for a `width × height` frame; a and b are 0.
    pub fn new(width: usize, height: usize) -> Self {
        let plane = Grid::new(width, height, 0.0f32);
        Self {
            slope: plane.clone(),
            offset: plane.clone(),
            step: plane.clone(),
            trial: plane.clone(),
            trial_step: plane,
            rows: Rows::new(width),
        }
    }

    /// Lowers E(Z) by at most `steps` steps.
    pub fn run(&mut self, smoothness: &Smoothness, z: &mut Grid<f32>, steps: usize) {
        let Self {
            slope,
            offset,
            step,
            trial,
            trial_step,
            rows,
        } = self;
        let mut evaluate = |z: &Grid<f32>, step: &mut Grid<f32>| {
            rows.evaluate(smoothness, slope, offset, z, |y, gradient, curvature| {
                let out = step.row_mut(y).iter_mut();
                for ((s, &g), &c) in out.zip(gradient).zip(curvature) {
                    *s = g / (c + TINY);
                }
            })
        };
        let mut energy = evaluate(z, step);
        let mut rate = 1.0f32;
        for _ in 0..steps {
            loop {
                advance(z, step, rate, trial);
                let found = evaluate(trial, trial_step);
                if found <= energy {
                    swap(z, trial);
                    swap(step, trial_step);
                    energy = found;
                    rate = (2.0 * rate).min(1.0);
                    break;
                }
                rate *= 0.5;
                if rate < LEAST_RATE {
                    return;
                }
            }
        }
    }
}

/// `trial` = `z` less `rate` times `step`, within bounds.
fn advance(z: &Grid<f32>, step: &Grid<f32>, rate: f32, trial: &mut Grid<f32>) {
    let [nearest, farthest] = NEAREST_FARTHEST;
    let found = trial.data_mut().iter_mut().zip(z.data()).zip(step.data());
    for ((t, &z), &step) in found {
        let limit = LARGEST_CHANGE * z;
        let change = most(-limit, least(limit, rate * step));
        *t = most(nearest, least(farthest, z - change));
    }
}

/// Rows of numbers that one row of pixels hands to the next. Those that begin with `left_` start one place further
/// left than the frame, with a 0 for what lies beyond it.
struct Rows {
    /// Z, with the border repeated on the right.
    padded: Vec<f32>,
    /// Diffusivity times difference between a pixel and its right neighbour, and the diffusivity.
    left_flux: Vec<f32>,
    left_weight: Vec<f32>,
    /// The same between a pixel and its lower neighbour.
    below_flux: Vec<f32>,
    below_weight: Vec<f32>,
    /// The same between a pixel and its upper neighbour.
    above_flux: Vec<f32>,
    above_weight: Vec<f32>,
    energy: Vec<f32>,
    gradient: Vec<f32>,
    curvature: Vec<f32>,
}

impl Rows {
    fn new(width: usize) -> Self {
        let row = vec![0.0; width];
        let longer = vec![0.0; width + 1];
        Self {
            padded: longer.clone(),
            left_flux: longer.clone(),
            left_weight: longer,
            below_flux: row.clone(),
            below_weight: row.clone(),
            above_flux: row.clone(),
            above_weight: row.clone(),
            energy: row.clone(),
            gradient: row.clone(),
            curvature: row,
        }
    }

    /// E(Z); `visit` is given every row's number, its ∂E/∂Z, and the curvature bound of each of its pixels.
    fn evaluate(
        &mut self,
        smoothness: &Smoothness,
        slope: &Grid<f32>,
        offset: &Grid<f32>,
        z: &Grid<f32>,
        mut visit: impl FnMut(usize, &[f32], &[f32]),
    ) -> f64 {
        let mut energy = 0.0;
        self.above_flux.fill(0.0);
        self.above_weight.fill(0.0);
        for y in 0..z.height() {
            self.smooth(smoothness, z, y);
            self.fit(slope.row(y), offset.row(y), z.row(y));
            energy += sum(&self.energy);
            visit(y, &self.gradient, &self.curvature);
            swap(&mut self.above_flux, &mut self.below_flux);
            swap(&mut self.above_weight, &mut self.below_weight);
        }
        energy
    }

    /// μ g along row `y`, and what flows between it, its right neighbours and the row below.
    fn smooth(&mut self, smoothness: &Smoothness, z: &Grid<f32>, y: usize) {
        let width = z.width();
        let last_row = y + 1 == z.height();
        let here = z.row(y);
        // The border is repeated outwards, so that differences across it are 0.
        let below = if last_row { here } else { z.row(y + 1) };
        self.padded[..width].copy_from_slice(here);
        self.padded[width] = here[width - 1];
        let right = &self.padded[1..=width];
        let right_flux = &mut self.left_flux[1..=width];
        let right_weight = &mut self.left_weight[1..=width];
        let below_flux = &mut self.below_flux[..width];
        let below_weight = &mut self.below_weight[..width];
        let energy = &mut self.energy[..width];
        for x in 0..width {
            let (dx, dy) = (right[x] - here[x], below[x] - here[x]);
            let (g, diffusivity) = smoothness.at(dx * dx + dy * dy);
            energy[x] = g;
            right_flux[x] = diffusivity * dx;
            right_weight[x] = diffusivity;
            below_flux[x] = diffusivity * dy;
            below_weight[x] = diffusivity;
        }
        right_weight[width - 1] = 0.0;
        if last_row {
            below_weight.fill(0.0);
        }
    }

    /// Adds ψ² along a row; gradient and curvature of the whole energy there.
    fn fit(&mut self, slope: &[f32], offset: &[f32], z: &[f32]) {
        let width = z.len();
        let (slope, offset) = (&slope[..width], &offset[..width]);
        let (flux_left, flux_right) = (&self.left_flux[..width], &self.left_flux[1..=width]);
        let (left, right) = (&self.left_weight[..width], &self.left_weight[1..=width]);
        let (flux_above, above) = (&self.above_flux[..width], &self.above_weight[..width]);
        let (flux_below, below) = (&self.below_flux[..width], &self.below_weight[..width]);
        let energy = &mut self.energy[..width];
        let gradient = &mut self.gradient[..width];
        let curvature = &mut self.curvature[..width];
        for x in 0..width {
            let rho = z[x].recip();
            let psi = slope[x] * rho + offset[x];
            // Minus ∂ψ/∂Z.
            let along = slope[x] * rho * rho;
            energy[x] += psi * psi;
            gradient[x] =
                flux_left[x] + flux_above[x] - flux_right[x] - flux_below[x] - 2.0 * along * psi;
            curvature[x] = 2.0 * (along * along + left[x] + right[x] + above[x] + below[x]);
        }
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::options::Diffusion;

    const MU: f64 = 3.0;
    const EPSILON: f64 = 0.05;

    /// E(Z) as printed.
    fn energy(diffusion: Diffusion, [a, b, z]: [&Grid<f64>; 3]) -> f64 {
        let mut sum = 0.0;
        for y in 0..z.height() {
            for x in 0..z.width() {
                let here = z[(x, y)];
                let dx = z[((x + 1).min(z.width() - 1), y)] - here;
                let dy = z[(x, (y + 1).min(z.height() - 1))] - here;
                let r2 = (dx * dx + dy * dy) / (EPSILON * EPSILON);
                let g = match diffusion {
                    Diffusion::Anisotropic => 2.0 * (1.0 + r2).sqrt() - 2.0,
                    Diffusion::Isotropic => r2,
                };
                sum += (a[(x, y)] / here + b[(x, y)]).powi(2) + MU * g;
            }
        }
        sum
    }

    #[test]
    fn energy_and_gradient_are_those_of_9() {
        let (width, height) = (11, 6);
        let noise = |salt: usize| {
            Grid::from_fn(width, height, |x, y| {
                let i = y * width + x;
                ((i * 7919 + salt * 104_729 + i * i * 31) % 201) as f64 - 100.0
            })
        };
        let a = noise(1).map(|n| 0.1 * n);
        let b = noise(2).map(|n| 0.05 * n);
        for steepness in [1e-4, 1e-3, 4e-3] {
            let z = noise(3).map(|n| 1.5 + steepness * n);
            for diffusion in [Diffusion::Anisotropic, Diffusion::Isotropic] {
                let smoothness = Smoothness::new(diffusion, MU, EPSILON);
                let [sa, sb, sz] = [&a, &b, &z].map(|grid| grid.map(|v| v as f32));
                let mut gradient = Grid::new(width, height, 0.0f32);
                let found = Rows::new(width).evaluate(&smoothness, &sa, &sb, &sz, |y, g, _| {
                    gradient.row_mut(y).copy_from_slice(g);
                });
                let exact = energy(diffusion, [&a, &b, &z]);
                assert!((found / exact - 1.0).abs() < 1e-5, "{found}, {exact}");
                let largest = gradient.data().iter().fold(0.0f32, |m, g| m.max(g.abs()));
                for i in 0..z.len() {
                    let at = |h: f64| {
                        let mut moved = z.clone();
                        moved.data_mut()[i] += h;
                        energy(diffusion, [&a, &b, &moved])
                    };
                    let numeric = (at(1e-5) - at(-1e-5)) / 2e-5;
                    let found = f64::from(gradient.data()[i]);
                    // Relative to the gradient, not to one that happens to vanish at a pixel.
                    let scale = found.abs().max(0.01 * f64::from(largest));
                    assert!(
                        (found - numeric).abs() < 1e-3 * scale,
                        "{found} against {numeric} at {i}, {diffusion:?}"
                    );
                }
            }
        }
    }
}
