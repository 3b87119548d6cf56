//! What a pass changes: curves, motions and depth; and the three steps applied to it.
//!
//! Depth is held as ρ = 1/Z, which stays finite where Z does not; the steps that speak of Z convert.

use crate::camera::{Camera, RigidMotion};
use crate::constraint;
use crate::curves;
use crate::depth::{self, DepthDescent, NEAREST_FARTHEST, Smoothness};
use crate::energy::Energy;
use crate::frames::Derivatives;
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};
use crate::motion;
use crate::options::Options;

use super::weights::Weights;

/// Curves, motions and depth.
pub(super) struct State {
    pub phi: Vec<Grid<f32>>,
    pub labels: Grid<u8>,
    pub motions: Vec<RigidMotion>,
    pub rho: Grid<f32>,
}

impl State {
    pub fn new(width: usize, height: usize, phi: Vec<Grid<f32>>) -> Self {
        Self {
            labels: curves::labels(&phi, width, height),
            motions: vec![RigidMotion::default(); phi.len() + 1],
            rho: Grid::new(width, height, 1.0),
            phi,
        }
    }

    pub fn replace_curves(&mut self, phi: Vec<Grid<f32>>) {
        self.labels = curves::labels(&phi, self.labels.width(), self.labels.height());
        self.motions.resize(phi.len() + 1, RigidMotion::default());
        self.phi = phi;
    }

    pub fn pixels(&self) -> Vec<usize> {
        let mut count = vec![0; self.motions.len()];
        for &k in self.labels.data() {
            count[usize::from(k)] += 1;
        }
        count
    }

    /// Step 1, and the scale that it leaves open: mean 1/Z = 1 in each region.
    pub fn find_motions(&mut self, camera: &Camera, derivatives: &Derivatives, options: &Options) {
        for k in 0..self.motions.len() {
            let found = motion::least_squares(
                camera,
                derivatives,
                &self.rho,
                &self.labels,
                k as u8,
                options.rotation_ridge,
            );
            if let Some(motion) = found {
                self.motions[k] = motion;
            }
        }
        self.normalise();
    }

    /// Step 2.
    pub fn find_depth(
        &mut self,
        camera: &Camera,
        derivatives: &Derivatives,
        options: &Options,
        weights: &Weights,
    ) {
        let (slope, offset) = self.along_depth(camera, derivatives);
        let descent = DepthDescent {
            slope: &slope,
            offset: &offset,
            smoothness: smoothness(options, weights),
        };
        let mut z = self.rho.map(f32::recip);
        descent.run(&mut z, options.depth_steps);
        self.rho = z.map(f32::recip);
    }

    /// Step 3.
    pub fn move_curves(
        &mut self,
        camera: &Camera,
        derivatives: &Derivatives,
        options: &Options,
        weights: &Weights,
    ) {
        if self.phi.is_empty() {
            return;
        }
        let xi: Vec<Grid<f32>> = self
            .motions
            .iter()
            .map(|motion| {
                constraint::residual(camera, derivatives, motion, &self.rho).map(|psi| psi * psi)
            })
            .collect();
        curves::evolve(&mut self.phi, &xi, weights.lambda, options.curve_steps);
        self.labels = curves::labels(&self.phi, self.labels.width(), self.labels.height());
    }

    pub fn energy(
        &self,
        camera: &Camera,
        derivatives: &Derivatives,
        options: &Options,
        weights: &Weights,
    ) -> Energy {
        let (slope, offset) = self.along_depth(camera, derivatives);
        let mut smooth = smoothness(options, weights);
        let z = self.rho.map(f32::recip);
        let both = |smoothness| {
            DepthDescent {
                slope: &slope,
                offset: &offset,
                smoothness,
            }
            .energy(&z)
        };
        let total = both(smooth);
        smooth.mu = 0.0;
        let data = both(smooth);
        let length: f64 = self.phi.iter().map(curves::length).sum();
        Energy {
            data,
            smoothness: total - data,
            length: weights.lambda * length,
        }
    }

