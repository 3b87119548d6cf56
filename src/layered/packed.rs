//! The state of a solve as bytes: labels of the scale at work as runs, surfaces as their control points, to the bit.
//!
//! What follows from these is made anew: windows, normal equations, costs. So the next pass is the one that would have
//! followed. It is meant for the end of a pass: what a pass that raises the energy is taken back to is then what there is.

use glam::{DMat3, DVec3};

use super::estimate::{PlanarFlow, State, Surface};
use super::label::NOBODY;
use super::region::Region;
use super::solver::{Layered, PASSES, PLANAR_ROUNDS, Phase};
use crate::energy::Energy;
use crate::error::Error;
use crate::file::packed::{Packer, Unpacker};
use crate::grid::Grid;
use crate::motion_model::MotionModel;
use crate::solver::Weights;
use crate::window::Window;

const MODELS: [MotionModel; 4] = [
    MotionModel::Still,
    MotionModel::Rotation,
    MotionModel::Translation,
    MotionModel::Full,
];
/// Alternatives of a region at most.
const MOST_ALTERNATIVES: usize = 64;

impl Layered {
    pub(super) fn write(&self, to: &mut Packer) {
        let (phase, done) = match self.phase {
            Phase::Planar(done) => (0, done),
            Phase::Search => (1, 0),
            Phase::Rigid(done) => (2, done),
            Phase::Refine => (3, 0),
            Phase::Done => (4, 0),
        };
        to.byte(phase);
        to.whole(done);
        to.whole(self.level);
        to.flag(self.warm);
        to.flag(self.rejected);
        to.flag(self.before.is_some());
        to.single(self.sigma);
        to.single(self.label_sigma);
        to.float(self.far);
        let Energy {
            data,
            smoothness,
            length,
        } = self.energy;
        to.floats([data, smoothness, length]);
        to.floats([self.weights.mu, self.weights.lambda, self.weights.sigma]);
        to.labels(self.labels.data());
        to.labels(self.offered.data());
        to.whole(self.unexplained.len());
        for &k in &self.unexplained {
            to.whole(k);
        }
        for region in &self.regions {
            for value in region.flow.p.into_iter().chain([region.flow.sigma]) {
                to.single(value);
            }
            to.flag(region.ambiguous);
            to.flag(region.hides);
            to.flag(region.rigid);
            to.whole(region.part_of.map_or(0, |whole| whole + 1));
            write_explanation(region.model, &region.state, to);
            to.whole(region.alternatives.len());
            for (model, state) in &region.alternatives {
                write_explanation(*model, state, to);
            }
            to.flag(region.dense.is_some());
            if let Some(dense) = &region.dense {
                to.exact(dense.data());
            }
        }
    }

    /// Takes a state over, of as many regions as there are. On an error all stays.
    pub(super) fn read(&mut self, from: &mut Unpacker) -> Result<(), Error> {
        let (phase, done) = (from.byte()?, from.whole(PLANAR_ROUNDS.max(PASSES))?);
        let phase = match phase {
            0 => Phase::Planar(done),
            1 => Phase::Search,
            2 => Phase::Rigid(done),
            3 => Phase::Refine,
            4 => Phase::Done,
            _ => return Err(from.wrong("it is at no stage that there is")),
        };
        let level = from.whole(self.first)?;
        let fits = match phase {
            Phase::Planar(_) | Phase::Search => level == self.first,
            Phase::Rigid(_) => true,
            Phase::Refine | Phase::Done => level == 0,
        };
        if !fits {
            return Err(from.wrong("its stage is not one of its scale"));
        }
        let (warm, rejected, is_before) = (from.flag()?, from.flag()?, from.flag()?);
        let (sigma, label_sigma) = (from.single()?, from.single()?);
        if !(sigma > 0.0 && label_sigma > 0.0 && sigma.is_finite() && label_sigma.is_finite()) {
            return Err(from.wrong("its σ is none"));
        }
        let far = from.float()?;
        if !(far >= 0.0 && far.is_finite()) {
            return Err(from.wrong("its error is none"));
        }
        let [data, smoothness, length] = from.floats()?;
        let [mu, lambda, weights_sigma] = from.floats()?;
        let count = self.regions.len();
        let scale = &self.scales[level];
        let (width, height) = (scale.width, scale.height);
        let known = |k: u8| usize::from(k) < count;
        let labels = from.labels(width * height, known)?;
        let offered = from.labels(width * height, |k| k == NOBODY || known(k))?;
        let unexplained = from.whole(count)?;
        let unexplained: Vec<usize> = (0..unexplained)
            .map(|_| from.whole(count - 1))
            .collect::<Result<_, _>>()?;
        let whole = Window::whole(self.pair.width(), self.pair.height());
        let regions: Vec<Region> = (0..count)
            .map(|_| read_region(&whole, count, from))
            .collect::<Result<_, _>>()?;
        from.end()?;
        let labels = Grid::from_vec(width, height, labels)?;
        let offered = Grid::from_vec(width, height, offered)?;

        (self.phase, self.level) = (phase, level);
        (self.warm, self.rejected, self.far) = (warm, rejected, far);
        (self.sigma, self.label_sigma) = (sigma, label_sigma);
        self.energy = Energy {
            data,
            smoothness,
            length,
        };
        self.weights = Weights {
            mu,
            lambda,
            sigma: weights_sigma,
        };
        (self.labels, self.regions, self.unexplained) = (labels, regions, unexplained);
        self.fit_memory();
        self.offered = offered;
        self.find_windows();
        // Where they cover their regions already, they stay as they are.
        if !matches!(phase, Phase::Planar(_) | Phase::Search) {
            self.fit_surfaces();
        }
        self.before = is_before.then(|| self.now());
        Ok(())
    }
}

