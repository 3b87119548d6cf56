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

use super::rows::{least, most};
use crate::grid::Grid;
use crate::interpretation::NEAREST_FARTHEST;
use crate::linalg::sum;
use crate::smoothness::Smoothness;

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

/// Rows of numbers, and what one row of pixels hands to the next.
struct Rows {
    /// Z with the border repeated on both sides.
    padded: Vec<f32>,
    /// Diffusivity of the row, one place further to the right, with a 0 for what lies beyond the frame.
    diffusivity: Vec<f32>,
    /// That of the row above, in the same places; 0 above the frame.
    above: Vec<f32>,
    energy: Vec<f32>,
    gradient: Vec<f32>,
    curvature: Vec<f32>,
}

impl Rows {
    fn new(width: usize) -> Self {
        Self {
            padded: vec![0.0; width + 2],
            diffusivity: vec![0.0; width + 1],
            above: vec![0.0; width + 1],
            energy: vec![0.0; width],
            gradient: vec![0.0; width],
            curvature: vec![0.0; width],
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
        let (width, last) = (z.width(), z.height() - 1);
        let mut energy = 0.0;
        self.above.fill(0.0);
        for y in 0..=last {
            self.padded[0] = z[(0, y)];
            self.padded[1..=width].copy_from_slice(z.row(y));
            self.padded[width + 1] = z[(width - 1, y)];
            // The border is repeated outwards, so that differences across it are 0.
            let (above, below) = (z.row(y.saturating_sub(1)), z.row((y + 1).min(last)));
            self.smooth(smoothness, below);
            self.fit(slope.row(y), offset.row(y), above, below);
            // No difference crosses the border, so that none bends there.
            self.curvature[width - 1] -= 2.0 * self.diffusivity[width];
            if y == last {
                let own = self.curvature.iter_mut().zip(&self.diffusivity[1..]);
                own.for_each(|(curvature, d)| *curvature -= 2.0 * d);
            }
            energy += sum(&self.energy);
            visit(y, &self.gradient, &self.curvature);
            swap(&mut self.above, &mut self.diffusivity);
        }
        energy
    }

    /// μ g along a row, and the diffusivity.
    fn smooth(&mut self, smoothness: &Smoothness, below: &[f32]) {
        let width = below.len();
        let (here, right) = (&self.padded[1..=width], &self.padded[2..width + 2]);
        let diffusivity = &mut self.diffusivity[1..=width];
        let energy = &mut self.energy[..width];
        for x in 0..width {
            let (dx, dy) = (right[x] - here[x], below[x] - here[x]);
            (energy[x], diffusivity[x]) = smoothness.at(dx * dx + dy * dy);
        }
    }

    /// Adds ψ² along a row; gradient and curvature of the whole energy there.
    fn fit(&mut self, slope: &[f32], offset: &[f32], above: &[f32], below: &[f32]) {
        let n = slope.len();
        let (offset, above, below) = (&offset[..n], &above[..n], &below[..n]);
        let (left, z, right) = (
            &self.padded[..n],
            &self.padded[1..=n],
            &self.padded[2..n + 2],
        );
        // A pixel's differences are those to its right and lower neighbours.
        let (of_left, own) = (&self.diffusivity[..n], &self.diffusivity[1..=n]);
        let of_above = &self.above[1..=n];
        let energy = &mut self.energy[..n];
        let gradient = &mut self.gradient[..n];
        let curvature = &mut self.curvature[..n];
        for x in 0..n {
            let rho = z[x].recip();
            let psi = slope[x] * rho + offset[x];
            // Minus ∂ψ/∂Z.
            let along = slope[x] * rho * rho;
            let flux = own[x] * (right[x] - z[x] + (below[x] - z[x]))
                - of_left[x] * (z[x] - left[x])
                - of_above[x] * (z[x] - above[x]);
            energy[x] += psi * psi;
            gradient[x] = -2.0 * along * psi - flux;
            curvature[x] = 2.0 * (along * along + of_left[x] + of_above[x] + 2.0 * own[x]);
        }
    }
}

#[cfg(test)]
mod tests;
