//! The three steps for one scale and one depth field that all regions share.
//!
//! `solver/` says when each step is due and when to stop. After each motion step mean 1/Z is 1 again in every region:
//! ψ holds T/Z only, so that (aT, aZ) is the same solution, and without a rule the smoothness term would shrink Z.

use std::rc::Rc;

use super::curves::{CurveEvolution, Residuals};
use super::depth::DepthDescent;
use super::energy::energy;
use super::motion::least_squares;
use super::psi::Psi;
use super::rows::{least, most, runs};
use super::weights::Noise;
use crate::camera::{Camera, RigidMotion};
use crate::confidence::confidence;
use crate::curves;
use crate::energy::Energy;
use crate::error::Error;
use crate::file::packed::{Packer, Unpacker};
use crate::frames::{Derivatives, FramePair, blur};
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation, NEAREST_FARTHEST};
use crate::motion_model::MotionModel;
use crate::options::Options;
use crate::smoothness::Smoothness;
use crate::solver::{Approach, Next, RegionReport, Stage, Weights};
use crate::spread::spread;

/// Curves, motions and depth, and what they are judged by.
pub(crate) struct Paper {
    camera: Camera,
    pair: Rc<FramePair>,
    smoothing: f64,
    derivatives: Derivatives,
    /// `None` before the first motion step.
    pub(super) noise: Option<Noise>,
    pub(super) weights: Weights,
    pub(super) phi: Vec<Grid<f32>>,
    pub(super) labels: Grid<u8>,
    pub(super) motions: Vec<RigidMotion>,
    pub(super) z: Grid<f32>,
    descent: DepthDescent,
    evolution: CurveEvolution,
}

impl Paper {
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
            noise: None,
            weights: Weights::default(),
            labels: curves::labels(&phi, width, height),
            motions: vec![RigidMotion::default(); phi.len() + 1],
            z: Grid::new(width, height, 1.0),
            descent: DepthDescent::new(width, height),
            evolution: CurveEvolution::new(width, height),
            phi,
        }
    }

    fn ensure_weights(&mut self, options: &Options) {
        if self.noise.is_none() {
            self.find_motions(options);
        }
    }

    fn smoothness(&self, options: &Options) -> Smoothness {
        Smoothness::new(options.diffusion, self.weights.mu, options.epsilon)
    }

    fn psi(&self) -> Psi<'_> {
        Psi::new(&self.camera, &self.derivatives, &self.motions)
    }

    /// σ of the residual as it is, grey levels.
    fn sigma(&self) -> f64 {
        let mut psi = Vec::with_capacity(self.z.len());
        self.psi()
            .rows(&self.labels, &self.z, |row| psi.extend(row));
        spread(&mut psi)
    }

    /// Mean 1/Z of each region back to 1, T with it, which leaves every ψ as it is.
    fn normalise(&mut self) {
        let mut sums = vec![(0.0f64, 0usize); self.motions.len()];
        for y in 0..self.z.height() {
            for (k, run) in runs(self.labels.row(y)) {
                let rho = self.z.row(y)[run.clone()].iter().map(|z| z.recip());
                sums[k].0 += f64::from(rho.sum::<f32>());
                sums[k].1 += run.len();
            }
        }
        let mean = |(sum, pixels)| if pixels > 0 { sum / pixels as f64 } else { 1.0 };
        let means: Vec<f64> = sums.into_iter().map(mean).collect();
        for (motion, mean) in self.motions.iter_mut().zip(&means) {
            motion.translation *= *mean;
        }
        let [nearest, farthest] = NEAREST_FARTHEST;
        for y in 0..self.z.height() {
            for (k, run) in runs(self.labels.row(y)) {
                let mean = means[k] as f32;
                for z in &mut self.z.row_mut(y)[run] {
                    *z = most(nearest, least(farthest, *z * mean));
                }
            }
        }
    }

    /// How far depth shows: not at all where a region's translation does not.
    fn confidence(&self) -> Grid<f32> {
        let (width, height) = (self.labels.width(), self.labels.height());
        let Some(noise) = self.noise else {
            return Grid::new(width, height, 0.0);
        };
        let seen = |motion| MotionModel::seen(&self.camera, motion).translates();
        let shows: Vec<bool> = self.motions.iter().map(seen).collect();
        let labels = self.labels.data();
        let hide = |grid: &mut Grid<f32>| {
            for (c, &k) in grid.data_mut().iter_mut().zip(labels) {
                *c *= f32::from(shows[usize::from(k)]);
            }
        };
        let mut slope = Grid::new(width, height, 0.0);
        let mut offset = slope.clone();
        self.psi()
            .along_depth(&self.labels, &mut slope, &mut offset);
        // What shows beside a region that does not move must not spread into it, nor the other way round.
        hide(&mut slope);
        let mut found = confidence(&slope.map(|a| a * a), noise.now);
        hide(&mut found);
        found
    }
}

