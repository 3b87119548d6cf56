//! The motions that most patches agree on: of the whole frame, and of those inside a curve that neither the
//! background nor, if possible, another curve's motion explains.
//!
//! A motion is taken for flat here (ρ = 1), so that its displacement is linear in (T, ω) by (1). Samples
//! of patches propose motions, all patches judge them by Σ min(e², τ²), e² = (w−ŵ)ᵀ P (w−ŵ) with P the
//! patch's precision, and the best is fitted to those that agree (RANSAC, Fischler and Bolles 1981). The
//! samples are the same at every call.

use glam::DVec3;

use super::patches::Patch;
use crate::camera::{Camera, RigidMotion};
use crate::linalg::solve as solve_positive;

/// τ², squared standard deviations beyond which a patch does not agree.
const DISAGREES: f64 = 9.0;
/// No patch is known better than this, in pixels: flat motion is only an approximation.
const KNOWN: f64 = 0.15;
/// Motions proposed for the background.
const PROPOSALS: usize = 300;
/// Standard deviation of f·ω known beforehand, in pixels: of the frame's motion and of a small region's.
const ROTATION: [f64; 2] = [20.0, 1.0];
/// What a patch counts that another curve's motion explains: each curve is on a thing of its own, though
/// it may lie half on another's.
const SHARED: f64 = 0.25;
/// Rounds of fitting to those that agree.
const ROUNDS: usize = 4;

/// The motion that explains most of the patches, with weights.
pub fn dominant(camera: &Camera, patches: &[Patch], weight: &[f64]) -> RigidMotion {
    let cost = |motion: &RigidMotion| -> f64 {
        let each = patches.iter().zip(weight);
        each.map(|(p, w)| w * error(camera, motion, p).min(DISAGREES))
            .sum()
    };
    let mut best = (RigidMotion::default(), cost(&RigidMotion::default()));
    let mut random = 1u64;
    for _ in 0..PROPOSALS {
        let sample: [Patch; 3] = std::array::from_fn(|_| {
            random = random
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            patches[(random >> 33) as usize % patches.len()]
        });
        if let Some(motion) = fit(camera, &sample, &[1.0; 3], ROTATION[0]) {
            let found = cost(&motion);
            if found < best.1 {
                best = (motion, found);
            }
        }
    }
    settle(camera, patches, weight, best.0, ROTATION[0])
}

/// The motion that best explains what `background` leaves unexplained among the weighted patches;
/// `background` itself when nothing is left. `others` are motions of other curves, or what is taken for
/// them: what they explain counts a quarter.
pub fn inside(
    camera: &Camera,
    patches: &[Patch],
    weight: &[f64],
    background: &RigidMotion,
    others: &[RigidMotion],
) -> RigidMotion {
    let within: Vec<Claim> = patches
        .iter()
        .zip(weight)
        .filter(|(_, weight)| **weight > 0.0)
        .map(|(patch, &weight)| {
            let known = error(camera, background, patch).min(DISAGREES);
            let errors = others.iter().map(|motion| error(camera, motion, patch));
            Claim {
                patch: *patch,
                weight,
                known,
                elsewhere: (known - errors.fold(known, f64::min)).max(0.0),
            }
        })
        .collect();
    let gain = |motion: &RigidMotion| -> f64 {
        let each = within.iter();
        each.map(|claim| claim.worth(error(camera, motion, &claim.patch)))
            .sum()
    };
    let mut best = (*background, 0.0);
    for claim in &within {
        if let Some(motion) = fit(camera, &[claim.patch], &[1.0], ROTATION[1]) {
            let found = gain(&motion);
            if found > best.1 {
                best = (motion, found);
            }
        }
    }
    // What the background explains as well is not this region's to fit.
    let own = within.iter().map(|claim| {
        let better = error(camera, &best.0, &claim.patch) < claim.known;
        if better { claim.weight } else { 0.0 }
    });
    let own: Vec<f64> = own.collect();
    let patches: Vec<Patch> = within.iter().map(|claim| claim.patch).collect();
    settle(camera, &patches, &own, best.0, ROTATION[1])
}

