//! The rigid motion that explains most of a set of matches, whatever their depths.
//!
//! A point of ray p and inverse depth ρ is seen along R p + ρ T, so its ray q in the second frame satisfies
//!
//! ```text
//! e = f T·(R p × q) / n = 0,      n² = |(T_x, T_y) − T_z π(R p)|² + |(T_x, T_y) − T_z π(q)|²
//! ```
//!
//! e is in pixels, to first order how far the match is from its epipolar line (Sampson). ρ does not occur, and |T| is 1.
//!
//! 1. Two tests come first: nothing moves, and a rotation alone explains the matches; then T = 0.
//! 2. For each of 120 directions of T the best small rotation by reweighted least squares, on some 500 matches.
//! 3. The six best directions are refined together with R by Gauss–Newton on all matches, 11 steps each; the one with
//!    the least Σ e²/(1 px² + e²) stays.
//! 4. T's sign is that for which most ρ are positive.
//!
//! Weights are 1/(1 + e²/σ²)², which ignores matches that are wrong or belong to something else that moves.

use glam::DVec3;

use super::matches::Match;
use super::rotation::rotation_alone;
use crate::camera::{Camera, RigidMotion, omega, turn};
use crate::linalg::{hemisphere, solve, tangents};
use crate::motion_model::MotionModel;
use crate::ordered::ordered;

/// Directions of T tried.
const DIRECTIONS: usize = 120;
/// Directions refined.
const REFINED: usize = 6;
/// Two directions whose cosine is above this are refined as one.
const SAME_DIRECTION: f64 = 0.95;
/// Matches used for the directions.
const SAMPLE: usize = 500;
/// Scales of the weights in pixels, one an iteration.
pub const SCALES: [f64; 4] = [8.0, 3.0, 1.5, 1.5];
/// Gauss–Newton steps.
const STEPS: usize = 11;
/// Fewest matches that determine a motion.
pub const FEWEST: usize = 12;
/// A median motion below this, in pixels, is no motion.
const STILL: f64 = 0.15;

/// A motion and how well it explains the matches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EpipolarMotion {
    /// ω in radians per frame; |T| is 1, or 0 unless the model is full.
    pub motion: RigidMotion,
    /// Which motion it is.
    pub model: MotionModel,
    /// Robust standard deviation of e in pixels.
    pub sigma: f64,
}

/// The rays of a match.
#[derive(Clone, Copy)]
pub struct Pair {
    /// In the first frame.
    pub p: DVec3,
    /// In the second.
    pub q: DVec3,
}

/// The motion between the two frames that most `matches` agree with; `None` when there are fewer than twelve.
pub fn epipolar_motion(matches: &[Match], camera: &Camera) -> Option<EpipolarMotion> {
    if matches.len() < FEWEST {
        return None;
    }
    let ray = |[x, y]: [f32; 2]| camera.ray(x.into(), y.into());
    let pairs: Vec<Pair> = matches
        .iter()
        .map(|m| Pair {
            p: ray(m.at),
            q: ray(m.to),
        })
        .collect();
    let focal = camera.focal;
    Some(without_translation(&pairs, focal).unwrap_or_else(|| full(&pairs, focal)))
}

impl EpipolarMotion {
    /// The inverse depth of a match in units in which |T| is 1: the point of its epipolar line that is nearest to where
    /// it was found. `None` where it is farther than 3σ from that line, or where T is 0.
    pub fn inverse_depth(&self, m: &Match, camera: &Camera) -> Option<f64> {
        if self.model != MotionModel::Full {
            return None;
        }
        let ray = |[x, y]: [f32; 2]| camera.ray(x.into(), y.into());
        let (p, q) = (self.motion.matrix() * ray(m.at), ray(m.to));
        let t = self.motion.translation;
        let e = t.dot(p.cross(q)) * camera.focal * inverse_norm(t, p, q);
        (e.abs() <= 3.0 * self.sigma.max(0.3)).then(|| inverse_depth(t, p, q))
    }
}

fn without_translation(pairs: &[Pair], focal: f64) -> Option<EpipolarMotion> {
    let describe = |rotation, model, middle: f64| EpipolarMotion {
        motion: RigidMotion {
            translation: DVec3::ZERO,
            rotation,
        },
        model,
        sigma: 1.4826 * middle,
    };
    let lengths = pairs.iter().map(|pair| (pair.q - pair.p).length() * focal);
    let length = median(lengths.collect());
    if length < STILL {
        return Some(describe(DVec3::ZERO, MotionModel::Still, length));
    }
    let (rotation, left) = rotation_alone(pairs, focal);
    (left < STILL).then(|| describe(rotation, MotionModel::Rotation, left))
}

