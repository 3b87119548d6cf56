//! Motion models: where each starts, and which one is taken.
//!
//! ```text
//! score = E/σ² + 100 · variance of ρ + price of the model
//! ```
//!
//! The least score wins: of explanations that fit equally the one with fewer numbers and the flatter relief. Prices are
//! those at which truly still, turning and translating regions of random scenes are told apart; they are higher than
//! Schwarz's criterion, since smoothing leaves the noise of neighbouring pixels alike. What no rigid motion explains, shadows
//! and wrong labels, is explained in part by one that is free enough: E has to differ by [`SYSTEMATIC`] of itself for a
//! turn on top of a translation to be taken, or for another direction of T to be ruled out.

use glam::{DMat3, DVec3};

use super::estimate::{Blocks, Estimator, OTHER_DIRECTION, Problem, State, Surface};
use crate::camera::turn;
use crate::motion_model::MotionModel;
use crate::ordered::ordered;

/// What the variance of ρ is charged.
const RELIEF: f64 = 100.0;
/// Gauss–Newton steps of a candidate on a coarse scale, and on the scale where one is selected.
const STEPS: [usize; 2] = [5, 3];
/// Directions of T that are tried with a rotation and without.
const DIRECTIONS: [usize; 2] = [5, 3];
/// A candidate with another direction of T within this score of the best explains the region as well, on a coarse scale.
const EQUAL: f64 = 10.0;
/// Factor of prices on the scale where a model is selected: more pixels tell more.
const FINE: f64 = 6.0;
/// Share of E by which explanations may differ for what none of them explains, on the scale where a model is selected.
const SYSTEMATIC: f64 = 0.04;

/// An explanation of a region.
pub(super) struct Candidate {
    pub state: State,
    /// E, grey levels².
    pub energy: f64,
    pub score: f64,
}

/// What a model is charged.
fn price(model: MotionModel) -> f64 {
    match model {
        MotionModel::Still => 0.0,
        MotionModel::Rotation => 20.0,
        MotionModel::Translation => 30.0,
        MotionModel::Full => 50.0,
    }
}

impl Problem<'_> {
    fn try_out(&self, mut state: State, steps: usize, estimator: &mut Estimator) -> Candidate {
        let model = state.model;
        let energy = estimator.improve(self, &mut state, model, steps, false);
        let relief = if model.translates() {
            estimator.equations.relief(&state.surface)
        } else {
            0.0
        };
        Candidate {
            score: energy / self.variance() + RELIEF * relief,
            state,
            energy,
        }
    }

    fn variance(&self) -> f64 {
        f64::from(self.prior.sigma * self.prior.sigma)
    }

    /// All explanations from scratch, the best first, those that are far off left out, and whether another fits as well as
    /// the best. `flat` is the surface to start from; only full motions are tried unless the model is to be selected.
    pub fn search(
        &self,
        blocks: &Blocks,
        flat: Surface,
        select: bool,
        estimator: &mut Estimator,
    ) -> (Vec<Candidate>, bool) {
        let still = State::still(flat);
        let mut found = Vec::new();
        let mut start = |state: State, found: &mut Vec<Candidate>| {
            let mut tried = self.try_out(state, STEPS[0], estimator);
            tried.score += price(tried.state.model);
            found.push(tried);
        };
        if select {
            start(still.clone(), &mut found);
            let turned = State {
                model: MotionModel::Rotation,
                rotation: blocks.rotation(),
                ..still.clone()
            };
            start(turned, &mut found);
        }
        for direction in blocks.directions(DIRECTIONS[0], true) {
            start(still.moving(MotionModel::Full, &direction), &mut found);
        }
        let full = (found.iter()).filter(|c| c.state.model == MotionModel::Full);
        let best = full.min_by(|a, b| a.score.total_cmp(&b.score));
        if let Some(mirror) = best.map(|b| mirrored(&b.state)) {
            start(mirror, &mut found);
        }
        if select {
            for direction in blocks.directions(DIRECTIONS[1], false) {
                start(
                    still.moving(MotionModel::Translation, &direction),
                    &mut found,
                );
            }
        }
        // Those that may be as good on a finer scale are tried again there.
        let found = distinct(found, FINE * EQUAL);
        let open = ambiguous(&found, EQUAL);
        (found, open)
    }

    /// The explanations given, the same, after a few more steps of all but the first; with them a translation and a
    /// mirror image, where a full motion comes first that has none; no translation unless the model is to be selected.
    pub fn select(
        &self,
        mut given: Vec<State>,
        select: bool,
        estimator: &mut Estimator,
    ) -> (Vec<Candidate>, bool) {
        if let Some(own) = given
            .first()
            .filter(|own| own.model == MotionModel::Full)
            .cloned()
        {
            if select && given.iter().all(|s| s.model != MotionModel::Translation) {
                given.push(unturned(&own));
            }
            given.push(mirrored(&own));
        }
        let tried = given.into_iter().enumerate().map(|(n, state)| {
            let steps = if n == 0 { 0 } else { STEPS[1] };
            self.try_out(state, steps, estimator)
        });
        let mut tried: Vec<Candidate> = tried.collect();
        let least = (tried.iter().map(|c| c.energy)).fold(f64::INFINITY, f64::min);
        let turn = SYSTEMATIC * least / self.variance();
        for candidate in &mut tried {
            candidate.score += match candidate.state.model {
                MotionModel::Full => FINE * price(MotionModel::Translation) + turn,
                model => FINE * price(model),
            };
        }
        let found = distinct(tried, turn);
        let open = ambiguous(&found, turn);
        (found, open)
    }
}

