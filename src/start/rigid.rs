//! One rigid motion for several surfaces, whatever their depth.
//!
//! With T = |T| d, a patch seen along the ray (X, Y) moves by
//!
//! ```text
//! w = z t + B fω        t = (d1 − X d3, d2 − Y d3),   z = f|T|/Z        B as in (1), over f
//! ```
//!
//! Only the part of w across its epipolar line t tells of d and ω, and for a given d it is linear in ω.
//! Along the line z is free, but in front of the camera and within [`NEAR_AND_FAR`] of its median. So
//! directions d are tried over the half sphere, each with its best ω, and judged by how much farther from
//! the patches it is than their own surfaces:
//!
//! ```text
//! Σ weight { ((n·(w−Bfω))² − (n·(w−m))²) / nᵀCn + (tᵀC⁻¹t) (z − z')² }     n ⟂ t,  z' the nearest z allowed
//! ```
//!
//! m is the motion of the patch's surface, from which z is read. The best directions are refined, as far
//! as a [`Search`] goes. w counts as the velocity half way along it, where (1) is right to second order.

use glam::DVec3;

use super::sight::Sight;
use super::surface::Surface;
use crate::linalg::solve as solve_positive;

/// Directions tried on the half sphere.
const DIRECTIONS: usize = 60;
/// Directions whose cosine is larger, in size, are refined only once.
const ALIKE: f64 = 0.9;
/// Standard deviation of fω known beforehand, in spreads of all patches' displacements.
const TURN: f64 = 4.0;
/// z is within this factor of its median.
const NEAR_AND_FAR: f64 = 5.0;

/// A patch, as a witness of the motion of the body that its surface is on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Witness {
    /// Where it is seen half way, as a ray.
    ray: [f64; 2],
    /// Its displacement, and that of its surface, in pixels.
    motion: [f64; 2],
    own: [f64; 2],
    covariance: [f64; 3],
    /// How much it counts.
    pub weight: f64,
}

impl Witness {
    /// A patch of `surface`.
    pub fn new(sight: &Sight, surface: &Surface, focal: f64, weight: f64) -> Self {
        let own = surface.flow(sight.ray);
        Self {
            ray: [0, 1].map(|i| sight.ray[i] + 0.5 * own[i] / focal),
            motion: sight.motion,
            own,
            covariance: sight.covariance,
            weight,
        }
    }

    /// The same, in place of `count`.
    pub fn for_many(mut self, count: f64) -> Self {
        self.weight *= count;
        self
    }

    fn along(&self, d: DVec3) -> [f64; 2] {
        [d.x - self.ray[0] * d.z, d.y - self.ray[1] * d.z]
    }

    /// B: how far each component of fω moves it, u, then v.
    fn turning(&self) -> [DVec3; 2] {
        let [x, y] = self.ray;
        [
            DVec3::new(-x * y, 1.0 + x * x, -y),
            DVec3::new(-(1.0 + y * y), x * y, x),
        ]
    }
}

/// How hard the nearest motion is looked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Search {
    /// Directions that are refined.
    starts: usize,
    /// Last step of the refinement, in radians.
    finest: f64,
}

impl Search {
    /// Enough to tell whether surfaces move as one.
    pub const QUICK: Self = Self {
        starts: 1,
        finest: 0.01,
    };
    /// Enough to compare what one motion costs through one camera and through another.
    pub const THOROUGH: Self = Self {
        starts: 2,
        finest: 0.002,
    };
}

/// A rigid motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rigid {
    direction: DVec3,
    /// fω, pixels.
    turn: DVec3,
    /// z from least to greatest, pixels.
    depths: [f64; 2],
    excess: f64,
    /// −2 log of the density of ω.
    pub surprise: f64,
}

impl Rigid {
    /// The motion nearest to all `witnesses`, with or without ω; `spread` is that of displacements in
    /// pixels. `None` without a witness.
    pub fn nearest(
        witnesses: &[Witness],
        turns: bool,
        spread: f64,
        search: Search,
    ) -> Option<Self> {
        let judge = |d: DVec3| Self::along(witnesses, d.normalize(), turns, TURN * spread);
        let better = |a: &Self, b: &Self| a.excess.total_cmp(&b.excess);
        let refined = |mut best: Self| {
            let mut step = 0.5 * (2.0 * std::f64::consts::PI / DIRECTIONS as f64).sqrt();
            while step > search.finest {
                let d = best.direction;
                let (a, b) = d.any_orthonormal_pair();
                let around =
                    [a, -a, b, -b, a + b, a - b, b - a, -a - b].map(|side| d + step * side);
                match around.into_iter().filter_map(judge).min_by(better) {
                    Some(found) if found.excess < best.excess => best = found,
                    _ => step *= 0.5,
                }
            }
            best
        };
        let mut tried: Vec<Self> = half_sphere().filter_map(judge).collect();
        tried.sort_by(better);
        let mut starts: Vec<Self> = Vec::new();
        for one in tried {
            let new = |s: &Self| s.direction.dot(one.direction).abs() < ALIKE;
            if starts.len() < search.starts && starts.iter().all(new) {
                starts.push(one);
            }
        }
        starts.into_iter().map(refined).min_by(better)
    }

