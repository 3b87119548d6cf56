//! The one loop: for each scale estimate, label, refine.
//!
//! ```text
//! first scale   planar rounds   fit a plane to each region, label           until labels stand still, 6 at most
//!               search          candidate motions, models, surfaces, label  once
//! every scale   rigid passes    estimate T, ω, ρ; ρ alone; label            until labels stand still, 2 at most; 1 when a film goes on
//! second scale  select          models once more, in the second pass
//! finest scale  refine          depth pixel by pixel where it has steps     once
//! ```
//!
//! σ is measured at the start of a scale and held, so that energies compare within it. A pass that raises the energy is
//! taken back and ends the scale. Energies do not compare between scales, and before and after σ is measured.

use std::rc::Rc;

use super::estimate::{PlanarFlow, Prior, State, Surface};
use super::label::Memory;
use super::region::Region;
use super::scale::{Scale, pyramid};
use crate::camera::Camera;
use crate::curves;
use crate::energy::Energy;
use crate::frames::FramePair;
use crate::grid::Grid;
use crate::init::Small;
use crate::options::Options;
use crate::solver::{Approach, Next, Weights};
use crate::window::Window;

/// Planar rounds at most.
pub(super) const PLANAR_ROUNDS: usize = 6;
/// Rigid passes of a scale at most.
pub(super) const PASSES: usize = 2;
/// The first scale is the finest whose shorter side has no more pixels than this.
const FIRST_SIDE: usize = 150;
/// Pixels between control points on the scale after the first.
const SPACING: usize = 8;

/// Where a solve stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// So many rounds have been made.
    Planar(usize),
    /// Candidate motions are due.
    Search,
    /// So many passes have been made at this scale.
    Rigid(usize),
    /// Depth discontinuities are due.
    Refine,
    Done,
}

/// What a pass that raises the energy is taken back to.
pub(super) struct Before {
    energy: Energy,
    labels: Grid<u8>,
    states: Vec<(State, PlanarFlow)>,
}

/// Labels, motions and surfaces, and the scale at which they stand.
pub(crate) struct Layered {
    pub(super) pair: Rc<FramePair>,
    /// The finest first.
    pub(super) scales: Vec<Scale>,
    pub(super) smoothing: f64,
    pub(super) level: usize,
    /// The number of the first scale.
    pub(super) first: usize,
    pub(super) phase: Phase,
    /// Whether a film goes on: motions are known, and one pass a scale will do.
    pub(super) warm: bool,
    pub(super) labels: Grid<u8>,
    /// Pixels that their owner does not explain, and to which other region they are offered; 255 elsewhere.
    pub(super) offered: Grid<u8>,
    pub(super) regions: Vec<Region>,
    /// σ of the residuals at this scale, grey levels.
    pub(super) sigma: f32,
    /// The same of the unsmoothed frames, by which labels are judged.
    pub(super) label_sigma: f32,
    pub(super) memory: Memory,
    pub(super) energy: Energy,
    pub(super) weights: Weights,
    pub(super) before: Option<Before>,
    /// Whether the last pass was taken back.
    pub(super) rejected: bool,
    /// Matches between the frames, once somebody has asked for them.
    pub(super) small: Option<Rc<Small>>,
    /// Mean distance of flow from matches, pixels, where that is more than one; 0 until the end.
    pub(super) far: f64,
    /// Of how many regions the last search for depth pixel by pixel took what it found.
    pub(super) adopted: usize,
    /// Regions that want depth pixel by pixel, when that is due.
    pub(super) unexplained: Vec<usize>,
}

impl Layered {
    /// The start: curves as given, nothing moving.
    pub fn new(
        pair: Rc<FramePair>,
        camera: Camera,
        level_sets: Vec<Grid<f32>>,
        options: &Options,
    ) -> Self {
        let scales = pyramid(&pair, camera, options);
        let small = |s: &Scale| s.width.min(s.height) <= FIRST_SIDE;
        let first = scales.iter().position(small).unwrap_or(scales.len() - 1);
        let mut layered = Self {
            pair,
            smoothing: options.smoothing,
            level: first,
            first,
            phase: Phase::Planar(0),
            warm: false,
            labels: Grid::new(1, 1, 0),
            offered: Grid::new(1, 1, super::label::NOBODY),
            regions: Vec::new(),
            sigma: 1.0,
            label_sigma: 1.0,
            memory: Memory::default(),
            energy: Energy::default(),
            weights: Weights::default(),
            before: None,
            rejected: false,
            small: None,
            far: 0.0,
            adopted: 0,
            unexplained: Vec::new(),
            scales,
        };
        layered.place(&level_sets);
        layered
    }

    /// Level sets after the first scale's search, begun from others, merged where one motion explains as well.
    pub fn first_scale(
        pair: Rc<FramePair>,
        camera: Camera,
        level_sets: Vec<Grid<f32>>,
        options: &Options,
    ) -> Vec<Grid<f32>> {
        let mut layered = Self::new(pair, camera, level_sets, options);
        loop {
            let before = layered.labels.clone();
            layered.find_motions(options);
            layered.find_depth(options);
            layered.move_curves(options);
            let pairs = before.data().iter().zip(layered.labels.data());
            let changed = pairs.filter(|(a, b)| a != b).count() as f64 / before.len() as f64;
            if layered.phase == Phase::Search {
                layered.merge_regions(options);
                break;
            }
            layered.end_pass(changed, false, options);
        }
        layered.level_sets()
    }