fn write_explanation(model: MotionModel, state: &State, to: &mut Packer) {
    to.byte(MODELS.iter().position(|&m| m == model).unwrap_or(0) as u8);
    to.floats(state.translation.to_array());
    to.floats(state.rotation.to_cols_array());
    let surface = &state.surface;
    let [left, top] = surface.corner();
    for number in [surface.spacing, left, top, surface.columns, surface.rows] {
        to.whole(number);
    }
    to.exact(&surface.rho);
}

fn read_explanation(whole: &Window, from: &mut Unpacker) -> Result<(MotionModel, State), Error> {
    let model = usize::from(from.byte()?);
    let Some(&model) = MODELS.get(model) else {
        return Err(from.wrong("it has a motion model that there is not"));
    };
    let translation = DVec3::from_array(from.floats()?);
    let rotation = DMat3::from_cols_array(&from.floats()?);
    if !(translation.is_finite() && rotation.is_finite()) {
        return Err(from.wrong("it has a motion that is none"));
    }
    let side = whole.width.max(whole.height);
    let spacing = from.whole(4 * side)?;
    let (left, top) = (from.whole(whole.width)?, from.whole(whole.height)?);
    let (columns, rows) = (from.whole(side)?, from.whole(side)?);
    if !spacing.is_power_of_two() || columns < 2 || rows < 2 {
        return Err(from.wrong("it has a surface that is none"));
    }
    let surface = Surface::of(
        spacing,
        [left, top],
        [columns, rows],
        from.exact(columns * rows)?,
    );
    let state = State {
        translation,
        rotation,
        surface,
    };
    Ok((model, state))
}

fn read_region(whole: &Window, count: usize, from: &mut Unpacker) -> Result<Region, Error> {
    let mut flow = PlanarFlow::default();
    for value in flow.p.iter_mut().chain([&mut flow.sigma]) {
        *value = from.single()?;
        if !value.is_finite() {
            return Err(from.wrong("it has a plane that is none"));
        }
    }
    let (ambiguous, hides, rigid) = (from.flag()?, from.flag()?, from.flag()?);
    let part_of = from.whole(count)?.checked_sub(1);
    let (model, state) = read_explanation(whole, from)?;
    let alternatives = from.whole(MOST_ALTERNATIVES)?;
    let alternatives = (0..alternatives)
        .map(|_| read_explanation(whole, from))
        .collect::<Result<_, _>>()?;
    let dense = if from.flag()? {
        let rho = from.exact(whole.width * whole.height)?;
        Some(Grid::from_vec(whole.width, whole.height, rho)?)
    } else {
        None
    };
    let mut region = Region::new(state.surface.clone());
    (region.flow, region.state, region.model) = (flow, state, model);
    (region.alternatives, region.dense) = (alternatives, dense);
    (region.ambiguous, region.hides) = (ambiguous, hides);
    (region.rigid, region.part_of) = (rigid, part_of);
    Ok(region)
}
