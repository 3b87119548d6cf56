//! Coarse to fine: every region a layer with its own motion and its own depth over the whole frame.
//!
//! The two frames are halved again and again. Small patches, matched from the coarsest scale on, propose
//! the motions to start from. Motion is searched for with depth eliminated and refined together with depth;
//! curves move by threshold dynamics, and at last on the finest scale by (17); `schedule.rs` says when.
//! Each hypothesis is judged by its own depth, so that the present owner of a pixel is not favoured. A
//! region is computed in a window around it, beyond which its depth goes on as a plane.

use std::rc::Rc;

use super::approach::{Approach, pixels};
use super::choice;
use super::composition::{Layer, composed};
use super::evidence::Evidence;
use super::noise::{Noise, change_of_light};
use super::region::{Region, certainty};
use super::rivalry;
use super::schedule::Schedule;
use super::stiffness;
use super::weights::Weights;
use crate::camera::{Camera, RigidMotion};
use crate::curves::{self, Measure};
use crate::depth::FieldPrior;
use crate::energy::Energy;
use crate::frames::{FramePair, Lighting, doubled, halved};
use crate::grid::Grid;
use crate::interpretation::Interpretation;
use crate::motion::Kind;
use crate::occlusion::Cover;
use crate::options::{MotionMethod, Options};
use crate::start::{self, Patch};
use crate::warp::{Linearisation, Scale, pyramid};
use crate::window::Window;

/// Joint steps in a pass.
const JOINT_STEPS: usize = 2;
/// Pixels around a region in which its field is computed, and beyond which its curve does not leap.
const MARGIN: usize = 20;
/// Pixels that their owner does not explain are offered to regions within this distance, in pixels, and
/// count this much there: a region grows over an edge of its surface only if its depth follows.
const OFFERED: (f32, f32) = (8.0, 0.5);
/// A region of fewer pixels than this keeps the motion that it has.
const FEWEST: usize = 8;

/// The layers, and the scale at which they stand.
pub(super) struct Layers {
    pair: Rc<FramePair>,
    /// The finest first.
    scales: Vec<Scale>,
    smoothing: f64,
    /// What the first frame's brightness has been changed by in all scales.
    lighting: Lighting,
    schedule: Schedule,
    phi: Vec<Grid<f32>>,
    labels: Grid<u8>,
    /// Pixels that their owner does not explain.
    unclaimed: Grid<bool>,
    regions: Vec<Region>,
    noise: Noise,
    weights: Weights,
    /// What the regions cover in the second frame, once hidden pixels are excused.
    cover: Option<Cover>,
}

impl Layers {
    /// The start: curves as given, motions as patches propose, every region flat.
    pub fn new(
        pair: Rc<FramePair>,
        camera: Camera,
        level_sets: Vec<Grid<f32>>,
        options: &Options,
    ) -> Self {
        let mut scales = pyramid(&pair, camera, options.smoothing);
        let lighting = if options.lighting {
            Lighting::between(&pair.first().grey, &pair.second().grey)
        } else {
            Lighting::default()
        };
        for scale in &mut scales {
            scale.relight(lighting);
        }
        let sides = scales.iter().map(|s| s.width().min(s.height()));
        let schedule = Schedule::new(sides, level_sets.len());
        let first = &scales[schedule.level];
        let (width, height) = (first.width(), first.height());
        let regions = level_sets.len() + 1;
        let noise = Noise::unknown(regions);
        let mut layers = Self {
            pair,
            smoothing: options.smoothing,
            lighting,
            schedule,
            phi: Vec::new(),
            labels: Grid::new(width, height, 0),
            unclaimed: Grid::new(width, height, false),
            regions: vec![Region::new(width, height); regions],
            cover: None,
            weights: Weights::of_layers(noise.sigma, false, options),
            noise,
            scales,
        };
        layers.place_curves(level_sets);
        layers.propose_motions(0);
        layers
    }

