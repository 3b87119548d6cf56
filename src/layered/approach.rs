//! The layered solver as the interface drives it: which stage a step is, by the phase that the solve is in.

use std::rc::Rc;

use super::region::Region;
use super::scale::pyramid;
use super::solver::{Layered, PLANAR_ROUNDS, Phase};
use crate::energy::Energy;
use crate::error::Error;
use crate::file::packed::{Packer, Unpacker};
use crate::frames::FramePair;
use crate::grid::Grid;
use crate::interpretation::Interpretation;
use crate::options::Options;
use crate::solver::{Approach, Expected, Next, RegionReport, Stage, Weights};

impl Layered {
    /// Whether motion models are compared once more in the pass of this scale that follows so many: the second on the second
    /// scale. Without a curve the first, as there are no labels to find; and on the first scale when a film goes on.
    pub(super) fn selects_in(&self, done: usize) -> bool {
        let (scale, pass) = match (self.warm, self.regions.len()) {
            (true, _) => (self.first, 0),
            (false, 1) => (self.first.saturating_sub(1), 0),
            (false, _) => (self.first.saturating_sub(1), 1),
        };
        self.level == scale && done == pass
    }
}

impl Approach for Layered {
    fn find_motions(&mut self, options: &Options) {
        match self.phase {
            Phase::Planar(done) => self.fit_planes(done),
            Phase::Search => self.search_motions(options),
            Phase::Rigid(done) => {
                if done == 0 {
                    self.measure_sigma(options);
                }
                self.estimate(options);
                if self.selects_in(done) {
                    self.select_models(options);
                }
            }
            // Motion and depth pixel by pixel are found together.
            Phase::Refine => self.refine_discontinuities(options),
            Phase::Done => {}
        }
    }

    fn find_depth(&mut self, options: &Options) {
        match self.phase {
            Phase::Planar(_) | Phase::Refine => {}
            Phase::Search | Phase::Rigid(_) | Phase::Done => self.estimate_depth(options),
        }
    }

    fn check_depth(&self) -> Result<(), Error> {
        match self.phase {
            Phase::Planar(_) => Err(Error::Planes {
                most: PLANAR_ROUNDS,
            }),
            _ => Ok(()),
        }
    }

    fn move_curves(&mut self, options: &Options) {
        match self.phase {
            Phase::Planar(done) => self.label_planes(done, options),
            Phase::Search | Phase::Rigid(_) => self.label(options),
            Phase::Refine | Phase::Done => {
                self.rejected = false;
                return;
            }
        }
        self.accept_or_reject();
    }

    fn end_pass(&mut self, changed: f64, _still: bool, options: &Options) -> Next {
        let (phase, next) = self.after(changed, options);
        self.phase = phase;
        if next == Next::Another {
            self.before = None;
        }
        next
    }

    /// What was found stays; the scale at work is gone through once more.
    fn reconsider(&mut self, options: &Options) {
        if options.smoothing != self.smoothing {
            self.smoothing = options.smoothing;
            let camera = self.scales[0].camera;
            self.scales = pyramid(&self.pair, camera, options);
        }
        self.find_windows();
        self.before = None;
        if matches!(self.phase, Phase::Done | Phase::Refine | Phase::Rigid(_)) {
            self.phase = Phase::Rigid(0);
            self.regions.iter_mut().for_each(|r| r.dense = None);
        }
    }

    fn replace_curves(&mut self, level_sets: Vec<Grid<f32>>, _: &Options) {
        self.before = None;
        self.place(&level_sets);
    }

    fn advance(&mut self, pair: Rc<FramePair>, options: &Options) {
        self.before = None;
        self.follow(pair, options);
    }

    fn energy(&self, _: &Options) -> Energy {
        self.energy
    }

    fn labels(&self) -> &Grid<u8> {
        &self.labels
    }

    fn level_sets(&self) -> Vec<Grid<f32>> {
        self.smooth_level_sets()
    }

    fn regions(&self) -> Vec<RegionReport> {
        let report = |(k, region): (usize, &Region)| RegionReport {
            ambiguous: region.ambiguous,
            rigid: region.rigid,
            part_of: region.part_of,
            in_front_of: if region.hides { vec![0] } else { Vec::new() },
            ..RegionReport::new(k, &region.state.motion(), region.state.model)
        };
        self.regions.iter().enumerate().map(report).collect()
    }

    fn weights(&self) -> Weights {
        self.weights
    }

    fn scale(&self) -> (usize, usize) {
        (self.level, self.first + 1)
    }

    fn expected(&self) -> Option<Expected> {
        self.expected_now()
    }

    fn stage(&self) -> Stage {
        match self.phase {
            Phase::Planar(_) => Stage::Planes,
            Phase::Search => Stage::Search,
            Phase::Rigid(done) if self.selects_in(done) => Stage::Selection,
            Phase::Rigid(_) => Stage::Surfaces,
            Phase::Refine | Phase::Done => Stage::Steps,
        }
    }

    fn taken_back(&self) -> bool {
        self.rejected
    }

    fn adopted(&self) -> usize {
        if self.stage() == Stage::Steps {
            self.adopted
        } else {
            0
        }
    }

    fn pack(&self, to: &mut Packer) {
        self.write(to);
    }

    fn unpack(&mut self, from: &mut Unpacker) -> Result<(), Error> {
        self.read(from)
    }

    fn interpretation(&self, options: &Options) -> Interpretation {
        self.compose(options)
    }
}