fn full(pairs: &[Pair], focal: f64) -> EpipolarMotion {
    let stride = (pairs.len() / SAMPLE).max(1);
    let sample: Vec<Pair> = pairs.iter().copied().step_by(stride).collect();
    let tried: Vec<Start> = hemisphere(DIRECTIONS)
        .map(|t| Start::along(t, &sample, focal))
        .collect();
    let tried = ordered(tried, |start| start.cost);
    let mut starts: Vec<Start> = Vec::with_capacity(REFINED);
    for start in tried {
        let new = |s: &Start| s.translation.dot(start.translation).abs() < SAME_DIRECTION;
        if starts.len() < REFINED && starts.iter().all(new) {
            starts.push(start);
        }
    }
    let refined = starts.iter().map(|s| refined(s, pairs, focal));
    let (_, mut best) = refined
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .expect("at least one direction");
    let (t, rotation) = (best.motion.translation, best.motion.matrix());
    let ahead = |pair: &&Pair| inverse_depth(t, rotation * pair.p, pair.q) > 0.0;
    if pairs.iter().filter(ahead).count() * 2 < pairs.len() {
        best.motion.translation = -t;
    }
    best
}

/// A direction of T with its best small rotation.
struct Start {
    cost: f64,
    translation: DVec3,
    rotation: DVec3,
}

impl Start {
    fn along(translation: DVec3, pairs: &[Pair], focal: f64) -> Self {
        // e is linear in a small rotation: e = r + c·ω.
        let rows: Vec<(DVec3, f64)> = pairs
            .iter()
            .map(|&Pair { p, q }| {
                let scale = focal * inverse_norm(translation, p, q);
                let c = p.cross(q.cross(translation)) * scale;
                (c, translation.dot(p.cross(q)) * scale)
            })
            .collect();
        let mut rotation = DVec3::ZERO;
        for scale in SCALES {
            let mut normal = [[0.0; 3]; 3];
            let mut right = [0.0; 3];
            let inverse = 1.0 / (scale * scale);
            for &(c, r) in &rows {
                let e = r + c.dot(rotation);
                let weight = 1.0 / (1.0 + e * e * inverse);
                let weighted = c * (weight * weight);
                let c = c.to_array();
                for (k, w) in weighted.to_array().into_iter().enumerate() {
                    for l in 0..=k {
                        normal[k][l] += w * c[l];
                    }
                    right[k] -= w * r;
                }
            }
            for (k, row) in normal.iter_mut().enumerate() {
                row[k] += 1e-3 * rows.len() as f64;
            }
            if let Some(found) = solve(&normal, &right) {
                rotation = DVec3::from_array(found);
            }
        }
        let last = SCALES[SCALES.len() - 1];
        let cost = rows.iter().map(|&(c, r)| {
            let z = ((r + c.dot(rotation)) / last).powi(2);
            z / (1.0 + z)
        });
        Self {
            cost: cost.sum(),
            translation,
            rotation,
        }
    }
}

/// The minimum near a start, and what it costs.
fn refined(start: &Start, pairs: &[Pair], focal: f64) -> (f64, EpipolarMotion) {
    let mut t = start.translation;
    let mut rotation = turn(start.rotation);
    let mut sigma = 1.5;
    let mut errors = vec![0.0; pairs.len()];
    for step in 0..=STEPS {
        let bases = tangents(t);
        let mut normal = [[0.0; 5]; 5];
        let mut right = [0.0; 5];
        let inverse = 1.0 / (sigma * sigma);
        for (pair, error) in pairs.iter().zip(&mut errors) {
            let (p, q) = (rotation * pair.p, pair.q);
            let scale = focal * inverse_norm(t, p, q);
            let across = p.cross(q) * scale;
            let e = t.dot(across);
            *error = e.abs();
            let turn = p.cross(q.cross(t)) * scale;
            let j = [
                bases[0].dot(across),
                bases[1].dot(across),
                turn.x,
                turn.y,
                turn.z,
            ];
            let weight = (1.0 + e * e * inverse).powi(-2);
            for k in 0..5 {
                let w = weight * j[k];
                for l in 0..=k {
                    normal[k][l] += w * j[l];
                }
                right[k] -= w * e;
            }
        }
        if step == STEPS {
            break;
        }
        sigma = (2.0 * 1.4826 * median(errors.clone())).clamp(0.1, 2.0);
        for (k, row) in normal.iter_mut().enumerate() {
            row[k] = row[k] * 1.0001 + 1e-6;
        }
        if let Some([a, b, x, y, z]) = solve(&normal, &right) {
            t = (t + bases[0] * a + bases[1] * b).normalize();
            rotation = turn(DVec3::new(x, y, z)) * rotation;
        }
    }
    let cost = errors.iter().map(|e| e * e / (1.0 + e * e)).sum();
    let found = EpipolarMotion {
        motion: RigidMotion {
            translation: t,
            rotation: omega(&rotation),
        },
        model: MotionModel::Full,
        sigma: 1.4826 * median(errors),
    };
    (cost, found)
}

