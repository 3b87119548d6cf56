//! Motion and depth of one region together: a Gauss–Newton step in which depth is eliminated exactly.
//!
//! With r ≈ r + a δρ + b·δm at each pixel (warp.rs; m = (T, ω)) and ρ a polynomial surface and a smooth departure from it
//! (`depth/polynomials.rs`), δρ = δd + Σ_k δq_k b_k, the step minimises
//!
//! ```text
//! Σ ω_i (r + a δρ + b·δm)² + κ Σ (ρ + δρ − 1)² + Σ_edges c_ij ((d+δd)_i − (d+δd)_j − s_ij)² + prior(m)
//! ```
//!
//! Where depth is smooth about its own slope instead (`depth/bends.rs`), d is all of ρ, and quadratics are taken with it
//! because they cost nothing there either, once s has followed: left to δd they would be held as they were, and relief
//! and T come a little deeper in every step.
//!
//! Alternating between depth and motion crawls along the valleys in which a small motion and a slant or a bend of
//! the depth undo each other. Here the best departure for *every* motion and surface is known to first order,
//! δd = x + S z with z = (δm, δq), from one linear system with a right-hand side for each number in z and one more,
//! A x = −(ω a r + κ (ρ − 1) + L(d, s)) and A S = −C, where C = ω a b for a motion and (ω a² + κ) b_k for a surface;
//! what is left is at most 14 × 14. One step; the caller repeats it around the new linearisation.
//!
//! T's length is not observable: longer T and less ρ are the same film. Held perpendicular to itself, T turns to where
//! the same film takes less relief and so less smoothness: to the side, away from where it is headed. That keeps small
//! regions, which hardly tell, from guessing. Where relief is large and well seen, what is held is how much of ρ the frames
//! show, Σ ω ρ a² as a function of T, so that δT is perpendicular to its gradient g = Σ ω a ∂r/∂T.

use glam::{DQuat, DVec3};

use super::Kind;
use super::solve_positive;
use crate::camera::RigidMotion;
use crate::depth::{Elliptic, Polynomials};
use crate::grid::Grid;
use crate::warp::{RESIDUAL, Row};

/// The linear system of a region at its present linearisation.
pub struct JointStep<'a> {
    /// Derivatives and residual at every pixel.
    pub rows: &'a Grid<Row>,
    /// ω_i: 0 outside the region.
    pub weight: &'a Grid<f32>,
    /// ω a² + κ.
    pub data: &'a Grid<f32>,
    /// −(ω a r + κ (ρ − 1)): how data and prior pull on ρ as it is.
    pub force: &'a Grid<f32>,
    /// A: `data` on the diagonal, the smoothing's c on the edges.
    pub system: &'a Elliptic,
    /// −L(d, s): how the smoothing pulls on d as it is.
    pub pull: &'a Grid<f32>,
    /// The surfaces that smoothness does not hold.
    pub surface: Option<&'a Polynomials>,
    /// Precision of each component of ω known beforehand, so that the prior is this times |ω|².
    pub rotation_prior: f64,
    /// What may move.
    pub kind: Kind,
    /// Whether T keeps how much of ρ shows, rather than its length.
    pub keeps_shown: bool,
    /// Longest step of T and of ω: the linearisation holds no further.
    pub longest: f64,
}

/// A step of (T, ω) shortened, as a whole, until neither part is longer than `longest`.
pub fn held(step: [f64; 6], longest: f64) -> [f64; 6] {
    let length = |part: &[f64]| part.iter().map(|x| x * x).sum::<f64>().sqrt();
    let most = length(&step[..3]).max(length(&step[3..]));
    if most > longest {
        step.map(|x| x * longest / most)
    } else {
        step
    }
}

/// Where a step leads.
pub struct Joint {
    /// The new motion.
    pub motion: RigidMotion,
    /// δρ.
    pub depth_step: Grid<f32>,
}