    /// Motions for the regions from label `first` on: what most patches agree on, and inside each curve
    /// what that leaves over.
    fn propose_motions(&mut self, first: usize) {
        if first >= self.regions.len() {
            return;
        }
        let patches = start::patches(&self.scales, self.schedule.level);
        if patches.is_empty() {
            return;
        }
        let camera = self.here().camera;
        let within = |k: usize| -> Vec<f64> {
            let inside = |p: &Patch| self.labels[(p.x as usize, p.y as usize)] == k as u8;
            patches.iter().map(|p| f64::from(inside(p))).collect()
        };
        // Curves are drawn where a person saw something else move.
        let outside: Vec<f64> = within(0).iter().map(|w| 0.3 + 0.7 * w).collect();
        let background = start::dominant(&camera, &patches, &outside);
        let motions: Vec<_> = (first..self.regions.len())
            .map(|k| match k {
                0 => background,
                _ => start::inside(&camera, &patches, &within(k), &background),
            })
            .collect();
        for (region, motion) in self.regions[first..].iter_mut().zip(motions) {
            region.motion = motion;
        }
    }

    /// Level sets of the frame's size brought to the scale at work.
    fn place_curves(&mut self, mut level_sets: Vec<Grid<f32>>) {
        for _ in 0..self.schedule.level {
            for phi in &mut level_sets {
                *phi = halved(phi).map(|p| 0.5 * p);
            }
        }
        self.labels = curves::labels(&level_sets, self.labels.width(), self.labels.height());
        self.phi = level_sets;
    }

    fn here(&self) -> &Scale {
        &self.scales[self.schedule.level]
    }

    fn prior(&self, k: usize, evidence: &Evidence, options: &Options) -> FieldPrior {
        FieldPrior {
            diffusion: options.diffusion,
            strength: self.weights.mu * self.regions[k].stiffness,
            epsilon: options.epsilon * f64::from(1u32 << self.schedule.level),
            relief: evidence.relief_prior(),
        }
    }

    /// Where region k is computed: everywhere while curves may still leap anywhere.
    fn window(&self, k: usize) -> Window {
        let whole = self.here().whole();
        if self.schedule.roams() || k == 0 {
            return whole;
        }
        let owned = |i: usize| usize::from(self.labels.data()[i]) == k;
        Window::around(whole.width, whole.height, MARGIN, owned).unwrap_or(whole)
    }

    /// What region k is to be fitted to, in its window.
    fn evidence(&self, k: usize, window: Window, options: &Options) -> Evidence<'_> {
        let owned = Grid::from_fn(window.width, window.height, |x, y| {
            let at = (window.left + x, window.top + y);
            if usize::from(self.labels[at]) == k {
                1.0
            } else if self.unclaimed[at] && self.distance(k, at) < OFFERED.0 {
                OFFERED.1
            } else {
                0.0
            }
        });
        Evidence {
            scale: self.here(),
            window,
            owned,
            sigma: self.weights.sigma,
            spread: self.noise.regions[k].max(self.weights.sigma),
            robust: options.robust,
        }
    }

    /// Pixels from `at` to region k.
    fn distance(&self, k: usize, at: (usize, usize)) -> f32 {
        match k {
            0 => self
                .phi
                .iter()
                .fold(f32::NEG_INFINITY, |d, phi| d.max(phi[at])),
            _ => -self.phi[k - 1][at],
        }
    }

    /// Calls `improve` with every region that still owns pixels, and what it is to be fitted to.
    fn each_region(
        &mut self,
        options: &Options,
        improve: impl Fn(&mut Region, &Evidence, &FieldPrior),
    ) {
        let pixels = pixels(&self.labels, self.regions.len());
        for k in 0..self.regions.len() {
            if pixels[k] < FEWEST {
                continue;
            }
            let window = self.window(k);
            let evidence = self.evidence(k, window, options);
            let mut part = self.regions[k].cropped(&window);
            let prior = self.prior(k, &evidence, options);
            improve(&mut part, &evidence, &prior);
            let line = evidence.linearise(&part);
            let certain = certainty(&line, &evidence.weights(&line));
            self.regions[k].take(&part, &window, &certain);
        }
    }

    fn linearisations(&self) -> Vec<Linearisation> {
        let each = self.regions.iter().enumerate();
        each.map(|(k, region)| {
            let window = self.window(k);
            region.cropped(&window).linearise(self.here(), window)
        })
        .collect()
    }

    fn measure_noise(&mut self, lines: &[Linearisation], options: &Options) {
        let flat = self.schedule.deep().is_none();
        self.noise = Noise::measure(lines, &self.labels, self.here(), flat);
        self.weights = Weights::of_layers(self.noise.sigma, self.schedule.settled(), options);
    }

    fn measure(&self, options: &Options) -> Measure {
        Measure {
            sigma: self.weights.sigma,
            gradient_sigma: (options.gradients && !self.schedule.settled())
                .then_some(self.noise.gradient),
            normalised: options.normalised,
        }
    }

    /// ξ of every region, nobody being excused.
    fn residuals(&self, lines: &[Linearisation], options: &Options) -> Vec<Grid<f32>> {
        rivalry::residuals(lines, self.here(), &self.measure(options))
    }

    /// What regions compete with, from their ξ.
    fn competition(
        &self,
        mut xi: Vec<Grid<f32>>,
        lines: &[Linearisation],
        options: &Options,
    ) -> Vec<Grid<f32>> {
        let measure = self.measure(options);
        if let Some(cover) = &self.cover {
            rivalry::excuse_hidden(&mut xi, lines, cover, &measure);
        }
        rivalry::charge_distance(&mut xi, &self.phi, &measure);
        xi
    }

    fn measure_lighting(&mut self, options: &Options) {
        let windows = (0..self.regions.len()).map(|k| (k, self.window(k)));
        let change = change_of_light(windows.map(|(k, window)| {
            let region = self.regions[k].cropped(&window);
            (region, self.evidence(k, window, options))
        }));
        if let Some(change) = change {
            self.lighting = self.lighting.then(change);
            for scale in &mut self.scales {
                scale.relight(change);
            }
        }
    }

    /// Brings everything to the scale that has been reached.
    fn refine(&mut self) {
        let (width, height) = (self.here().width(), self.here().height());
        for phi in &mut self.phi {
            *phi = doubled(phi, width, height).map(|p| 2.0 * p);
        }
        for region in &mut self.regions {
            region.rho = doubled(&region.rho, width, height);
            region.shade = doubled(&region.shade, width, height);
        }
        self.labels = curves::labels(&self.phi, width, height);
        self.unclaimed = Grid::new(width, height, false);
    }

    /// A field of the scale at work at the frame's size.
    fn at_full_size(&self, field: &Grid<f32>) -> Grid<f32> {
        let mut field = field.clone();
        for finer in (0..self.schedule.level).rev() {
            let scale = &self.scales[finer];
            field = doubled(&field, scale.width(), scale.height());
        }
        field
    }
}