    /// Begins at the first scale with these curves.
    pub(super) fn place(&mut self, level_sets: &[Grid<f32>]) {
        self.level = self.first;
        self.phase = Phase::Planar(0);
        self.warm = false;
        self.far = 0.0;
        let (width, height) = (self.pair.width(), self.pair.height());
        let frame = curves::labels(level_sets, width, height);
        self.put_labels(&frame);
        let flat = Surface::flat(self.spacing(), &Window::whole(width, height));
        self.regions = (0..=level_sets.len())
            .map(|_| Region::new(flat.clone()))
            .collect();
        self.fit_memory();
    }

    /// Takes the labels of the scale at work from labels of the frame's size.
    pub(super) fn put_labels(&mut self, frame: &Grid<u8>) {
        let (level, half) = (self.level, (1 << self.level) / 2);
        let here = self.here();
        self.labels = Grid::from_fn(here.width, here.height, |x, y| {
            frame[((x << level) + half, (y << level) + half)]
        });
    }

    /// Memory for the scale at work.
    pub(super) fn fit_memory(&mut self) {
        let (width, height) = (self.here().width, self.here().height);
        self.memory.fit(width, height, self.regions.len());
        self.offered = Grid::new(width, height, super::label::NOBODY);
        self.find_windows();
    }

    pub(super) fn here(&self) -> &Scale {
        &self.scales[self.level]
    }

    /// Pixels of the finest scale between control points.
    pub(super) fn spacing(&self) -> usize {
        SPACING << self.first.saturating_sub(1)
    }

    /// What curvature is charged, `stiffness` in variances of the residual on a frame of 320×240: in a larger frame the
    /// same surface bends less from pixel to pixel.
    pub(super) fn prior(&self, stiffness: f64, sigma: f32, options: &Options) -> Prior {
        let size = (self.pair.width() * self.pair.height()) as f64 / (320.0 * 240.0);
        let variance = f64::from(sigma * sigma);
        Prior {
            mu: options.mu.unwrap_or(stiffness * size * variance),
            diffusion: options.diffusion,
            epsilon: options.epsilon,
            sigma,
        }
    }

    /// Goes to the next finer scale.
    fn refine_scale(&mut self) {
        self.level -= 1;
        let here = self.here();
        let old = &self.labels;
        let nearest = |at: usize, count: usize| (at / 2).min(count - 1);
        self.labels = Grid::from_fn(here.width, here.height, |x, y| {
            old[(nearest(x, old.width()), nearest(y, old.height()))]
        });
        self.fit_memory();
        self.fit_surfaces();
    }

    /// Takes the pass back if it has raised the energy.
    pub(super) fn accept_or_reject(&mut self) {
        let energy = self.energy.total();
        self.rejected = self
            .before
            .as_ref()
            .is_some_and(|b| energy > b.energy.total());
        if self.rejected
            && let Some(before) = self.before.take()
        {
            self.labels = before.labels;
            for (region, (state, flow)) in self.regions.iter_mut().zip(before.states) {
                region.state = state;
                region.flow = flow;
            }
            self.energy = before.energy;
            self.find_windows();
        } else {
            self.before = Some(self.now());
        }
    }

    /// What is to be gone back to when the next pass is worse.
    pub(super) fn now(&self) -> Before {
        let known = self.regions.iter().map(|r| (r.state.clone(), r.flow));
        Before {
            energy: self.energy,
            labels: self.labels.clone(),
            states: known.collect(),
        }
    }

    fn finished(&mut self, options: &Options) -> (Phase, Next) {
        self.note_parts(options);
        self.judge_rigidity();
        self.far = self.distance_from_matches();
        (Phase::Done, Next::Done)
    }

    /// What comes after a pass of the present phase in which so many pixels changed region.
    pub(super) fn after(&mut self, changed: f64, options: &Options) -> (Phase, Next) {
        let still = changed <= options.tolerance;
        let alone = self.regions.len() == 1;
        match self.phase {
            Phase::Planar(done)
                if done + 1 < PLANAR_ROUNDS && !alone && !self.rejected && (done < 2 || !still) =>
            {
                // σ is measured in the first two rounds, and held from then on.
                let next = if done < 2 { Next::Another } else { Next::Again };
                (Phase::Planar(done + 1), next)
            }
            Phase::Planar(_) => (Phase::Search, Next::Another),
            Phase::Search => (Phase::Rigid(0), Next::Another),
            // Models are compared when the scale has a picture, and by another energy.
            Phase::Rigid(0) if self.selects_in(1) => (Phase::Rigid(1), Next::Another),
            Phase::Rigid(done) => {
                let most = if self.warm { 1 } else { PASSES };
                if !self.rejected && !still && !alone && done + 1 < most {
                    (Phase::Rigid(done + 1), Next::Again)
                } else if self.level > 0 {
                    self.refine_scale();
                    (Phase::Rigid(0), Next::Another)
                } else if options.discontinuities && self.find_unexplained() {
                    (Phase::Refine, Next::Another)
                } else {
                    self.finished(options)
                }
            }
            Phase::Refine | Phase::Done => self.finished(options),
        }
    }
}