/// Residual of the linear systems, relative; later steps start from a better linearisation anyway.
const TOLERANCE: f64 = 1e-3;
/// Most iterations of conjugate gradients.
const MOST_ITERATIONS: usize = 12;
/// Numbers in z at most: T's length is not observable.
const MOST_FREE: usize = 5 + Polynomials::TERMS;

/// z that is left once δd is eliminated: its normal equations.
struct Reduced {
    h: [[f64; MOST_FREE]; MOST_FREE],
    g: [f64; MOST_FREE],
}

impl JointStep<'_> {
    /// Takes the step from `motion`.
    pub fn solve(&self, motion: &RigidMotion) -> Joint {
        let free = self.free_directions(motion);
        // A lane for δd as it is and one for each number in z.
        let (step, depth_step) = match 1 + free.len() + self.surfaces().len() {
            ..=1 => self.step::<1>(&free, motion),
            2..=4 => self.step::<4>(&free, motion),
            5..=8 => self.step::<8>(&free, motion),
            9..=12 => self.step::<12>(&free, motion),
            _ => self.step::<16>(&free, motion),
        };
        let turn = DVec3::new(step[3], step[4], step[5]);
        let turn = DQuat::from_scaled_axis(turn);
        Joint {
            motion: RigidMotion {
                translation: turn * motion.translation + DVec3::new(step[0], step[1], step[2]),
                rotation: (turn * DQuat::from_scaled_axis(motion.rotation)).to_scaled_axis(),
            },
            depth_step,
        }
    }

    /// The step of (T, ω) and of ρ, with L lanes for at most L − 1 numbers in z.
    fn step<const L: usize>(
        &self,
        free: &[[f64; 6]],
        motion: &RigidMotion,
    ) -> ([f64; 6], Grid<f32>) {
        let (right, mut reduced) = self.gather::<L>(free);
        let mut solution = vec![[0.0f32; L]; right.len()];
        if self.kind.translates() {
            self.system
                .solve(&right, &mut solution, TOLERANCE, MOST_ITERATIONS);
        }
        let surfaces = self.surfaces();
        let all = free.len() + surfaces.len();
        reduced.eliminate(&right, &solution, all);
        reduced.expect(free, motion, self.rotation_prior);
        let z = reduced.solve(all);
        let wanted = std::array::from_fn(|r| free.iter().zip(&z).map(|(d, z)| d[r] * z).sum());
        let step = held(wanted, self.longest);
        let moved = step.iter().zip(&wanted).find(|(_, w)| **w != 0.0);
        let share = moved.map_or(1.0, |(s, w)| s / w);
        let z = z.map(|z| (share * z) as f32);
        let mut depth_step = Grid::new(self.rows.width(), self.rows.height(), 0.0f32);
        for (i, (d, s)) in depth_step.data_mut().iter_mut().zip(&solution).enumerate() {
            *d = s[0] + (0..all).map(|j| s[1 + j] * z[j]).sum::<f32>();
            for (surface, z) in surfaces.iter().zip(&z[free.len()..]) {
                *d += surface.data()[i] * z;
            }
        }
        (step, depth_step)
    }

    /// The right-hand sides, and what z would have to solve were δd held.
    fn gather<const L: usize>(&self, free: &[[f64; 6]]) -> (Vec<[f32; L]>, Reduced) {
        let surfaces = self.surfaces();
        let directions: Vec<[f32; 6]> = free.iter().map(|d| d.map(|x| x as f32)).collect();
        let moving = free.len();
        let all = moving + surfaces.len();
        let mut reduced = Reduced {
            h: [[0.0; MOST_FREE]; MOST_FREE],
            g: [0.0; MOST_FREE],
        };
        let Reduced { h, g } = &mut reduced;
        let mut right = vec![[0.0f32; L]; self.rows.len()];
        for (i, right) in right.iter_mut().enumerate() {
            let (data, force) = (self.data.data()[i], self.force.data()[i]);
            right[0] = self.pull.data()[i] + force;
            let (row, w) = (&self.rows.data()[i], self.weight.data()[i]);
            let mut b = [0.0f32; MOST_FREE];
            if w > 0.0 {
                for (j, d) in directions.iter().enumerate() {
                    b[j] = (0..6).map(|r| d[r] * row[1 + r]).sum();
                    right[1 + j] = -w * row[0] * b[j];
                    let wb = f64::from(w * b[j]);
                    g[j] += wb * f64::from(row[RESIDUAL]);
                    for k in 0..=j {
                        h[j][k] += wb * f64::from(b[k]);
                    }
                }
            }
            if data <= 0.0 {
                continue;
            }
            for (j, surface) in (moving..all).zip(surfaces) {
                let value = surface.data()[i];
                right[1 + j] = -data * value;
                let value = f64::from(value);
                g[j] -= value * f64::from(force);
                for k in 0..=j {
                    h[j][k] -= value * f64::from(right[1 + k]);
                }
            }
        }
        (right, reduced)
    }

    fn surfaces(&self) -> &[Grid<f32>] {
        match self.surface {
            Some(surface) if self.kind.translates() => surface.terms(),
            _ => &[],
        }
    }

    /// g.
    fn shown(&self) -> DVec3 {
        let each = self.rows.data().iter().zip(self.weight.data());
        each.map(|(row, &w)| {
            let by_translation = DVec3::new(row[1].into(), row[2].into(), row[3].into());
            f64::from(w * row[0]) * by_translation
        })
        .sum()
    }

    /// The directions of (T, ω) that the kind leaves free, T's perpendicular to T or to g.
    fn free_directions(&self, motion: &RigidMotion) -> Vec<[f64; 6]> {
        let mut free: Vec<[f64; 6]> = Vec::new();
        if self.kind.translates() {
            let held = if self.keeps_shown {
                self.shown()
            } else {
                motion.translation
            };
            let (a, b) = held.normalize_or(DVec3::X).any_orthonormal_pair();
            for d in [a, b] {
                free.push([d.x, d.y, d.z, 0.0, 0.0, 0.0]);
            }
        }
        if self.kind.rotates() {
            for j in 3..6 {
                let mut unit = [0.0; 6];
                unit[j] = 1.0;
                free.push(unit);
            }
        }
        free
    }
}

