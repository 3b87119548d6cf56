//! Coarse to fine: every region a layer with its own motion and its own depth over the whole frame.
//!
//! The two frames are halved again and again. Small patches, matched from the coarsest scale on, propose
//! the motions to start from. On the first scale regions are flat (ρ = 1) at first, while threshold
//! dynamics finds roughly where they are; from then on motion is searched for with depth eliminated and
//! refined together with depth. Curves move by threshold dynamics, and at last on the finest scale by
//! (17). A scale is done after a set number of passes, the finest when all stands still. Each hypothesis
//! is judged by its own depth, so that the present owner of a pixel is not favoured.

use std::rc::Rc;

use super::approach::{Approach, pixels};
use super::choice;
use super::composition::{Layer, composed};
use super::evidence::Evidence;
use super::region::{Region, certainty};
use super::rivalry;
use super::weights::{Weights, spread};
use crate::camera::{Camera, RigidMotion};
use crate::curves::{self, Measure};
use crate::depth::FieldPrior;
use crate::energy::Energy;
use crate::frames::{FramePair, Lighting, blur, doubled, halved};
use crate::grid::Grid;
use crate::interpretation::Interpretation;
use crate::motion::{Kind, solve_positive};
use crate::occlusion::Cover;
use crate::options::{MotionMethod, Options};
use crate::start::{self, Patch};
use crate::warp::{Linearisation, RESIDUAL, Scale, pyramid};
use crate::window::Window;

