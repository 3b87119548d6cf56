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

use super::estimate::{
    Blocks, Estimator, Free, NormalEquations, OTHER_DIRECTION, Outcome, Prior, State, Support,
    Surface, turn,
};
use super::scale::Scale;
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
    pub model: MotionModel,
    pub state: State,
    pub outcome: Outcome,
    pub score: f64,
}

/// A region's pixels at one scale, and what is charged.
pub(super) struct Problem<'a> {
    pub scale: &'a Scale,
    pub level: usize,
    pub support: Support<'a>,
    pub prior: Prior,
    pub sigma: f32,
}

/// What may change under a model.
pub(super) fn free(model: MotionModel) -> Free {
    match model {
        MotionModel::Still => Free::Depth,
        MotionModel::Rotation => Free::Rotation,
        MotionModel::Translation => Free::Translation,
        MotionModel::Full => Free::Full,
    }
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
    fn try_out(
        &self,
        model: MotionModel,
        mut state: State,
        steps: usize,
        (estimator, equations): (&mut Estimator, &mut NormalEquations),
    ) -> Candidate {
        let steps = if model == MotionModel::Still {
            0
        } else {
            steps
        };
        let outcome = estimator.improve(self, &mut state, free(model), steps, equations, false);
        let relief = if model.translates() {
            equations.relief(&state.surface)
        } else {
            0.0
        };
        let variance = f64::from(self.sigma * self.sigma);
        Candidate {
            score: outcome.energy / variance + RELIEF * relief,
            model,
            state,
            outcome,
        }
    }

    /// All explanations from scratch, the best first, those that are far off left out. `flat` is the surface to start from;
    /// only full motions are tried unless the model is to be selected.
    pub fn search(
        &self,
        blocks: &Blocks,
        flat: &Surface,
        select: bool,
        memory: (&mut Estimator, &mut NormalEquations),
    ) -> Vec<Candidate> {
        let (estimator, equations) = memory;
        let still = State::still(flat.clone());
        let mut found = Vec::new();
        let mut start = |model, state: State, found: &mut Vec<Candidate>| {
            let mut tried = self.try_out(model, state, STEPS[0], (estimator, equations));
            tried.score += price(model);
            found.push(tried);
        };
        if select {
            start(MotionModel::Still, still.clone(), &mut found);
            let turned = State {
                rotation: blocks.rotation(),
                ..still.clone()
            };
            start(MotionModel::Rotation, turned, &mut found);
        }
        for (model, most) in [
            (MotionModel::Full, DIRECTIONS[0]),
            (MotionModel::Translation, DIRECTIONS[1]),
        ] {
            if model != MotionModel::Full && !select {
                continue;
            }
            let first = found.len();
            for direction in blocks.directions(most, model.rotates()) {
                let state = State {
                    translation: direction.translation,
                    rotation: direction.rotation,
                    surface: flat.clone(),
                };
                start(model, state, &mut found);
            }
            let best = found[first..]
                .iter()
                .min_by(|a, b| a.score.total_cmp(&b.score));
            if let Some(mirror) = best
                .filter(|b| b.model.rotates())
                .map(|b| mirrored(&b.state))
            {
                start(model, mirror, &mut found);
            }
        }
        // Those that may be as good on a finer scale are tried again there.
        distinct(found, FINE * EQUAL)
    }

    /// Whether what [`Self::search`] found has another explanation that fits as well.
    pub fn is_ambiguous(&self, candidates: &[Candidate]) -> bool {
        ambiguous(candidates, EQUAL)
    }

    /// The same of what [`Self::select`] left.
    pub fn stays_ambiguous(&self, candidates: &[Candidate]) -> bool {
        let energy = candidates.first().map_or(0.0, |c| c.outcome.energy);
        ambiguous(
            candidates,
            SYSTEMATIC * energy / f64::from(self.sigma * self.sigma),
        )
    }

    /// The explanations given, the best first, after a few more steps of all but the first; with them a translation and a
    /// mirror image, where a full motion comes first that has none; no translation unless the model is to be selected.
    pub fn select(
        &self,
        mut given: Vec<(MotionModel, State)>,
        select: bool,
        (estimator, equations): (&mut Estimator, &mut NormalEquations),
    ) -> Vec<Candidate> {
        if let Some((MotionModel::Full, own)) = given.first().cloned() {
            if select && given.iter().all(|(m, _)| *m != MotionModel::Translation) {
                given.push((MotionModel::Translation, unturned(&own)));
            }
            given.push((MotionModel::Full, mirrored(&own)));
        }
        let tried = given.into_iter().enumerate().map(|(n, (model, state))| {
            let steps = if n == 0 { 0 } else { STEPS[1] };
            self.try_out(model, state, steps, (&mut *estimator, &mut *equations))
        });
        let mut tried: Vec<Candidate> = tried.collect();
        let least = (tried.iter().map(|c| c.outcome.energy)).fold(f64::INFINITY, f64::min);
        let turn = SYSTEMATIC * least / f64::from(self.sigma * self.sigma);
        for candidate in &mut tried {
            candidate.score += match candidate.model {
                MotionModel::Full => FINE * price(MotionModel::Translation) + turn,
                model => FINE * price(model),
            };
        }
        distinct(tried, turn)
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
        let new = kept.iter().all(|k| k.model != candidate.model);
        if candidate.score <= limit && (new || other) {
            elsewhere |= other;
            kept.push(candidate);
        }
    }
    kept
}

fn points_elsewhere(candidate: &Candidate, direction: DVec3) -> bool {
    let own = candidate.state.translation.normalize_or_zero();
    candidate.model.translates() && own.dot(direction.normalize_or_zero()) < OTHER_DIRECTION
}

/// Whether, of candidates with the best first, another with another direction of T explains the region as well: its
/// score is less than `equal` more, and its model is no freer, since a turn can always take another direction's part.
fn ambiguous(candidates: &[Candidate], equal: f64) -> bool {
    let Some((best, rest)) = candidates.split_first() else {
        return false;
    };
    let direction = best.state.translation;
    best.model.translates()
        && rest
            .iter()
            .filter(|c| c.model <= best.model)
            .any(|c| points_elsewhere(c, direction) && c.score < best.score + equal)
}

/// A flat surface that slides where it turned.
fn unturned(state: &State) -> State {
    let (t, w) = (state.translation, state.omega());
    let mut surface = state.surface.clone();
    surface.rho.fill(1.0);
    State {
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
        translation: DVec3::new(-t.x, -t.y, t.z),
        rotation: turn(DVec3::new(w.x - 2.0 * t.y, w.y + 2.0 * t.x, w.z)),
        surface,
    }
}

#[cfg(test)]
mod tests;