    /// The displacement nearest to its surface's that this motion allows a patch.
    pub fn flow(&self, witness: &Witness) -> [f64; 2] {
        let t = witness.along(self.direction);
        let b = witness.turning().map(|row| row.dot(self.turn));
        let z = self.depth(witness).clamp(self.depths[0], self.depths[1]);
        [b[0] + z * t[0], b[1] + z * t[1]]
    }

    /// z of a patch, as its surface's motion has it.
    fn depth(&self, witness: &Witness) -> f64 {
        let t = witness.along(self.direction);
        let b = witness.turning().map(|row| row.dot(self.turn));
        let pull = t[0] * (witness.own[0] - b[0]) + t[1] * (witness.own[1] - b[1]);
        // At the epipole itself z does not show.
        pull / (t[0] * t[0] + t[1] * t[1] + 1e-4)
    }

    /// Direction d with its best ω.
    fn along(witnesses: &[Witness], d: DVec3, turns: bool, turn: f64) -> Option<Self> {
        // n, and weight / nᵀCn.
        let across = |witness: &Witness| {
            let [tx, ty] = witness.along(d);
            let n = [-ty, tx];
            let [a, b, c] = witness.covariance;
            let variance = a * n[0] * n[0] + 2.0 * b * n[0] * n[1] + c * n[1] * n[1];
            (n, witness.weight / variance.max(1e-9))
        };
        let mut rigid = Self {
            direction: d,
            turn: DVec3::ZERO,
            depths: [0.0; 2],
            excess: 0.0,
            surprise: 0.0,
        };
        if turns {
            let mut matrix = [[0.0; 3]; 3];
            let mut right = [0.0; 3];
            for witness in witnesses {
                let (n, weight) = across(witness);
                let [u, v] = witness.turning();
                let row = (u * n[0] + v * n[1]).to_array();
                let r = n[0] * witness.motion[0] + n[1] * witness.motion[1];
                for i in 0..3 {
                    right[i] += weight * row[i] * r;
                    for j in 0..=i {
                        matrix[i][j] += weight * row[i] * row[j];
                    }
                }
            }
            for i in 0..3 {
                matrix[i][i] += turn.powi(-2);
            }
            rigid.turn = DVec3::from_array(solve_positive(&matrix, &right)?);
            rigid.surprise = rigid.turn.length_squared() / (turn * turn);
        }
        let mut depths: Vec<f64> = witnesses.iter().map(|w| rigid.depth(w)).collect();
        let middle = depths.len() / 2;
        if depths.is_empty() {
            return None;
        }
        let (_, &mut median, _) = depths.select_nth_unstable_by(middle, f64::total_cmp);
        // Numbers that overflow tell nothing.
        if !median.is_finite() {
            return None;
        }
        let [low, high] = [median / NEAR_AND_FAR, median * NEAR_AND_FAR];
        rigid.depths = [low.min(high), low.max(high)];
        for witness in witnesses {
            let (n, weight) = across(witness);
            let allowed = rigid.flow(witness);
            let off = |flow: [f64; 2]| {
                n[0] * (witness.motion[0] - flow[0]) + n[1] * (witness.motion[1] - flow[1])
            };
            rigid.excess += weight * (off(allowed).powi(2) - off(witness.own).powi(2));
            let z = rigid.depth(witness);
            let beyond = z - z.clamp(rigid.depths[0], rigid.depths[1]);
            if beyond != 0.0 {
                let [a, b, c] = witness.covariance;
                let [tx, ty] = witness.along(d);
                let along = (c * tx * tx - 2.0 * b * tx * ty + a * ty * ty) / (a * c - b * b);
                rigid.excess += witness.weight * along * beyond * beyond;
            }
        }
        Some(rigid)
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