/// 1/n.
fn inverse_norm(t: DVec3, p: DVec3, q: DVec3) -> f64 {
    let (a, b) = (t.x - t.z * p.x, t.y - t.z * p.y);
    let (c, d) = (t.x - t.z * q.x, t.y - t.z * q.y);
    (a * a + b * b + c * c + d * d + 1e-6).sqrt().recip()
}

/// The ρ for which p + ρ t is nearest to the ray q.
fn inverse_depth(t: DVec3, p: DVec3, q: DVec3) -> f64 {
    let across = q.cross(t);
    -q.cross(p).dot(across) / across.length_squared().max(1e-12)
}

/// The middle value; 0 of none.
pub fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    match values.is_empty() {
        true => 0.0,
        false => *values.select_nth_unstable_by(middle, f64::total_cmp).1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAMERA: Camera = Camera {
        focal: 300.0,
        cx: 159.5,
        cy: 119.5,
    };

    /// Matches of a bumpy scene under `motion`, every `bad`-th of them wrong.
    fn scene(motion: &RigidMotion, bad: usize) -> (Vec<Match>, Vec<f64>) {
        let mut list = Vec::new();
        let mut depths = Vec::new();
        for k in 0..1200 {
            let (x, y) = ((k % 40) as f64 * 8.0, (k / 40) as f64 * 8.0);
            let rho = 1.0 + 0.5 * (0.05 * x).sin() + 0.4 * (0.07 * y).cos();
            let (mut u, mut v) = CAMERA.displacement(motion, x, y, rho).unwrap();
            if k % bad == 0 {
                (u, v) = ((k % 17) as f64 - 8.0, (k % 13) as f64 - 6.0);
            }
            list.push(Match {
                at: [x as f32, y as f32],
                to: [(x + u) as f32, (y + v) as f32],
                tensor: [1.0, 0.0, 1.0],
                residual: 1.0,
            });
            depths.push(rho);
        }
        (list, depths)
    }

    #[test]
    fn recovers_motion_and_depth_among_wrong_matches() {
        for translation in [
            DVec3::new(0.02, 0.004, -0.01),
            DVec3::new(-0.003, 0.002, 0.03),
            DVec3::new(0.0, -0.015, 0.001),
        ] {
            let motion = RigidMotion {
                translation,
                rotation: DVec3::new(0.004, -0.01, 0.006),
            };
            let (list, depths) = scene(&motion, 6);
            let found = epipolar_motion(&list, &CAMERA).unwrap();
            assert_eq!(found.model, MotionModel::Full);
            let cosine = found.motion.translation.dot(translation.normalize());
            assert!(cosine > 0.9999, "{cosine}");
            assert!((found.motion.rotation - motion.rotation).length() < 2e-4);
            for (k, (m, rho)) in list.iter().zip(&depths).enumerate() {
                if k % 6 != 0 {
                    let z = found.inverse_depth(m, &CAMERA).unwrap() / translation.length();
                    assert!(
                        (z - rho).abs() < 0.05 || (z / rho - 1.0).abs() < 0.1,
                        "{z} {rho}"
                    );
                }
            }
        }
    }

    #[test]
    fn knows_rest_and_rotation() {
        let mut motion = RigidMotion::default();
        let still = epipolar_motion(&scene(&motion, 7).0, &CAMERA).unwrap();
        assert_eq!(still.model, MotionModel::Still);
        motion.rotation = DVec3::new(0.01, 0.02, -0.03);
        let turn = epipolar_motion(&scene(&motion, 7).0, &CAMERA).unwrap();
        assert_eq!(turn.model, MotionModel::Rotation);
        assert!((turn.motion.rotation - motion.rotation).length() < 1e-5);
    }

    #[test]
    fn needs_a_dozen_matches() {
        let few = &scene(&RigidMotion::default(), 7).0[..11];
        assert_eq!(epipolar_motion(few, &CAMERA), None);
    }
}
