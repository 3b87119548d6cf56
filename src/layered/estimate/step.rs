//! Gauss–Newton for a region's motion and surface together.
//!
//! ```text
//! E = Σ c(e)  +  μ Σ (ε s)² g(d / (ε s)) / s²  +  κ Σ s² (ρ − 1)²
//! ```
//!
//! c is the cost of a residual (`normal_equations.rs`), d the second differences of ρ at control points s pixels apart,
//! g that of (11), 2√(1+r²) − 2, or of (12), r²: planes cost nothing. The surface is eliminated from the normal equations
//! (a banded Cholesky factor, Schur complement), which leaves five numbers for the motion.
//!
//! Scale: mean ρ is 1. The part m of a step that changes the mean goes to T, T(1 + m) + δT, and only the rest to ρ;
//! with |T| held instead, small regions end far off.
//!
//! A step that raises E is taken back, and ends the iteration.

use glam::DVec3;

use super::curvature::{Prior, for_each_curvature, pull, surface_energy};
use super::normal_equations::{NormalEquations, Problem};
use super::state::State;
use super::surface::{RHO, Surface};
use crate::camera::turn;
use crate::linalg::{Banded, solve};
use crate::motion_model::MotionModel;

/// Longest δT in a step, as a share of |T|.
const LONGEST: f64 = 0.5;
/// A step that lowers E by less than so many σ² is the last one.
const ENOUGH: f64 = 1.0;

/// Solves for steps; memory is used again.
#[derive(Default)]
pub(crate) struct Estimator {
    /// Those of what the last call left.
    pub equations: NormalEquations,
    band: Banded,
    /// For each control point: the columns of the five motions, and the gradient; eight numbers are two of SIMD's four.
    cross: Vec<[f32; 8]>,
    solved: Vec<[f32; 8]>,
    /// What a step started from.
    before: State,
}

impl Estimator {
    /// Takes up to `steps` steps in ρ and in what of T and ω is `free`: ρ alone where nothing is. `fresh` says that the
    /// equations are those of `state`. E of what is left, grey levels².
    pub fn improve(
        &mut self,
        problem: &Problem,
        state: &mut State,
        free: MotionModel,
        steps: usize,
        fresh: bool,
    ) -> f64 {
        let prior = &problem.prior;
        if !fresh {
            self.equations.gather(problem, state);
        }
        let mut energy = self.energy(state, prior);
        if !free.translates() && !free.rotates() && state.translation == DVec3::ZERO {
            // Without T no depth shows.
            return energy;
        }
        for _ in 0..steps {
            self.before.clone_from(state);
            self.step(state, free, prior);
            self.equations.gather(problem, state);
            let after = self.energy(state, prior);
            // Not a number is no gain either.
            let gained = after <= energy;
            if !gained {
                state.clone_from(&self.before);
                self.equations.gather(problem, state);
                break;
            }
            let gain = energy - after;
            energy = after;
            if gain < ENOUGH * f64::from(prior.sigma * prior.sigma) {
                break;
            }
        }
        energy
    }

    fn energy(&self, state: &State, prior: &Prior) -> f64 {
        self.equations.cost + surface_energy(&state.surface, prior)
    }

    /// One step.
    fn step(&mut self, state: &mut State, free: MotionModel, prior: &Prior) {
        // A turn alone looks alike at any depth.
        let moves_depth = free != MotionModel::Rotation;
        if moves_depth {
            self.assemble(&state.surface, prior);
            self.band.factorise();
            self.solved.clear();
            self.solved.extend_from_slice(&self.cross);
            self.band.solve(&mut self.solved);
        }
        let full = self.equations.motion;
        let mut a = full;
        for i in 0..6 {
            for j in 0..i {
                a[i][j] = a[j][i];
            }
        }
        if moves_depth {
            for (cross, solved) in self.cross.iter().zip(&self.solved) {
                for i in 0..6 {
                    for j in 0..6 {
                        a[i][j] -= f64::from(cross[i]) * f64::from(solved[j]);
                    }
                }
            }
        }
        let variance = f64::from(prior.sigma * prior.sigma);
        let delta = motion_step(&a, &full, free, variance);
        self.apply(state, delta, moves_depth);
    }

