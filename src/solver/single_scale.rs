//! The paper's approach: one scale, one depth field that all regions share.
//!
//! Depth is held as ρ = 1/Z, which stays finite where Z does not; the steps that speak of Z convert.

use std::rc::Rc;

use super::approach::{Approach, pixels};
use super::weights::{Weights, spread};
use crate::camera::{Camera, RigidMotion};
use crate::constraint;
use crate::curves;
use crate::depth::{self, DepthDescent, NEAREST_FARTHEST, Smoothness};
use crate::energy::Energy;
use crate::frames::{Derivatives, FramePair, blur};
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};
use crate::motion::{self, Kind};
use crate::options::Options;

/// σ must fall at least to this share before μ is chosen again.
const TIGHTER: f64 = 0.8;

/// Curves, motions and depth, and what they are judged by.
pub(super) struct SingleScale {
    camera: Camera,
    pair: Rc<FramePair>,
    smoothing: f64,
    derivatives: Derivatives,
    weights: Weights,
    phi: Vec<Grid<f32>>,
    labels: Grid<u8>,
    motions: Vec<RigidMotion>,
    rho: Grid<f32>,
}

impl SingleScale {
    /// The start: curves as given, the same depth everywhere, nothing moving.
    pub fn new(
        pair: Rc<FramePair>,
        camera: Camera,
        phi: Vec<Grid<f32>>,
        options: &Options,
    ) -> Self {
        let (width, height) = (pair.width(), pair.height());
        Self {
            camera,
            smoothing: options.smoothing,
            derivatives: differentiate(&pair, options.smoothing),
            pair,
            weights: Weights::default(),
            labels: curves::labels(&phi, width, height),
            motions: vec![RigidMotion::default(); phi.len() + 1],
            rho: Grid::new(width, height, 1.0),
            phi,
        }
    }

    fn ensure_weights(&mut self, options: &Options) {
        if !self.weights.chosen() {
            self.find_motions(options);
        }
    }

    /// σ of the residual as it is, grey levels.
    fn sigma(&self) -> f64 {
        let (slope, offset) = self.along_depth();
        let residual = slope.data().iter().zip(offset.data()).zip(self.rho.data());
        spread(residual.map(|((a, b), rho)| a * rho + b).collect())
    }

