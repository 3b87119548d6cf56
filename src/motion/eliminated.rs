//! Motion with depth eliminated: a global search that needs no starting depth.
//!
//! The region is split into blocks. Each keeps the moment matrix M = Σ a aᵀ of a = (s, q, It), and with
//! ρ constant in the block its best value for a translation T and rotation ω is
//!
//! ```text
//! ρ = −(Tᵀ M_s· (0, ω, 1)) / (Tᵀ M_ss T + ε)
//! ```
//!
//! so that for a unit T the cost summed over blocks is a quadratic in ω alone: one 3×3 solve. Directions
//! T are tried on the whole sphere's upper half, the best few refined by halving steps down to
//! [`FINEST_STEP`]. A depth behind the camera explains nothing: blocks with ρ < 0 count with ρ = 0, and
//! that also decides the sign of T. No pixel is touched once the moments are built.

use glam::DVec3;

use super::solve_positive;
use crate::camera::{Camera, RigidMotion};
use crate::constraint::Coefficients;
use crate::grid::Grid;
use crate::warp::{Linearisation, RESIDUAL};

/// Directions tried on the half sphere.
const DIRECTIONS: usize = 240;
/// Directions refined.
const REFINED: usize = 4;
/// Last step of the refinement, in radians.
const FINEST_STEP: f64 = 2e-3;
/// ε, as a share of the mean of Tᵀ M_ss T.
const RIDGE: f64 = 1e-3;

/// Moments of one block: the lower triangle of M, s first, then q, then It.
type Moments = [[f64; 7]; 7];

/// The moments of a region.
pub struct Blocks {
    moments: Vec<Moments>,
    ridge: f64,
    prior: f64,
}

/// A motion and what it costs.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// T of length 1 and ω.
    pub motion: RigidMotion,
    /// Σ ψ² with the best depth of every block, grey levels².
    pub cost: f64,
}

impl Blocks {
    /// Gathers the moments of the pixels with `weight` > 0 in blocks of `side` pixels, of the constraint
    /// taken back to a motion from zero: It = r − ∇I·w. `prior` is the precision of ω known beforehand.
    pub fn gather(
        camera: &Camera,
        linearisation: &Linearisation,
        weight: &Grid<f32>,
        side: usize,
        prior: f64,
    ) -> Self {
        let window = linearisation.window;
        let (width, height) = (window.width, window.height);
        let across = width.div_ceil(side);
        let mut all = vec![[[0.0; 7]; 7]; across * height.div_ceil(side)];
        let mut seen = vec![0.0f64; all.len()];
        for y in 0..height {
            for x in 0..width {
                let at = (x, y);
                let w = f64::from(weight[at]);
                if w <= 0.0 {
                    continue;
                }
                let [ix, iy] = linearisation.gradient[at].map(f64::from);
                let [u, v] = linearisation.flow[at].map(f64::from);
                let it = f64::from(linearisation.rows[at][RESIDUAL]) - ix * u - iy * v;
                // Halfway along the displacement, where a motion over the whole interval is linear
                // to second order.
                let px = (window.left + x) as f64 + 0.5 * u;
                let py = (window.top + y) as f64 + 0.5 * v;
                let c = Coefficients::at(camera, px, py, ix, iy);
                let a = [c.s.x, c.s.y, c.s.z, c.q.x, c.q.y, c.q.z, it];
                let block = (y / side) * across + x / side;
                seen[block] += w;
                for i in 0..7 {
                    for j in 0..=i {
                        all[block][i][j] += w * a[i] * a[j];
                    }
                }
            }
        }
        let least = (side * side) as f64 / 8.0;
        let moments: Vec<Moments> = all
            .into_iter()
            .zip(seen)
            .filter(|(_, n)| *n >= least)
            .map(|(m, _)| m)
            .collect();
        let mean: f64 = moments.iter().map(|m| m[0][0] + m[1][1]).sum::<f64>()
            / (2 * moments.len().max(1)) as f64;
        Self {
            moments,
            ridge: RIDGE * mean,
            prior,
        }
    }