impl Approach for Layers {
    fn find_motions(&mut self, options: &Options) {
        if self.weights.sigma.is_infinite() {
            let lines = self.linearisations();
            self.measure_noise(&lines, options);
        }
        let schedule = self.schedule;
        if schedule.deep().is_none() {
            if !schedule.begins() {
                self.each_region(options, |region, evidence, _| {
                    for _ in 0..JOINT_STEPS {
                        region.fit_flat(evidence);
                    }
                });
            }
            return;
        }
        self.each_region(options, |region, evidence, prior| {
            if options.motion == MotionMethod::LeastSquares {
                region.fit_flat(evidence);
                region.normalise(&evidence.owned);
                return;
            }
            if options.search && schedule.searches() {
                region.search(evidence, prior);
            }
            for _ in 0..JOINT_STEPS {
                region.fit_jointly(evidence, prior);
                region.normalise(&evidence.owned);
            }
            if options.choose_kind && schedule.chooses() {
                *region = choice::chosen(region, evidence, prior, schedule.reliefs());
            }
        });
    }

    fn find_depth(&mut self, options: &Options) {
        if self.schedule.deep().is_some() {
            let learns = options.mu.is_none() && self.schedule.learns();
            self.each_region(options, |region, evidence, prior| {
                if learns {
                    region.stiffness = stiffness::supported(region, evidence, prior);
                }
                region.fit_depth(evidence, prior);
                region.normalise(&evidence.owned);
                if options.lighting {
                    region.shade = evidence.shade(region);
                }
            });
        }
    }

    fn move_curves(&mut self, options: &Options) {
        let lines = self.linearisations();
        self.measure_noise(&lines, options);
        if self.phi.is_empty() {
            return;
        }
        let xi = self.residuals(&lines, options);
        if !(options.occlusion && self.schedule.excuses()) {
            self.cover = None;
        } else if self.cover.is_none() || !self.schedule.holds_cover() {
            let measure = self.measure(options);
            self.cover = Some(rivalry::cover(&lines, &xi, &self.labels, &measure));
        }
        let xi = self.competition(xi, &lines, options);
        if self.schedule.settled() {
            curves::evolve(&mut self.phi, &xi, self.weights.lambda, options.curve_steps);
        } else {
            self.phi = curves::threshold(&xi, self.schedule.window());
        }
        if options.islands && self.schedule.deep().is_some() {
            curves::without_islands(&mut self.phi);
        }
        self.labels = curves::labels(&self.phi, self.labels.width(), self.labels.height());
        self.unclaimed = rivalry::unexplained(&xi, &self.labels, self.weights.sigma);
    }