    fn descent<'a>(
        &self,
        (slope, offset): (&'a Grid<f32>, &'a Grid<f32>),
        options: &Options,
    ) -> DepthDescent<'a> {
        DepthDescent {
            slope,
            offset,
            smoothness: Smoothness {
                diffusion: options.diffusion,
                mu: self.weights.mu,
                epsilon: options.epsilon,
            },
        }
    }

    /// How far depth shows: not at all where a region's translation does not.
    fn confidence(&self) -> Grid<f32> {
        if !self.weights.chosen() {
            return Grid::new(self.labels.width(), self.labels.height(), 0.0);
        }
        let motions = self.motions();
        let shows = |k: u8| motions[usize::from(k)].1.translates();
        let (mut slope, _) = self.along_depth();
        let labels = self.labels.data();
        for (a, &k) in slope.data_mut().iter_mut().zip(labels) {
            *a *= f32::from(shows(k));
        }
        let mut confidence = depth::confidence(&slope, self.weights.sigma);
        for (c, &k) in confidence.data_mut().iter_mut().zip(labels) {
            *c *= f32::from(shows(k));
        }
        confidence
    }

    /// ψ = slope · ρ + offset of the region that owns each pixel.
    fn along_depth(&self) -> (Grid<f32>, Grid<f32>) {
        let (width, height) = (self.labels.width(), self.labels.height());
        let mut slope = Grid::new(width, height, 0.0f32);
        let mut offset = Grid::new(width, height, 0.0f32);
        let labels = self.labels.data();
        for (k, motion) in self.motions.iter().enumerate() {
            let (a, b) = (slope.data_mut(), offset.data_mut());
            constraint::along_depth(&self.camera, &self.derivatives, motion, |i, s, o| {
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
            .zip(pixels(&self.labels, self.motions.len()))
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

impl Approach for SingleScale {
    /// Least squares, and the scale that it leaves open: mean 1/Z = 1 in each region.
    fn find_motions(&mut self, options: &Options) {
        for k in 0..self.motions.len() {
            let found = motion::least_squares(
                &self.camera,
                &self.derivatives,
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
        if !self.weights.chosen() {
            self.weights = Weights::choose(self.sigma(), options);
        }
    }

    fn find_depth(&mut self, options: &Options) {
        self.ensure_weights(options);
        let (slope, offset) = self.along_depth();
        let mut z = self.rho.map(f32::recip);
        self.descent((&slope, &offset), options)
            .run(&mut z, options.depth_steps);
        self.rho = z.map(f32::recip);
    }

    fn move_curves(&mut self, options: &Options) {
        self.ensure_weights(options);
        if self.phi.is_empty() {
            return;
        }
        let squared = |motion| {
            constraint::residual(&self.camera, &self.derivatives, motion, &self.rho)
                .map(|psi| psi * psi)
        };
        let xi: Vec<Grid<f32>> = self.motions.iter().map(squared).collect();
        let lambda = self.weights.lambda as f32;
        let lambda = Grid::new(self.labels.width(), self.labels.height(), lambda);
        curves::evolve(&mut self.phi, &xi, &lambda, options.curve_steps);
        self.labels = curves::labels(&self.phi, self.labels.width(), self.labels.height());
    }

    /// Chooses μ again once all stands still: residuals are smaller by then, and so is what smoothness
    /// must outweigh.
    fn end_pass(&mut self, still: bool, options: &Options) -> bool {
        if !still {
            return false;
        }
        let tightened = self.weights.tightened(self.sigma(), options);
        let tighter = tightened.sigma < TIGHTER * self.weights.sigma;
        if tighter {
            self.weights = tightened;
        }
        tighter
    }

    /// What was chosen from the data stays as it is, so that energies remain comparable.
    fn reconsider(&mut self, options: &Options) {
        if options.smoothing != self.smoothing {
            self.smoothing = options.smoothing;
            self.derivatives = differentiate(&self.pair, options.smoothing);
        }
        if self.weights.chosen() {
            self.weights = self.weights.with(options);
        }
    }

    fn replace_curves(&mut self, level_sets: Vec<Grid<f32>>, _: &Options) {
        self.labels = curves::labels(&level_sets, self.labels.width(), self.labels.height());
        self.motions
            .resize(level_sets.len() + 1, RigidMotion::default());
        self.phi = level_sets;
    }

    fn energy(&self, options: &Options) -> Energy {
        let (slope, offset) = self.along_depth();
        let z = self.rho.map(f32::recip);
        let mut descent = self.descent((&slope, &offset), options);
        let both = descent.energy(&z);
        descent.smoothness.mu = 0.0;
        let data = descent.energy(&z);
        let length: f64 = self.phi.iter().map(curves::length).sum();
        Energy {
            data,
            smoothness: both - data,
            length: self.weights.lambda * length,
        }
    }

    fn labels(&self) -> &Grid<u8> {
        &self.labels
    }

    fn level_sets(&self) -> Vec<Grid<f32>> {
        self.phi.clone()
    }

    fn motions(&self) -> Vec<(RigidMotion, Kind)> {
        let seen = |&motion| (motion, Kind::seen(&self.camera, &motion));
        self.motions.iter().map(seen).collect()
    }

    fn behind(&self) -> Vec<Vec<usize>> {
        Vec::new()
    }

    fn weights(&self) -> Weights {
        self.weights
    }

    fn scale(&self) -> (usize, usize) {
        (0, 1)
    }

    fn flat(&self) -> bool {
        false
    }

    fn interpretation(&self, _options: &Options) -> Interpretation {
        let (width, height) = (self.labels.width(), self.labels.height());
        let mut flow = Flow {
            u: Grid::new(width, height, 0.0),
            v: Grid::new(width, height, 0.0),
        };
        for y in 0..height {
            for x in 0..width {
                let at = (x, y);
                let motion = &self.motions[usize::from(self.labels[at])];
                let rho = f64::from(self.rho[at]);
                let (u, v) = self.camera.image_motion(motion, x as f64, y as f64, rho);
                flow.u[at] = u as f32;
                flow.v[at] = v as f32;
            }
        }
        Interpretation {
            camera: self.camera,
            labels: self.labels.clone(),
            depth: self.rho.map(f32::recip),
            flow,
            confidence: self.confidence(),
            occluded: Grid::new(width, height, 0),
            motions: self.motions.clone(),
        }
    }
}

fn differentiate(pair: &FramePair, smoothing: f64) -> Derivatives {
    Derivatives::between(
        &blur(&pair.first().grey, smoothing),
        &blur(&pair.second().grey, smoothing),
    )
}