/// Regions start on the coarsest scale whose shorter side is at least this: where several compete, and
/// where there is only one. At a coarse scale displacements are small, but so are the differences that tell
/// regions apart.
const STARTING: [usize; 2] = [100, 40];
/// Passes on the first scale, and how many of them regions are flat for.
const FIRST_PASSES: (usize, usize) = (10, 3);
/// Passes on each scale between the first and the finest.
const PASSES: usize = 6;
/// Passes of threshold dynamics on the finest scale before (17) takes over.
const THRESHOLD_PASSES: usize = 4;
/// The pass, counted from a scale's last of threshold dynamics, in which kinds of motion are chosen.
const CHOOSING: usize = 2;
/// The pass on the finest scale in which they are chosen again, depth being known in detail by then.
const CHOOSING_AGAIN: usize = THRESHOLD_PASSES + 3;
/// Depths of relief that a full motion is tried with.
const RELIEFS: [f64; 4] = [-1.0, 0.4, 2.5, -2.5];
/// Relief expected, as a share of a region's extent over the focal length, and what it counts, in variances.
const RELIEF: (f64, f64) = (1.5, 10.0);
/// The pass on the finest scale from which hidden pixels are excused: from the start regions would collapse.
const EXCUSING: usize = 2;
/// The pass of a scale after which the change of brightness is measured.
const RELIT: usize = 3;
/// Joint steps in a pass.
const JOINT_STEPS: usize = 2;
/// Pixels around a region in which its field is computed, and beyond which its curve does not leap.
const MARGIN: usize = 20;
/// Side of the blocks in which depth is eliminated, in pixels.
const BLOCK: usize = 8;
/// Pixels that their owner does not explain are offered to regions within this distance, in pixels, and
/// count this much there: a region grows over an edge of its surface only if its depth follows.
const OFFERED: (f32, f32) = (8.0, 0.5);
/// Mean ξ, in variances, from which a pixel is not explained, and the mean's standard deviation in pixels.
const UNEXPLAINED: (f32, f64) = (3.5, 1.5);
/// Least σ of the gradient's change: frames of 8 bits are not known better.
const LEAST_GRADIENT_SIGMA: f64 = 0.2;
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
    level: usize,
    start: usize,
    pass: usize,
    phi: Vec<Grid<f32>>,
    labels: Grid<u8>,
    /// Pixels that their owner does not explain.
    unclaimed: Grid<bool>,
    regions: Vec<Region>,
    weights: Weights,
    /// σ of each region's own residual, grey levels.
    spreads: Vec<f64>,
    /// σ of the gradient's change, grey levels per pixel.
    gradient_sigma: f64,
    /// The regions that each region hides part of; empty while that is not asked.
    behind: Vec<Vec<usize>>,
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
        scales.iter_mut().for_each(|scale| scale.relight(lighting));
        let start = scales
            .iter()
            .rposition(|s| {
                s.width().min(s.height()) >= STARTING[usize::from(level_sets.is_empty())]
            })
            .unwrap_or(0);
        let (width, height) = (scales[start].width(), scales[start].height());
        let regions = level_sets.len() + 1;
        let mut layers = Self {
            pair,
            smoothing: options.smoothing,
            lighting,
            level: start,
            start,
            pass: 0,
            phi: Vec::new(),
            labels: Grid::new(width, height, 0),
            unclaimed: Grid::new(width, height, false),
            regions: vec![Region::new(width, height); regions],
            spreads: vec![0.0; regions],
            gradient_sigma: LEAST_GRADIENT_SIGMA,
            behind: Vec::new(),
            weights: Weights::of_layers(f64::INFINITY, false, options),
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
        let patches = start::patches(&self.scales, self.level);
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
        for _ in 0..self.level {
            for phi in &mut level_sets {
                *phi = halved(phi).map(|p| 0.5 * p);
            }
        }
        self.labels = curves::labels(&level_sets, self.labels.width(), self.labels.height());
        self.phi = level_sets;
    }

    fn here(&self) -> &Scale {
        &self.scales[self.level]
    }

    /// Passes of this scale in which regions have depth.
    fn deep_passes(&self) -> Option<usize> {
        let flat = if self.level == self.start && self.level > 0 {
            FIRST_PASSES.1
        } else {
            0
        };
        self.pass.checked_sub(flat)
    }

    /// Whether regions are where they should be, to the pixel, and kinds of motion are chosen.
    fn settled(&self) -> bool {
        self.level == 0 && self.pass >= THRESHOLD_PASSES
    }

    fn prior(&self, options: &Options) -> FieldPrior {
        FieldPrior {
            diffusion: options.diffusion,
            strength: self.weights.mu,
            epsilon: options.epsilon * f64::from(1u32 << self.level),
            relief: 0.0,
        }
    }

    /// Where region k is computed: everywhere while curves may still leap anywhere.
    fn window(&self, k: usize) -> Window {
        let whole = self.here().whole();
        if self.level == self.start || k == 0 {
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
            spread: self.spreads[k].max(self.weights.sigma),
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
            let mut prior = self.prior(options);
            prior.relief = self.relief(&evidence);
            improve(&mut part, &evidence, &prior);
            let line = evidence.linearise(&part);
            let certain = certainty(&line, &evidence.weights(&line));
            self.regions[k].take(&part, &window, &certain);
        }
    }

    fn relief(&self, evidence: &Evidence) -> f64 {
        let (mut n, mut sum, mut square) = (0.0f64, [0.0f64; 2], 0.0f64);
        for (i, &w) in evidence.owned.data().iter().enumerate() {
            if w > 0.0 {
                let (x, y) = evidence.window.place(i);
                let (x, y) = (x as f64, y as f64);
                n += 1.0;
                sum = [sum[0] + x, sum[1] + y];
                square += x * x + y * y;
            }
        }
        let extent2 = square / n - (sum[0] / n).powi(2) - (sum[1] / n).powi(2);
        let f = self.here().camera.focal;
        let spread2 = RELIEF.0 * RELIEF.0 * extent2 / (f * f);
        RELIEF.1 * self.weights.sigma * self.weights.sigma / (n * spread2.max(1e-6))
    }

    fn linearisations(&self) -> Vec<Linearisation> {
        let each = self.regions.iter().enumerate();
        each.map(|(k, region)| {
            let window = self.window(k);
            region.cropped(&window).linearise(self.here(), window)
        })
        .collect()
    }

    /// σ as the owners see it; while curves mean little, as the best of all regions does.
    fn measure_noise(&mut self, lines: &[Linearisation], options: &Options) {
        let flat = self.deep_passes().is_none();
        let mut changes = Vec::new();
        let mut least = Grid::new(self.labels.width(), self.labels.height(), f32::INFINITY);
        for (k, line) in lines.iter().enumerate() {
            let mut own = Vec::new();
            for i in 0..line.rows.len() {
                let at = line.window.place(i);
                let owns = usize::from(self.labels[at]) == k;
                if line.inside.data()[i] {
                    let r = line.rows.data()[i][RESIDUAL].abs();
                    if owns {
                        own.push(r);
                        changes.extend(line.gradient_change(self.here(), i));
                    }
                    if flat || owns {
                        least[at] = least[at].min(r);
                    }
                }
            }
            self.spreads[k] = spread(own);
        }
        let seen = least.data().iter().filter(|r| r.is_finite());
        let sigma = spread(seen.copied().collect());
        self.gradient_sigma = spread(changes).max(LEAST_GRADIENT_SIGMA);
        self.weights = Weights::of_layers(sigma, self.settled(), options);
    }

    fn measure(&self, options: &Options) -> Measure {
        Measure {
            sigma: self.weights.sigma,
            gradient_sigma: options.gradients.then_some(self.gradient_sigma),
            normalised: options.normalised,
        }
    }

    /// ξ of every region.
    fn competition(
        &self,
        lines: &[Linearisation],
        options: &Options,
    ) -> (Vec<Grid<f32>>, Option<Cover>) {
        let measure = self.measure(options);
        let mut xi = rivalry::residuals(lines, self.here(), &measure);
        let late = self.level == 0 && self.pass >= EXCUSING;
        let cover =
            (options.occlusion && late).then(|| rivalry::cover(lines, &xi, &self.labels, &measure));
        if let Some(cover) = &cover {
            rivalry::excuse_hidden(&mut xi, lines, cover, &measure);
        }
        rivalry::charge_distance(&mut xi, &self.phi, &measure);
        (xi, cover)
    }

    /// Gain and offset anew, from where the first frame's pixels are found in the second: least squares
    /// of the residual on brightness, over what fits.
    fn measure_lighting(&mut self, options: &Options) {
        let mut normal = [[0.0f64; 2]; 2];
        let mut right = [0.0f64; 2];
        for (k, line) in self.linearisations().iter().enumerate() {
            let weight = self.evidence(k, line.window, options).weights(line);
            let shade = line.window.crop(&self.regions[k].shade);
            for (i, &w) in weight.data().iter().enumerate() {
                let w = f64::from(w);
                let basis = [f64::from(self.here().first[line.window.place(i)]), 1.0];
                let change = f64::from(line.rows.data()[i][RESIDUAL] + shade.data()[i]);
                for a in 0..2 {
                    right[a] += w * basis[a] * change;
                    for b in 0..2 {
                        normal[a][b] += w * basis[a] * basis[b];
                    }
                }
            }
        }
        if let Some([gain, offset]) = solve_positive(&normal, &right) {
            let change = Lighting {
                gain: 1.0 + gain,
                offset,
            };
            self.lighting = self.lighting.then(change);
            self.scales
                .iter_mut()
                .for_each(|scale| scale.relight(change));
        }
    }

    fn next_scale(&mut self) {
        self.level -= 1;
        self.pass = 0;
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
        for finer in (0..self.level).rev() {
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
        let Some(pass) = self.deep_passes() else {
            if self.pass > 0 {
                self.each_region(options, |region, evidence, _| {
                    for _ in 0..JOINT_STEPS {
                        region.fit_flat(evidence);
                    }
                });
            }
            return;
        };
        let last = if self.level == 0 {
            THRESHOLD_PASSES
        } else {
            PASSES
        };
        let choose = options.choose_kind
            && (self.level < self.start || self.level == 0)
            && (pass + CHOOSING == last || self.level == 0 && pass == CHOOSING_AGAIN);
        let searching = options.search && self.level == self.start;
        let reliefs: &[f64] = if self.level > 0 {
            &RELIEFS
        } else {
            &RELIEFS[..1]
        };
        self.each_region(options, |region, evidence, prior| {
            if options.motion == MotionMethod::LeastSquares {
                region.fit_flat(evidence);
                region.normalise(&evidence.owned);
                return;
            }
            if pass <= 1 && searching {
                region.search(evidence, prior, BLOCK);
            }
            for _ in 0..JOINT_STEPS {
                region.fit_jointly(evidence, prior);
                region.normalise(&evidence.owned);
            }
            if choose {
                *region = choice::chosen(region, evidence, prior, BLOCK, reliefs);
            }
        });
    }

    fn find_depth(&mut self, options: &Options) {
        if self.deep_passes().is_some() {
            self.each_region(options, |region, evidence, prior| {
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
        let (xi, cover) = self.competition(&lines, options);
        self.behind = cover.map_or_else(Vec::new, |cover| cover.behind());
        if self.settled() {
            curves::evolve(&mut self.phi, &xi, self.weights.lambda, options.curve_steps);
        } else {
            let sigma = match self.deep_passes() {
                None => (2.5 - 0.25 * self.pass as f64).max(1.2),
                Some(_) => 1.2,
            };
            self.phi = curves::threshold(&xi, sigma);
        }
        if options.islands && self.deep_passes().is_some() {
            curves::without_islands(&mut self.phi);
        }
        self.labels = curves::labels(&self.phi, self.labels.width(), self.labels.height());
        let mut own = xi[0].clone();
        for (i, o) in own.data_mut().iter_mut().enumerate() {
            *o = xi[usize::from(self.labels.data()[i])].data()[i];
        }
        let most = UNEXPLAINED.0 * (self.weights.sigma * self.weights.sigma) as f32;
        self.unclaimed = blur(&own, UNEXPLAINED.1).map(|o| o > most);
    }

    fn end_pass(&mut self, _still: bool, options: &Options) -> bool {
        self.pass += 1;
        if options.lighting && self.pass == RELIT {
            self.measure_lighting(options);
        }
        if self.level == 0 {
            return self.pass <= CHOOSING_AGAIN;
        }
        let most = if self.level == self.start {
            FIRST_PASSES.0
        } else {
            PASSES
        };
        if self.pass >= most {
            self.next_scale();
        }
        true
    }

    fn reconsider(&mut self, options: &Options) {
        if options.smoothing != self.smoothing {
            self.smoothing = options.smoothing;
            self.scales = pyramid(&self.pair, self.scales[0].camera, options.smoothing);
            let lighting = self.lighting;
            self.scales
                .iter_mut()
                .for_each(|scale| scale.relight(lighting));
        }
        self.weights = Weights::of_layers(self.weights.sigma, self.settled(), options);
    }

    fn replace_curves(&mut self, level_sets: Vec<Grid<f32>>) {
        let (width, height) = (self.labels.width(), self.labels.height());
        let known = self.regions.len();
        // The search for motions and threshold dynamics, which end with a scale's first passes, are
        // needed again.
        self.pass = 0;
        self.regions
            .resize(level_sets.len() + 1, Region::new(width, height));
        self.spreads.resize(level_sets.len() + 1, 0.0);
        self.behind.clear();
        self.unclaimed.data_mut().fill(false);
        self.place_curves(level_sets);
        self.propose_motions(known);
    }

    fn energy(&self, options: &Options) -> Energy {
        if self.weights.sigma.is_infinite() {
            return Energy::default();
        }
        let lines = self.linearisations();
        let (xi, _) = self.competition(&lines, options);
        let owners = self.labels.data().iter().enumerate();
        let data = owners
            .map(|(i, &k)| f64::from(xi[usize::from(k)].data()[i]))
            .sum::<f64>();
        let prior = self.prior(options);
        let deep = self.deep_passes().is_some();
        // Of what departs from the region's plane: that is what is smoothed.
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
            let bends = region.cropped(&window).bends(&lines[k], &evidence, &weight);
            prior.edges(&bends).energy(&bends)
        };
        let length: f64 = self.phi.iter().map(curves::length).sum();
        // In pixels of the frame: areas grow fourfold from scale to scale, lengths twofold.
        let side = f64::from(1u32 << self.level);
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
        let side = (1u32 << self.level) as f32;
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
        self.behind.clone()
    }

    fn weights(&self) -> Weights {
        self.weights
    }

    fn scale(&self) -> (usize, usize) {
        (self.level, self.start + 1)
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
                gradient_sigma: Some(self.gradient_sigma),
                normalised: true,
            },
        )
    }
}
