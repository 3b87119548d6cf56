//! The state of a solve as bytes. Every pixel has a depth and a φ of each curve of its own, so these are rounded: ln Z to
//! [`DEPTH_STEPS`] and φ to [`LEVEL_STEPS`], near the curve; farther off its sign is kept. Labels are as they were.

use glam::DVec3;

use super::redistance::REACH;
use super::solver::Paper;
use super::weights::Noise;
use crate::camera::RigidMotion;
use crate::curves;
use crate::error::Error;
use crate::file::packed::{Packer, Unpacker};
use crate::grid::Grid;
use crate::interpretation::NEAREST_FARTHEST;
use crate::solver::Weights;

/// Steps of ln Z: Z to half a thousandth.
const DEPTH_STEPS: f32 = 1024.0;
/// Steps of φ in a pixel.
const LEVEL_STEPS: f32 = 64.0;

impl Paper {
    pub(super) fn write(&self, to: &mut Packer) {
        to.flag(self.noise.is_some());
        if let Some(noise) = &self.noise {
            to.floats([noise.first, noise.now]);
        }
        to.floats([self.weights.mu, self.weights.lambda, self.weights.sigma]);
        for motion in &self.motions {
            to.floats(motion.translation.to_array());
            to.floats(motion.rotation.to_array());
        }
        let steps = |z: &f32| (z.ln() * DEPTH_STEPS).round() as i32;
        to.alike(self.z.data().iter().map(steps));
        for phi in &self.phi {
            to.alike(phi.data().iter().map(|&phi| level(phi)));
        }
    }

    /// Takes a state over, of as many regions as there are. On an error all stays.
    pub(super) fn read(&mut self, from: &mut Unpacker) -> Result<(), Error> {
        let noise = if from.flag()? {
            let [first, now] = from.floats()?;
            if !(first > 0.0 && now > 0.0) {
                return Err(from.wrong("its σ is none"));
            }
            Some(Noise { first, now })
        } else {
            None
        };
        let [mu, lambda, sigma] = from.floats()?;
        let motions = from.times(self.motions.len(), |from| {
            Ok(RigidMotion {
                translation: DVec3::from_array(from.floats()?),
                rotation: DVec3::from_array(from.floats()?),
            })
        })?;
        let (width, height) = (self.z.width(), self.z.height());
        let mut grid = |value: &dyn Fn(i32) -> f32| {
            let steps = from.alike(width * height)?;
            Grid::from_vec(width, height, steps.into_iter().map(value).collect())
        };
        let [nearest, farthest] = NEAREST_FARTHEST;
        let z = grid(&|steps| (steps as f32 / DEPTH_STEPS).exp().clamp(nearest, farthest))?;
        let phi: Vec<Grid<f32>> = (0..self.phi.len())
            .map(|_| grid(&|steps| (steps as f32 + 0.5) / LEVEL_STEPS))
            .collect::<Result<_, _>>()?;
        from.end()?;

        (self.noise, self.weights) = (noise, Weights { mu, lambda, sigma });
        (self.motions, self.z) = (motions, z);
        self.labels = curves::labels(&phi, width, height);
        self.phi = phi;
        Ok(())
    }
}

/// φ in whole steps, rounded to the middle of one, so that it keeps its sign.
fn level(phi: f32) -> i32 {
    let far = REACH * LEVEL_STEPS;
    let steps = (phi * LEVEL_STEPS).clamp(-far - 1.0, far);
    if phi > 0.0 {
        steps as i32
    } else {
        steps.ceil() as i32 - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_keeps_its_sign_and_its_place() {
        for phi in [
            0.0, -0.0, 1e-6, -1e-6, 0.01, -0.01, 0.5, -0.5, 3.3, -3.3, 6.99, -6.99,
        ] {
            let back = (level(phi) as f32 + 0.5) / LEVEL_STEPS;
            assert_eq!(back > 0.0, phi > 0.0, "{phi}");
            assert!((back - phi).abs() <= 1.01 / LEVEL_STEPS, "{phi}");
        }
        for phi in [REACH, 40.0, 1e3, f32::INFINITY] {
            assert!((level(phi) as f32 + 0.5) / LEVEL_STEPS >= REACH);
            assert!((level(-phi) as f32 + 0.5) / LEVEL_STEPS <= -REACH);
        }
    }
}