/// The best first; of each model only the best, and the best whose T points elsewhere; none that is far off.
fn distinct(found: Vec<Candidate>, close: f64) -> Vec<Candidate> {
    let found = ordered(found, |candidate| candidate.score);
    let Some(best) = found.first() else {
        return found;
    };
    let (limit, direction) = (best.score + close, best.state.translation);
    let mut kept: Vec<Candidate> = Vec::new();
    let mut elsewhere = false;
    for candidate in found {
        let other = points_elsewhere(&candidate, direction) && !elsewhere;
        let new = (kept.iter()).all(|k| k.state.model != candidate.state.model);
        if candidate.score <= limit && (new || other) {
            elsewhere |= other;
            kept.push(candidate);
        }
    }
    kept
}

fn points_elsewhere(candidate: &Candidate, direction: DVec3) -> bool {
    let own = candidate.state.translation.normalize_or_zero();
    candidate.state.model.translates() && own.dot(direction.normalize_or_zero()) < OTHER_DIRECTION
}

/// Whether, of candidates with the best first, another with another direction of T explains the region as well: its
/// score is less than `equal` more, and its model is no freer, since a turn can always take another direction's part.
fn ambiguous(candidates: &[Candidate], equal: f64) -> bool {
    let Some((best, rest)) = candidates.split_first() else {
        return false;
    };
    let direction = best.state.translation;
    best.state.model.translates()
        && rest
            .iter()
            .filter(|c| c.state.model <= best.state.model)
            .any(|c| points_elsewhere(c, direction) && c.score < best.score + equal)
}

/// A flat surface that slides where it turned.
fn unturned(state: &State) -> State {
    let (t, w) = (state.translation, state.omega());
    let mut surface = state.surface.clone();
    surface.rho.fill(1.0);
    State {
        model: MotionModel::Translation,
        translation: DVec3::new(t.x + w.y, t.y - w.x, t.z),
        rotation: DMat3::IDENTITY,
        surface,
    }
}

/// The explanation that differs by perspective alone: hollow where the other bulges, and turning the other way.
fn mirrored(state: &State) -> State {
    let (t, w) = (state.translation, state.omega());
    let mut surface = state.surface.clone();
    for rho in &mut surface.rho {
        *rho = (2.0 - *rho).max(0.2);
    }
    State {
        model: state.model,
        translation: DVec3::new(-t.x, -t.y, t.z),
        rotation: turn(DVec3::new(w.x - 2.0 * t.y, w.y + 2.0 * t.x, w.z)),
        surface,
    }
}

#[cfg(test)]
mod tests;