/// ξ = ψ² of every region at every pixel.
struct Squared<'a> {
    psi: Psi<'a>,
    z: &'a Grid<f32>,
}

impl Residuals for Squared<'_> {
    fn write(&self, k: usize, y: usize, first: usize, xi: &mut [f32]) {
        let pixels = first..first + xi.len();
        self.psi.of_region(k, y, pixels, self.z.row(y), xi);
        xi.iter_mut().for_each(|psi| *psi *= *psi);
    }
}

impl Approach for Paper {
    /// Least squares, and the scale that it leaves open.
    fn find_motions(&mut self, options: &Options) {
        let found = least_squares(
            &self.camera,
            &self.derivatives,
            &self.z,
            &self.labels,
            self.motions.len(),
            options.rotation_ridge,
        );
        for (motion, found) in self.motions.iter_mut().zip(found) {
            *motion = found.unwrap_or(*motion);
        }
        self.normalise();
        if self.noise.is_none() {
            let noise = Noise::new(self.sigma());
            self.weights = noise.weights(options);
            self.noise = Some(noise);
        }
    }

    fn find_depth(&mut self, options: &Options) {
        self.ensure_weights(options);
        let smoothness = self.smoothness(options);
        let psi = Psi::new(&self.camera, &self.derivatives, &self.motions);
        let DepthDescent { slope, offset, .. } = &mut self.descent;
        psi.along_depth(&self.labels, slope, offset);
        self.descent
            .run(&smoothness, &mut self.z, options.depth_steps);
    }

    fn move_curves(&mut self, options: &Options) {
        self.ensure_weights(options);
        if self.phi.is_empty() {
            return;
        }
        let xi = Squared {
            psi: Psi::new(&self.camera, &self.derivatives, &self.motions),
            z: &self.z,
        };
        let (lambda, steps) = (self.weights.lambda as f32, options.curve_steps);
        self.evolution.run(&mut self.phi, &xi, lambda, steps);
        self.labels = curves::labels(&self.phi, self.labels.width(), self.labels.height());
    }

    /// Chooses μ again once all stands still: residuals are smaller by then, and so is what smoothness
    /// must outweigh.
    fn end_pass(&mut self, _changed: f64, still: bool, options: &Options) -> Next {
        if !still {
            return Next::Again;
        }
        let sigma = self.sigma();
        let Some(noise) = &mut self.noise else {
            return Next::Done;
        };
        let tighter = noise.tighten(sigma);
        self.weights = noise.weights(options);
        if tighter { Next::Another } else { Next::Done }
    }

    /// What was chosen from the data stays as it is, so that energies remain comparable.
    fn reconsider(&mut self, options: &Options) {
        if options.smoothing != self.smoothing {
            self.smoothing = options.smoothing;
            self.derivatives = differentiate(&self.pair, options.smoothing);
        }
        if let Some(noise) = &self.noise {
            self.weights = noise.weights(options);
        }
    }

    fn replace_curves(&mut self, level_sets: Vec<Grid<f32>>, _: &Options) {
        self.labels = curves::labels(&level_sets, self.labels.width(), self.labels.height());
        self.motions
            .resize(level_sets.len() + 1, RigidMotion::default());
        self.phi = level_sets;
    }

    /// Curves and depth stay where they are.
    fn advance(&mut self, pair: Rc<FramePair>, options: &Options) {
        self.derivatives = differentiate(&pair, options.smoothing);
        self.pair = pair;
    }

    fn energy(&self, options: &Options) -> Energy {
        energy(
            &self.psi(),
            &self.labels,
            &self.z,
            &self.smoothness(options),
            &self.phi,
            self.weights.lambda,
        )
    }

    fn labels(&self) -> &Grid<u8> {
        &self.labels
    }

    fn level_sets(&self) -> Vec<Grid<f32>> {
        self.phi.clone()
    }

    fn regions(&self) -> Vec<RegionReport> {
        let report =
            |(k, motion)| RegionReport::new(k, motion, MotionModel::seen(&self.camera, motion));
        self.motions.iter().enumerate().map(report).collect()
    }

    fn weights(&self) -> Weights {
        self.weights
    }

    fn stage(&self) -> Stage {
        Stage::Descent
    }

    fn pack(&self, to: &mut Packer) {
        self.write(to);
    }

    fn unpack(&mut self, from: &mut Unpacker) -> Result<(), Error> {
        self.read(from)
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
                let rho = f64::from(self.z[at]).recip();
                let (u, v) = self.camera.image_motion(motion, x as f64, y as f64, rho);
                flow.u[at] = u as f32;
                flow.v[at] = v as f32;
            }
        }
        Interpretation {
            camera: self.camera,
            labels: self.labels.clone(),
            depth: self.z.clone(),
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
