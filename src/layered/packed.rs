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

/// All that there are.
fn phases() -> Vec<Phase> {
    let planar = (0..PLANAR_ROUNDS).map(Phase::Planar);
    let rigid = (0..PASSES).map(Phase::Rigid);
    let others = [Phase::Search, Phase::Refine, Phase::Done];
    planar.chain(rigid).chain(others).collect()
}

impl Layered {
    pub(super) fn write(&self, to: &mut Packer) {
        to.one_of(&phases(), &self.phase);
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
        to.list(&self.unexplained, |to, &k| to.whole(k));
        for region in &self.regions {
            for value in region.flow.p.into_iter().chain([region.flow.sigma]) {
                to.single(value);
            }
            to.flag(region.ambiguous);
            to.flag(region.hides);
            to.flag(region.rigid);
            to.whole(region.part_of.map_or(0, |whole| whole + 1));
            write_explanation(&region.state, to);
            to.list(&region.alternatives, |to, state| {
                write_explanation(state, to)
            });
            to.flag(region.dense.is_some());
            if let Some(dense) = &region.dense {
                to.exact(dense.data());
            }
        }
    }

    /// Takes a state over, of as many regions as there are. On an error all stays.
    pub(super) fn read(&mut self, from: &mut Unpacker) -> Result<(), Error> {
        let phase = from.one_of(&phases())?;
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
        let [far] = from.floats()?;
        if !(sigma > 0.0 && label_sigma > 0.0 && far >= 0.0) {
            return Err(from.wrong("its σ is none"));
        }
        let [data, smoothness, length] = from.floats()?;
        let [mu, lambda, weights_sigma] = from.floats()?;
        let count = self.regions.len();
        let scale = &self.scales[level];
        let (width, height) = (scale.width, scale.height);
        let known = |k: u8| usize::from(k) < count;
        let labels = from.labels(width * height, known)?;
        let offered = from.labels(width * height, |k| k == NOBODY || known(k))?;
        let unexplained = from.list(count, |from| from.whole(count - 1))?;
        let whole = Window::whole(self.pair.width(), self.pair.height());
        let regions = from.times(count, |from| read_region(&whole, count, from))?;
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

fn write_explanation(state: &State, to: &mut Packer) {
    to.one_of(&MODELS, &state.model);
    to.floats(state.translation.to_array());
    to.floats(state.rotation.to_cols_array());
    let Surface {
        spacing,
        left,
        top,
        columns,
        rows,
        ..
    } = state.surface;
    for number in [spacing, left, top, columns, rows] {
        to.whole(number);
    }
    to.exact(&state.surface.rho);
}

fn read_explanation(whole: &Window, from: &mut Unpacker) -> Result<State, Error> {
    let model = from.one_of(&MODELS)?;
    let translation = DVec3::from_array(from.floats()?);
    let rotation = DMat3::from_cols_array(&from.floats()?);
    let side = whole.width.max(whole.height);
    let spacing = from.whole(4 * side)?;
    let (left, top) = (from.whole(whole.width)?, from.whole(whole.height)?);
    let (columns, rows) = (from.whole(side)?, from.whole(side)?);
    if !spacing.is_power_of_two() || columns < 2 || rows < 2 {
        return Err(from.wrong("it has a surface that is none"));
    }
    let surface = Surface {
        spacing,
        left,
        top,
        columns,
        rows,
        rho: from.exact(columns * rows)?,
    };
    Ok(State {
        model,
        translation,
        rotation,
        surface,
    })
}

fn read_region(whole: &Window, count: usize, from: &mut Unpacker) -> Result<Region, Error> {
    let mut flow = PlanarFlow::default();
    for value in flow.p.iter_mut().chain([&mut flow.sigma]) {
        *value = from.single()?;
    }
    let (ambiguous, hides, rigid) = (from.flag()?, from.flag()?, from.flag()?);
    let part_of = from.whole(count)?.checked_sub(1);
    let state = read_explanation(whole, from)?;
    let alternatives = from.list(MOST_ALTERNATIVES, |from| read_explanation(whole, from))?;
    let dense = if from.flag()? {
        let rho = from.exact(whole.width * whole.height)?;
        Some(Grid::from_vec(whole.width, whole.height, rho)?)
    } else {
        None
    };
    let mut region = Region::new(state.surface.clone());
    (region.flow, region.state) = (flow, state);
    (region.alternatives, region.dense) = (alternatives, dense);
    (region.ambiguous, region.hides) = (ambiguous, hides);
    (region.rigid, region.part_of) = (rigid, part_of);
    Ok(region)
}