/// A patch inside a curve.
struct Claim {
    patch: Patch,
    weight: f64,
    /// Its error under the background's motion.
    known: f64,
    /// How much less it is under another curve's.
    elsewhere: f64,
}

impl Claim {
    /// What it is worth to a motion under which its error is `error`.
    fn worth(&self, error: f64) -> f64 {
        let gain = (self.known - error).max(0.0);
        self.weight * (gain - (1.0 - SHARED) * gain.min(self.elsewhere))
    }
}

fn settle(
    camera: &Camera,
    patches: &[Patch],
    weight: &[f64],
    mut motion: RigidMotion,
    rotation: f64,
) -> RigidMotion {
    for _ in 0..ROUNDS {
        let agrees: Vec<f64> = patches
            .iter()
            .zip(weight)
            .map(|(p, w)| w / (1.0 + error(camera, &motion, p) / DISAGREES).powi(2))
            .collect();
        motion = fit(camera, patches, &agrees, rotation).unwrap_or(motion);
    }
    motion
}

/// (w−ŵ)ᵀ P (w−ŵ), P limited to what flat motion can know.
fn error(camera: &Camera, motion: &RigidMotion, patch: &Patch) -> f64 {
    let (u, v) = camera.image_motion(motion, f64::from(patch.x), f64::from(patch.y), 1.0);
    let (du, dv) = (
        f64::from(patch.motion[0]) - u,
        f64::from(patch.motion[1]) - v,
    );
    let [a, b, c] = limited(patch);
    a * du * du + 2.0 * b * du * dv + c * dv * dv
}

/// (P⁻¹ + known² I)⁻¹.
fn limited(patch: &Patch) -> [f64; 3] {
    let [a, b, c] = patch.precision.map(f64::from);
    let det = a * c - b * b;
    let floor = KNOWN * KNOWN;
    let [p, q, r] = [c / det + floor, -b / det, a / det + floor];
    let det = p * r - q * q;
    [r / det, -q / det, p / det]
}

/// The flat motion nearest to the patches; `None` when none of them counts.
fn fit(camera: &Camera, patches: &[Patch], weight: &[f64], rotation: f64) -> Option<RigidMotion> {
    if weight.iter().all(|w| *w <= 0.0) {
        return None;
    }
    let f = camera.focal;
    let mut normal = [[0.0; 6]; 6];
    let mut right = [0.0; 6];
    for (patch, &w) in patches.iter().zip(weight) {
        if w <= 0.0 {
            continue;
        }
        let (x, y) = (
            f64::from(patch.x) - camera.cx,
            f64::from(patch.y) - camera.cy,
        );
        let u = [f, 0.0, -x, -x * y / f, f + x * x / f, -y];
        let v = [0.0, f, -y, -f - y * y / f, x * y / f, x];
        let [a, b, c] = limited(patch).map(|p| w * p);
        let [mu, mv] = patch.motion.map(f64::from);
        for i in 0..6 {
            let (pu, pv) = (a * u[i] + b * v[i], b * u[i] + c * v[i]);
            right[i] += pu * mu + pv * mv;
            for j in 0..=i {
                normal[i][j] += pu * u[j] + pv * v[j];
            }
        }
    }
    let prior = (f / rotation).powi(2);
    for i in 0..3 {
        // T is told from ω by no more than its prior: any flat motion within 1000 px is as likely.
        normal[i][i] += 1e-6 * f * f;
        normal[3 + i][3 + i] += prior;
    }
    let x = solve_positive(&normal, &right)?;
    Some(RigidMotion {
        translation: DVec3::new(x[0], x[1], x[2]),
        rotation: DVec3::new(x[3], x[4], x[5]),
    })
}
