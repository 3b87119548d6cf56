//! Motion and depth of one region together: a Gauss–Newton step in which depth is eliminated exactly.
//!
//! With r ≈ r + a δρ + b·δm at each pixel (warp.rs; m = (T, ω)) and a smooth depth, the step minimises
//!
//! ```text
//! Σ ω_i (r + a δρ + b·δm)² + Σ_edges c_ij ((ρ+δρ)_i − (ρ+δρ)_j − plane_i + plane_j)² + prior(m)
//! ```
//!
//! Alternating between depth and motion crawls along the valleys in which a small motion and a slant of
//! the depth undo each other. Here the best depth for *every* motion is known to first order,
//! δρ = x + S δm, with one linear system of seven right-hand sides, A x = −(ω a r + L(ρ − plane)) and
//! A S = −ω a b; what is left is 6×6: H = Σ ω b bᵀ + Σ ω a b Sᵀ. T's length is not observable, so that δT
//! is held perpendicular to T. One step; the caller repeats it around the new linearisation.

use glam::{DQuat, DVec3};

use super::Kind;
use super::cholesky::solve_positive;
use crate::camera::RigidMotion;
use crate::depth::Elliptic;
use crate::grid::Grid;
use crate::warp::{RESIDUAL, Row};

/// The linear system of a region at its present linearisation.
pub struct JointStep<'a> {
    /// Derivatives and residual at every pixel.
    pub rows: &'a Grid<Row>,
    /// ω_i: 0 outside the region.
    pub weight: &'a Grid<f32>,
    /// A: ω a² on the diagonal, the smoothing's c on the edges.
    pub system: &'a Elliptic,
    /// −L(ρ − plane): how the smoothing pulls on ρ as it is.
    pub pull: &'a Grid<f32>,
    /// Precision of each component of ω known beforehand, so that the prior is this times |ω|².
    pub rotation_prior: f64,
    /// What may move.
    pub kind: Kind,
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
/// Directions of (T, ω) that may be free: T's length is not observable.
const MOST_FREE: usize = 5;

impl JointStep<'_> {
    /// Takes the step from `motion`.
    pub fn solve(&self, motion: &RigidMotion) -> Joint {
        let free = self.free_directions(motion);
        // A lane for δρ as it is and one for each direction of (T, ω) that may change.
        let (step, depth_step) = match free.len() {
            0 => self.reduced::<1>(&free, motion),
            1..=3 => self.reduced::<4>(&free, motion),
            _ => self.reduced::<8>(&free, motion),
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

    /// The step of (T, ω) and of ρ, with L lanes for at most L − 1 free directions.
    fn reduced<const L: usize>(
        &self,
        free: &[[f64; 6]],
        motion: &RigidMotion,
    ) -> ([f64; 6], Grid<f32>) {
        let n = self.rows.len();
        let (rows, weight) = (self.rows.data(), self.weight.data());
        let directions: Vec<[f32; 6]> = free.iter().map(|d| d.map(|x| x as f32)).collect();
        let mut right = vec![[0.0f32; L]; n];
        let mut h = [[0.0f64; MOST_FREE]; MOST_FREE];
        let mut g = [0.0f64; MOST_FREE];
        for i in 0..n {
            let (row, w) = (&rows[i], weight[i]);
            right[i][0] = self.pull.data()[i];
            if w > 0.0 {
                let wa = w * row[0];
                right[i][0] -= wa * row[RESIDUAL];
                let mut b = [0.0f32; MOST_FREE];
                for (b, d) in b.iter_mut().zip(&directions) {
                    *b = (0..6).map(|r| d[r] * row[1 + r]).sum();
                }
                for j in 0..free.len() {
                    right[i][1 + j] = -wa * b[j];
                    let wb = f64::from(w * b[j]);
                    g[j] += wb * f64::from(row[RESIDUAL]);
                    for k in 0..=j {
                        h[j][k] += wb * f64::from(b[k]);
                    }
                }
            }
        }
        let mut solution = vec![[0.0f32; L]; n];
        if self.kind.translates() {
            self.system
                .solve(&right, &mut solution, TOLERANCE, MOST_ITERATIONS);
        }
        // Σ ω a b · (x, S), the eliminated depth's share.
        for i in 0..n {
            if weight[i] > 0.0 {
                let (b, x) = (&right[i], &solution[i]);
                for j in 0..free.len() {
                    let wab = -f64::from(b[1 + j]);
                    g[j] += wab * f64::from(x[0]);
                    for k in 0..=j {
                        h[j][k] += wab * f64::from(x[1 + k]);
                    }
                }
            }
        }
        let w = motion.rotation.to_array();
        for j in 0..MOST_FREE {
            let Some(d) = free.get(j) else {
                // What is not free becomes the equation x = 0.
                h[j][j] = 1.0;
                continue;
            };
            for k in 0..=j {
                let along: f64 = (3..6).map(|r| d[r] * free[k][r]).sum();
                h[j][k] += self.rotation_prior * along;
            }
            g[j] += self.rotation_prior * (0..3).map(|r| d[3 + r] * w[r]).sum::<f64>();
            // A touch of damping for motions that the region hardly shows.
            h[j][j] *= 1.0 + 1e-6;
        }
        let x = solve_positive(&h, &g.map(|g| -g)).unwrap_or_default();
        let wanted = std::array::from_fn(|r| free.iter().zip(&x).map(|(d, x)| d[r] * x).sum());
        let step = held(wanted, self.longest);
        let share = step
            .iter()
            .zip(&wanted)
            .find(|(_, w)| **w != 0.0)
            .map_or(0.0, |(s, w)| s / w);
        let mut depth_step = Grid::new(self.rows.width(), self.rows.height(), 0.0f32);
        for (d, s) in depth_step.data_mut().iter_mut().zip(&solution) {
            let by_motion: f32 = (0..free.len()).map(|j| s[1 + j] * x[j] as f32).sum();
            *d = s[0] + share as f32 * by_motion;
        }
        (step, depth_step)
    }

    /// The directions of (T, ω) that the kind leaves free, T's perpendicular to T.
    fn free_directions(&self, motion: &RigidMotion) -> Vec<[f64; 6]> {
        let mut free: Vec<[f64; 6]> = Vec::new();
        if self.kind.translates() {
            let along = motion.translation.normalize_or(DVec3::X);
            let (a, b) = along.any_orthonormal_pair();
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