impl Reduced {
    /// Adds the share of δd, which is `solution` for the right-hand sides `right`: Σ C·(x, S).
    fn eliminate<const L: usize>(&mut self, right: &[[f32; L]], solution: &[[f32; L]], all: usize) {
        for (right, found) in right.iter().zip(solution) {
            for j in 0..all {
                let c = -f64::from(right[1 + j]);
                self.g[j] += c * f64::from(found[0]);
                for k in 0..=j {
                    self.h[j][k] += c * f64::from(found[1 + k]);
                }
            }
        }
    }

    /// Adds the prior of ω.
    fn expect(&mut self, free: &[[f64; 6]], motion: &RigidMotion, prior: f64) {
        let w = motion.rotation.to_array();
        for (j, d) in free.iter().enumerate() {
            for k in 0..=j {
                self.h[j][k] += prior * (3..6).map(|r| d[r] * free[k][r]).sum::<f64>();
            }
            self.g[j] += prior * (0..3).map(|r| d[3 + r] * w[r]).sum::<f64>();
        }
    }

    /// z, of which the first `all` numbers are free; 0 where the region leaves them open.
    fn solve(mut self, all: usize) -> [f64; MOST_FREE] {
        for j in 0..MOST_FREE {
            if j < all {
                // A touch of damping for what the region hardly shows.
                self.h[j][j] *= 1.0 + 1e-6;
            } else {
                // What is not free becomes the equation z = 0.
                self.h[j][j] = 1.0;
            }
        }
        solve_positive(&self.h, &self.g.map(|g| -g)).unwrap_or_default()
    }
}