    /// Whether there are blocks enough to tell a motion from.
    pub fn enough(&self) -> bool {
        self.moments.len() >= 4
    }

    /// The best motion over all directions of T. `rotates` says whether ω is free.
    pub fn search(&self, rotates: bool) -> Option<Candidate> {
        let mut found: Vec<Candidate> = half_sphere()
            .filter_map(|t| self.judge(t, rotates))
            .collect();
        found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        found.truncate(REFINED);
        let refined = found.into_iter().map(|c| self.refine(c, rotates));
        refined.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// The cost of a direction of T, with its best ω.
    pub fn judge(&self, direction: DVec3, rotates: bool) -> Option<Candidate> {
        let t = direction.normalize_or_zero().to_array();
        let mut normal = [[0.0; 3]; 3];
        let mut right = [0.0; 3];
        for m in &self.moments {
            let (c, v) = self.along(m, &t);
            for i in 0..3 {
                for j in 0..=i {
                    normal[i][j] += m[3 + i][3 + j] - v[i] * v[j] / c;
                }
                right[i] -= m[6][3 + i] - v[i] * v[3] / c;
            }
        }
        for i in 0..3 {
            normal[i][i] += self.prior;
        }
        let w = if rotates {
            solve_positive(&normal, &right)?
        } else {
            [0.0; 3]
        };
        // Both signs of T; blocks behind the camera are left without depth.
        let mut cost = [0.0; 2];
        for m in &self.moments {
            let (c, v) = self.along(m, &t);
            let mut flat = m[6][6];
            let mut pull = v[3];
            for i in 0..3 {
                flat += 2.0 * m[6][3 + i] * w[i] + m[3 + i][3 + i] * w[i] * w[i];
                for j in 0..i {
                    flat += 2.0 * m[3 + i][3 + j] * w[i] * w[j];
                }
                pull += v[i] * w[i];
            }
            let gain = pull * pull / c;
            cost[0] += flat - if pull < 0.0 { gain } else { 0.0 };
            cost[1] += flat - if pull > 0.0 { gain } else { 0.0 };
        }
        let forwards = cost[0] <= cost[1];
        let prior: f64 = w.iter().map(|w| self.prior * w * w).sum();
        Some(Candidate {
            motion: RigidMotion {
                translation: DVec3::from_array(t) * if forwards { 1.0 } else { -1.0 },
                rotation: DVec3::from_array(w),
            },
            cost: cost[0].min(cost[1]) + prior,
        })
    }

    /// Tᵀ M_ss T + ε, and Tᵀ M_s· against (q, It).
    fn along(&self, m: &Moments, t: &[f64; 3]) -> (f64, [f64; 4]) {
        let mut c = self.ridge;
        for i in 0..3 {
            c += m[i][i] * t[i] * t[i];
            for j in 0..i {
                c += 2.0 * m[i][j] * t[i] * t[j];
            }
        }
        let v = std::array::from_fn(|k| (0..3).map(|i| t[i] * m[3 + k][i]).sum());
        (c, v)
    }

    fn refine(&self, mut best: Candidate, rotates: bool) -> Candidate {
        let mut step = (2.0 * std::f64::consts::PI / DIRECTIONS as f64).sqrt();
        while step > FINEST_STEP {
            let t = best.motion.translation;
            let (a, b) = t.any_orthonormal_pair();
            let around = [a, -a, b, -b].map(|d| t + step * d);
            let tried = around.into_iter().filter_map(|t| self.judge(t, rotates));
            match tried.min_by(|a, b| a.cost.total_cmp(&b.cost)) {
                Some(better) if better.cost < best.cost => best = better,
                _ => step *= 0.5,
            }
        }
        best
    }
}

/// Directions spread evenly over the half sphere z ≥ 0 (a Fibonacci spiral).
fn half_sphere() -> impl Iterator<Item = DVec3> {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    (0..DIRECTIONS).map(move |i| {
        let z = (i as f64 + 0.5) / DIRECTIONS as f64;
        let r = (1.0 - z * z).sqrt();
        let angle = golden * i as f64;
        DVec3::new(r * angle.cos(), r * angle.sin(), z)
    })
}