    fn end_pass(&mut self, _still: bool, options: &Options) -> bool {
        if options.lighting && self.schedule.relights() {
            self.measure_lighting(options);
        }
        if self.schedule.advance() {
            self.refine();
        }
        self.schedule.unfinished()
    }

    fn reconsider(&mut self, options: &Options) {
        if options.smoothing != self.smoothing {
            self.smoothing = options.smoothing;
            self.scales = pyramid(&self.pair, self.scales[0].camera, options.smoothing);
            for scale in &mut self.scales {
                scale.relight(self.lighting);
            }
        }
        self.weights = Weights::of_layers(self.noise.sigma, self.schedule.settled(), options);
    }

    fn replace_curves(&mut self, level_sets: Vec<Grid<f32>>) {
        let (width, height) = (self.labels.width(), self.labels.height());
        let known = self.regions.len();
        // The search for motions and threshold dynamics, which end with a scale's first passes, are
        // needed again.
        self.schedule.restart();
        self.regions
            .resize(level_sets.len() + 1, Region::new(width, height));
        self.noise.regions.resize(level_sets.len() + 1, 0.0);
        self.cover = None;
        self.unclaimed.data_mut().fill(false);
        self.place_curves(level_sets);
        self.propose_motions(known);
    }

    fn energy(&self, options: &Options) -> Energy {
        if self.weights.sigma.is_infinite() {
            return Energy::default();
        }
        let lines = self.linearisations();
        let xi = self.competition(self.residuals(&lines, options), &lines, options);
        let owners = self.labels.data().iter().enumerate();
        let data = owners
            .map(|(i, &k)| f64::from(xi[usize::from(k)].data()[i]))
            .sum::<f64>();
        let deep = self.schedule.deep().is_some();
        let smoothness = |(k, region): (usize, &Region)| {
            if !(deep && region.kind.translates()) {
                return 0.0;
            }
            let window = lines[k].window;
            let evidence = self.evidence(k, window, options);
            let weight = evidence.weights(&lines[k]);
            if weight.data().iter().all(|w| *w <= 0.0) {
                return 0.0;
            }
            let prior = self.prior(k, &evidence, options);
            let bends = region.cropped(&window).bends(&lines[k], &evidence, &weight);
            prior.edges(&bends).energy(&bends)
        };
        let length: f64 = self.phi.iter().map(curves::length).sum();
        // In pixels of the frame: areas grow fourfold from scale to scale, lengths twofold.
        let side = f64::from(1u32 << self.schedule.level);
        Energy {
            data: data * side * side,
            smoothness: self.regions.iter().enumerate().map(smoothness).sum::<f64>() * side * side,
            length: self.weights.lambda * length * side,
        }
    }

    fn labels(&self) -> &Grid<u8> {
        &self.labels
    }

    fn level_sets(&self) -> Vec<Grid<f32>> {
        let side = (1u32 << self.schedule.level) as f32;
        let each = self.phi.iter();
        each.map(|phi| self.at_full_size(phi).map(|p| side * p))
            .collect()
    }

    fn motions(&self) -> Vec<(RigidMotion, Kind)> {
        let camera = self.scales[0].camera;
        let each = self.regions.iter();
        each.map(|r| (r.motion, r.kind.min(Kind::seen(&camera, &r.motion))))
            .collect()
    }

    fn behind(&self) -> Vec<Vec<usize>> {
        self.cover.as_ref().map_or_else(Vec::new, Cover::behind)
    }

    fn weights(&self) -> Weights {
        self.weights
    }

    fn scale(&self) -> (usize, usize) {
        (self.schedule.level, self.schedule.start + 1)
    }

    fn flat(&self) -> bool {
        self.schedule.deep().is_none()
    }

    fn interpretation(&self) -> Interpretation {
        let read: Vec<Layer> = self
            .regions
            .iter()
            .zip(self.motions())
            .map(|(region, (motion, kind))| Layer {
                motion,
                kind,
                rho: self.at_full_size(&region.rho),
            })
            .collect();
        composed(
            &self.scales[0],
            &self.level_sets(),
            &read,
            &Measure {
                sigma: self.weights.sigma,
                gradient_sigma: Some(self.noise.gradient),
                normalised: true,
            },
        )
    }
}