    /// ψ at every pixel, of the region that owns it.
    pub fn residual(&self, camera: &Camera, derivatives: &Derivatives) -> Grid<f32> {
        let (mut psi, offset) = self.along_depth(camera, derivatives);
        for ((p, &o), &r) in psi
            .data_mut()
            .iter_mut()
            .zip(offset.data())
            .zip(self.rho.data())
        {
            *p = *p * r + o;
        }
        psi
    }

    pub fn interpretation(
        &self,
        camera: &Camera,
        derivatives: &Derivatives,
        sigma: f64,
    ) -> Interpretation {
        let (width, height) = (self.labels.width(), self.labels.height());
        let mut flow = Flow {
            u: Grid::new(width, height, 0.0),
            v: Grid::new(width, height, 0.0),
        };
        for y in 0..height {
            for x in 0..width {
                let motion = &self.motions[usize::from(self.labels[(x, y)])];
                let rho = f64::from(self.rho[(x, y)]);
                let (u, v) = camera.image_motion(motion, x as f64, y as f64, rho);
                flow.u[(x, y)] = u as f32;
                flow.v[(x, y)] = v as f32;
            }
        }
        Interpretation {
            camera: *camera,
            labels: self.labels.clone(),
            depth: self.rho.map(f32::recip),
            flow,
            confidence: self.confidence(camera, derivatives, sigma),
            occluded: Grid::new(width, height, 0),
            motions: self.motions.clone(),
        }
    }

    /// How far depth shows: not at all where a region's translation does not.
    fn confidence(&self, camera: &Camera, derivatives: &Derivatives, sigma: f64) -> Grid<f32> {
        if sigma <= 0.0 {
            return Grid::new(self.labels.width(), self.labels.height(), 0.0);
        }
        let shows: Vec<bool> = self
            .motions
            .iter()
            .map(|motion| motion::Kind::seen(camera, motion).translates())
            .collect();
        let (mut slope, _) = self.along_depth(camera, derivatives);
        let labels = self.labels.data();
        for (a, &k) in slope.data_mut().iter_mut().zip(labels) {
            if !shows[usize::from(k)] {
                *a = 0.0;
            }
        }
        let mut confidence = depth::confidence(&slope, sigma);
        for (c, &k) in confidence.data_mut().iter_mut().zip(labels) {
            if !shows[usize::from(k)] {
                *c = 0.0;
            }
        }
        confidence
    }

    /// ψ = slope · ρ + offset of the region that owns each pixel.
    fn along_depth(&self, camera: &Camera, derivatives: &Derivatives) -> (Grid<f32>, Grid<f32>) {
        let (width, height) = (self.labels.width(), self.labels.height());
        let mut slope = Grid::new(width, height, 0.0f32);
        let mut offset = Grid::new(width, height, 0.0f32);
        let labels = self.labels.data();
        for (k, motion) in self.motions.iter().enumerate() {
            let (a, b) = (slope.data_mut(), offset.data_mut());
            constraint::along_depth(camera, derivatives, motion, |i, s, o| {
                if usize::from(labels[i]) == k {
                    a[i] = s;
                    b[i] = o;
                }
            });
        }
        (slope, offset)
    }

    /// Mean ρ of each region back to 1, T with it, which leaves every ψ as it is. Without this the
    /// smoothness term would shrink Z.
    fn normalise(&mut self) {
        let mut sum = vec![0.0f64; self.motions.len()];
        for (&k, &rho) in self.labels.data().iter().zip(self.rho.data()) {
            sum[usize::from(k)] += f64::from(rho);
        }
        let means: Vec<f64> = sum
            .iter()
            .zip(self.pixels())
            .map(|(s, n)| if n > 0 { s / n as f64 } else { 1.0 })
            .collect();
        for (motion, mean) in self.motions.iter_mut().zip(&means) {
            motion.translation *= *mean;
        }
        let [nearest, farthest] = NEAREST_FARTHEST;
        for (&k, rho) in self.labels.data().iter().zip(self.rho.data_mut()) {
            *rho = (*rho / means[usize::from(k)] as f32).clamp(farthest.recip(), nearest.recip());
        }
    }
}

pub(super) fn smoothness(options: &Options, weights: &Weights) -> Smoothness {
    Smoothness {
        diffusion: options.diffusion,
        mu: weights.mu,
        epsilon: options.epsilon,
    }
}
