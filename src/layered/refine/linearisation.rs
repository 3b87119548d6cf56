//! What a pixel's brightness says about its depth and the motion.
//!
//! ```text
//! e = I2(π(q)) − I1,   q = R ray + ρ T,     ∂e/∂ρ = g·T,   ∂e/∂T = ρ g,   ∂e/∂ω = (R ray) × g
//! g = (f/q_z) (I_x, I_y, −(I_x q_x + I_y q_y)/q_z)
//! ```
//!
//! I_x, I_y are the means of both frames' derivatives.

use crate::grid::Grid;
use crate::layered::scale::Scale;
use crate::layered::view::View;
use crate::spread::{LEAST_SIGMA, spread};

/// What each pixel says at the present depth and motion; 0 weight where it says nothing.
pub struct Linearisation {
    /// e in grey levels.
    pub residual: Vec<f32>,
    /// g, grey levels a unit of q.
    pub gradient: Vec<[f32; 3]>,
    /// Whether the pixel is compared at all.
    pub compared: Vec<bool>,
}

impl Linearisation {
    /// Room for `count` pixels.
    pub fn new(count: usize) -> Self {
        Self {
            residual: vec![0.0; count],
            gradient: vec![[0.0; 3]; count],
            compared: vec![false; count],
        }
    }

    /// Robust standard deviation of e over what is compared.
    pub fn spread(&self) -> f32 {
        let compared = self.residual.iter().zip(&self.compared).filter(|p| *p.1);
        let mut residuals: Vec<f32> = compared.map(|(e, _)| *e).collect();
        spread(&mut residuals).max(LEAST_SIGMA) as f32
    }

    /// Compares the frames at depth `rho` for the pixels that are in `support` and not `hidden`.
    pub fn compare(
        &mut self,
        scale: &Scale,
        view: &View,
        rho: &Grid<f32>,
        support: &Grid<bool>,
        hidden: &Grid<bool>,
    ) {
        let t = view.translation;
        for y in 0..scale.height {
            for x in 0..scale.width {
                let i = y * scale.width + x;
                self.compared[i] = false;
                self.residual[i] = 0.0;
                self.gradient[i] = [0.0; 3];
                if hidden.data()[i] || !support.data()[i] {
                    continue;
                }
                let (p, r) = (view.turned(x, y), rho.data()[i]);
                let q = [p[0] + r * t[0], p[1] + r * t[1], p[2] + r * t[2]];
                let [tx, ty] = view.pixel(q);
                if !scale.contains(tx, ty) {
                    continue;
                }
                let [grey, gx, gy] = scale.second.with_gradient(tx, ty);
                let near = view.focal / q[2];
                let gx = 0.5 * (gx + scale.gradient[0].data()[i]) * near;
                let gy = 0.5 * (gy + scale.gradient[1].data()[i]) * near;
                self.compared[i] = true;
                self.residual[i] = grey - scale.first.data()[i];
                self.gradient[i] = [gx, gy, -(gx * q[0] + gy * q[1]) / q[2]];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, turn};
    use crate::layered::estimate::{State, Surface};
    use crate::motion_model::MotionModel;
    use glam::DVec3;

    fn wave(x: usize, y: usize) -> f32 {
        let (x, y) = (x as f32, y as f32);
        100.0 + 30.0 * (0.35 * x + 0.2 * y).sin() + 20.0 * (0.15 * x - 0.3 * y).cos()
    }

    #[test]
    fn derivatives_are_those_of_the_residual() {
        let camera = Camera::centred(60.0, 40, 30).unwrap();
        let state = State {
            model: MotionModel::Full,
            translation: DVec3::new(0.02, -0.01, 0.03),
            rotation: turn(DVec3::new(0.004, -0.006, 0.01)),
            surface: Surface::default(),
        };
        // A flat first frame has no derivative, so that the mean of both is half of the second's.
        let frames = [Grid::new(40, 30, 0.0), Grid::from_fn(40, 30, wave)];
        let scale = Scale::new(frames.clone(), frames, camera);
        let (support, hidden) = (Grid::new(40, 30, true), Grid::new(40, 30, false));
        let residual = |state: &State, rho: f32| {
            let mut out = Linearisation::new(1200);
            let rho = Grid::new(40, 30, rho);
            out.compare(&scale, &state.view(&camera), &rho, &support, &hidden);
            out
        };
        let (i, rho) = (14 * 40 + 19, 1.3);
        let here = residual(&state, rho);
        let g = DVec3::from_array(here.gradient[i].map(|g| 2.0 * f64::from(g)));
        let p = DVec3::from_array(state.view(&camera).turned(19, 14).map(f64::from));
        let check = |changed: Linearisation, by: f64, expected: f64| {
            let slope = f64::from(changed.residual[i] - here.residual[i]) / by;
            assert!(
                (slope - expected).abs() < 0.03 * expected.abs() + 0.5,
                "{slope} {expected}"
            );
        };
        let d = 1e-3;
        check(residual(&state, rho + 0.01), 0.01, g.dot(state.translation));
        let mut moved = state.clone();
        moved.translation.x += d;
        check(residual(&moved, rho), d, f64::from(rho) * g.x);
        let mut turned = state.clone();
        turned.rotation = turn(d * DVec3::Z) * state.rotation;
        check(residual(&turned, rho), d, p.cross(g).z);
    }
}
