//! Coarse to fine: every region a layer with its own motion and its own depth over the whole frame.
//!
//! The two frames are halved again and again. Small patches, matched from the coarsest scale on, propose
//! the motions to start from. Motion is searched for with depth eliminated and refined together with depth;
//! curves move by threshold dynamics, and at last on the finest scale by (17); `schedule.rs` says when.
//! Each hypothesis is judged by its own depth, so that the present owner of a pixel is not favoured. A
//! region is computed in a window around it, beyond which its depth goes on as a plane.
//!
//! Here are the layers and what they are computed from; `start.rs` says where they begin, `steps.rs` improves them,
//! `growth.rs` tries them with more, `balance.rs` weighs them.

mod balance;
mod growth;
mod start;
mod steps;

use std::rc::Rc;

use super::approach::pixels;
use super::evidence::{Evidence, Role};
use super::noise::{Noise, change_of_light};
use super::region::{Region, certainty};
use super::rim::rim;
use super::schedule::Schedule;
use super::weights::Weights;
use crate::camera::Camera;
use crate::curves;
use crate::depth::{self, FieldPrior, Polynomials};
use crate::frames::{FramePair, Lighting, doubled, halved};
use crate::grid::Grid;
use crate::occlusion::Cover;
use crate::options::Options;
use crate::warp::{Scale, pyramid};
use crate::window::Window;
use start::Destination;

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
    destination: Destination,
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
            destination: Destination::Unknown,
            weights: Weights::of_layers(noise.sigma, false, options),
            noise,
            scales,
        };
        layers.place_curves(level_sets);
        layers.propose_motions(0);
        layers
    }

    fn relabel(&mut self) {
        self.labels = curves::labels(&self.phi, self.labels.width(), self.labels.height());
    }

    fn place_curves(&mut self, level_sets: Vec<Grid<f32>>) {
        let each = level_sets.into_iter();
        self.phi = each.map(|phi| self.at_this_scale(phi)).collect();
        self.relabel();
    }

    /// A level set of the frame's size at the scale at work.
    fn at_this_scale(&self, phi: Grid<f32>) -> Grid<f32> {
        (0..self.schedule.level).fold(phi, |phi, _| halved(&phi).map(|p| 0.5 * p))
    }

    fn here(&self) -> &Scale {
        &self.scales[self.schedule.level]
    }

    fn prior(&self, k: usize, evidence: &Evidence, options: &Options) -> FieldPrior {
        let stiffness = match options.mu {
            Some(_) => 1.0,
            None => self.regions[k].stiffness,
        };
        FieldPrior {
            diffusion: options.diffusion,
            strength: self.weights.mu * stiffness,
            epsilon: options.epsilon * f64::from(1u32 << self.schedule.level),
            creases: self.creases(k, evidence, options),
            within: evidence.uncharged().map(|_| evidence.owned.clone()),
            relief: evidence.relief_prior(),
        }
    }

    /// Where the depth of region k may step: a background is many things, each of which may stand before
    /// another, and most of a body's edges are painted on it. Offered pixels must follow, or they would be
    /// explained by a depth of their own.
    fn creases(&self, k: usize, evidence: &Evidence, options: &Options) -> Option<[Grid<f32>; 2]> {
        let applies = options.edges && k == 0 && self.schedule.settled();
        applies.then(|| {
            let first = evidence.window.crop(&self.here().first);
            depth::creases(&first, self.weights.sigma, &evidence.owned)
        })
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
        self.evidence_of(k, window, owned, options)
    }

    /// The same as if region k owned the pixels `owned` of its window.
    fn evidence_of(
        &self,
        k: usize,
        window: Window,
        owned: Grid<f32>,
        options: &Options,
    ) -> Evidence<'_> {
        let withheld = if self.schedule.spares_rims() {
            rim(&owned)
        } else {
            None
        };
        // Not where the rim is fitted: nothing would keep a surface from bending after it.
        let departing = withheld.is_some();
        Evidence {
            scale: self.here(),
            window,
            surface: Polynomials::over(&owned, if departing { 3 } else { 2 }),
            departing,
            // Not before: how much shows is kept to first order, and steps are long until then.
            leaps: k == 0 && self.schedule.settled(),
            role: match k {
                0 if self.regions.len() == 1 => Role::Whole,
                0 => Role::Background,
                _ => Role::Body,
            },
            withheld,
            owned,
            sigma: self.weights.sigma,
            spread: self.noise.regions[k].max(self.weights.sigma),
            robust: options.robust,
            shadowed: k == 0 && self.regions.len() > 1 && self.schedule.level == 0,
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

    /// Full μ for every region again.
    fn forget_stiffness(&mut self) {
        for region in &mut self.regions {
            region.stiffness = 1.0;
        }
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