    /// The band matrix and the right-hand sides.
    fn assemble(&mut self, surface: &Surface, prior: &Prior) {
        let nodes = surface.rho.len();
        self.band.clear(nodes, surface.bandwidth());
        self.cross.clear();
        self.cross.resize(nodes, [0.0; 8]);
        let rows = surface.rows - 1;
        for (n, cell) in self.equations.cells.iter().enumerate() {
            let corners = surface.corners(n / rows, n % rows);
            for p in 0..4 {
                for q in 0..=p {
                    let pair = 3 * ((p >> 1) + (q >> 1)) + (p & 1) + (q & 1);
                    self.band.add(corners[p], corners[q], cell.square[pair]);
                }
                for m in 0..6 {
                    self.cross[corners[p]][m] += cell.cross[p][m];
                }
            }
        }
        let band = &mut self.band;
        let cross = &mut self.cross;
        let bending = prior.bending(surface.spacing);
        for_each_curvature(surface, |nodes, factors, share, d| {
            // Half the derivative of what d costs, over d.
            let weight = 0.5 * share * bending.at(d * d).1;
            for (p, &node) in nodes.iter().enumerate() {
                for (q, &other) in nodes[..=p].iter().enumerate() {
                    band.add(node, other, weight * factors[p] * factors[q]);
                }
                cross[node][5] += weight * d * factors[p];
            }
        });
        let variance = prior.sigma * prior.sigma;
        let pull = pull(surface, prior);
        for (n, cross) in cross.iter_mut().enumerate() {
            band.stiffen(n, 1e-5, pull + 1e-3 * variance);
            cross[5] += pull * (surface.rho[n] - 1.0);
        }
    }

    /// Applies a step of the motion, and the surface's answer to it.
    fn apply(&mut self, state: &mut State, delta: [f64; 5], moves_depth: bool) {
        state.rotation = turn(DVec3::new(delta[2], delta[3], delta[4])) * state.rotation;
        if !moves_depth {
            return;
        }
        let [first, second] = state.tangent();
        let shift = first * delta[0] + second * delta[1];
        for solved in &mut self.solved {
            let mut change = solved[5];
            for (d, s) in delta.iter().zip(*solved) {
                change += *d as f32 * s;
            }
            solved[5] = -change;
        }
        let equations = &self.equations;
        let mean = equations.mean(&state.surface, |n| self.solved[n][5]);
        let grown = f64::from(mean.clamp(-0.7, 2.0));
        let old = state.translation;
        let new = old * (1.0 + grown) + shift;
        let share = (old.dot(new) / new.length_squared().max(1e-20)).clamp(-1.0, 3.0) as f32;
        for (rho, solved) in state.surface.rho.iter_mut().zip(&self.solved) {
            *rho = (*rho + share * (solved[5] - mean * *rho)).clamp(RHO[0], RHO[1]);
        }
        state.translation = new;
        let mean = equations.mean(&state.surface, |n| state.surface.rho[n]);
        if mean > 1e-3 {
            state.surface.rho.iter_mut().for_each(|rho| *rho /= mean);
            state.translation *= f64::from(mean);
        }
    }
}

impl NormalEquations {
    /// Mean over the cells in which something is seen.
    fn mean(&self, surface: &Surface, value: impl Fn(usize) -> f32) -> f32 {
        let rows = surface.rows - 1;
        let (mut sum, mut count) = (0.0, 0.0);
        for (n, cell) in self.cells.iter().enumerate() {
            if cell.square[0] + cell.square[4] + cell.square[8] > 0.0 {
                let corners = surface.corners(n / rows, n % rows);
                sum += corners.map(&value).iter().sum::<f32>();
                count += 4.0;
            }
        }
        if count > 0.0 { sum / count } else { 1.0 }
    }

    /// Variance of ρ over the cells in which something is seen: how deep the relief is.
    pub fn relief(&self, surface: &Surface) -> f64 {
        let mean = self.mean(surface, |n| surface.rho[n]);
        let square = self.mean(surface, |n| (surface.rho[n] - mean).powi(2));
        f64::from(square / (mean * mean).max(1e-6))
    }
}

/// Solves for the motions that are free; nothing where the data leave them open.
fn motion_step(
    reduced: &[[f64; 6]; 6],
    full: &[[f64; 6]; 6],
    free: MotionModel,
    variance: f64,
) -> [f64; 5] {
    let is_free = |i: usize| match i < 2 {
        true => free.translates(),
        false => free.rotates(),
    };
    let mut a = [[0.0; 5]; 5];
    let mut b = [0.0; 5];
    for i in 0..5 {
        if !is_free(i) {
            a[i][i] = 1.0;
            continue;
        }
        for j in (0..5).filter(|&j| is_free(j)) {
            a[i][j] = reduced[i][j];
        }
        // A region may show nothing of δT.
        a[i][i] += 1e-6 * full[i][i] + 1e-9 + if i < 2 { variance } else { 0.0 };
        b[i] = -reduced[i][5];
    }
    let step = solve(&a, &b).unwrap_or_default();
    let length = step[0].hypot(step[1]);
    step.map(|d| d * (LONGEST / length).min(1.0))
}

#[cfg(test)]
mod tests;
