//! The motions that most patches agree on: of the whole frame, and of those inside a curve that the
//! background does not explain.
//!
//! A motion is taken for flat here (ρ = 1), so that its displacement is linear in (T, ω) by (1). Samples
//! of patches propose motions, all patches judge them by Σ min(e², τ²), e² = (w−ŵ)ᵀ P (w−ŵ) with P the
//! patch's precision, and the best is fitted to those that agree (RANSAC, Fischler and Bolles 1981). The
//! samples are the same at every call.

use glam::DVec3;

use super::patches::Patch;
use crate::camera::{Camera, RigidMotion};
use crate::motion::solve_positive;

/// τ², squared standard deviations beyond which a patch does not agree.
const DISAGREES: f64 = 9.0;
/// No patch is known better than this, in pixels: flat motion is only an approximation.
const KNOWN: f64 = 0.15;
/// Motions proposed for the background.
const PROPOSALS: usize = 300;
/// Standard deviation of f·ω known beforehand, in pixels: of the frame's motion and of a small region's.
const ROTATION: [f64; 2] = [20.0, 1.0];
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
/// `background` itself when nothing is left.
pub fn inside(
    camera: &Camera,
    patches: &[Patch],
    weight: &[f64],
    background: &RigidMotion,
) -> RigidMotion {
    let known: Vec<f64> = patches
        .iter()
        .map(|p| error(camera, background, p).min(DISAGREES))
        .collect();
    let gain = |motion: &RigidMotion| -> f64 {
        let each = patches.iter().zip(weight).zip(&known);
        each.map(|((p, w), known)| w * (known - error(camera, motion, p)).max(0.0))
            .sum()
    };
    let mut best = (*background, 0.0);
    for (patch, &w) in patches.iter().zip(weight) {
        if w <= 0.0 {
            continue;
        }
        if let Some(motion) = fit(camera, &[*patch], &[1.0], ROTATION[1]) {
            let found = gain(&motion);
            if found > best.1 {
                best = (motion, found);
            }
        }
    }
    // What the background explains as well is not this region's to fit.
    let own: Vec<f64> = patches
        .iter()
        .zip(weight)
        .zip(&known)
        .map(|((p, w), known)| {
            if error(camera, &best.0, p) < *known {
                *w
            } else {
                0.0
            }
        })
        .collect();
    settle(camera, patches, &own, best.0, ROTATION[1])
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
