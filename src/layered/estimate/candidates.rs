//! Where to start: directions of T over the whole sphere, depth eliminated.
//!
//! The region is cut into blocks. Linearised about its planar flow w, a block keeps the moments M = Σ ω a aᵀ of
//! a = (h, r × h, e − ∇I·w). With one ρ a block, its best value is −(Tᵀ M_he)/(Tᵀ M_hh T + ε), so that the cost of a direction T
//! is a quadratic in ω alone, summed over blocks: a 3×3 system. No pixel is touched any more. The sign of ρ is free there;
//! directions for which blocks of both signs explain much are charged the lesser part.

use glam::DVec3;

use super::super::scale::Scale;
use super::normal_equations::Support;
use super::planar::PlanarFlow;
use crate::camera::turn;
use crate::linalg::{hemisphere, solve};
use crate::ordered::ordered;
use glam::DMat3;

/// Directions that are tried.
const DIRECTIONS: usize = 240;
/// Cosine of the angle from which a direction of T is another.
pub(crate) const OTHER_DIRECTION: f64 = 0.9;
/// Blocks of large and of small regions, pixels; a region is small below `SMALL` pixels.
const BLOCK: [usize; 2] = [8, 6];
const SMALL: usize = 6000;

/// A place to start from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    /// T, its length that for which mean ρ is 1.
    pub translation: DVec3,
    pub rotation: DMat3,
    cost: f64,
}

/// Moments of a block: the upper triangle of a 7×7 matrix.
type Moments = [f32; 28];

/// What the blocks of a region tell.
pub(crate) struct Blocks {
    blocks: Vec<Moments>,
    epsilon: f64,
}

impl Blocks {
    /// The moments of the pixels of `support` at `scale`, linearised about `flow`.
    pub fn gather(scale: &Scale, support: &Support, flow: &PlanarFlow) -> Self {
        let blocks = moments(scale, support, flow);
        let trace: f32 = blocks.iter().map(|m| m[at(0, 0)] + m[at(1, 1)]).sum();
        let epsilon = f64::from(1e-4 * trace) / blocks.len().max(1) as f64;
        Self { blocks, epsilon }
    }

    /// The rotation that explains most without any translation.
    pub fn rotation(&self) -> DMat3 {
        judge(&self.blocks, DVec3::ZERO, self.epsilon.max(1e-9), true).rotation
    }

    /// Up to `most` directions of T, the best first, each with the best ω, or with none unless it `turns`.
    pub fn directions(&self, most: usize, turns: bool) -> Vec<Candidate> {
        if self.blocks.is_empty() {
            return Vec::new();
        }
        let (blocks, epsilon) = (&self.blocks, self.epsilon);
        let tried: Vec<Candidate> = hemisphere(DIRECTIONS)
            .map(|direction| judge(blocks, direction, epsilon, turns))
            .collect();
        let tried = ordered(tried, |candidate| candidate.cost);
        let mut found: Vec<Candidate> = Vec::new();
        for candidate in tried {
            let direction = candidate.translation.normalize_or_zero();
            let far = |other: &Candidate| {
                other.translation.normalize_or_zero().dot(direction).abs() < OTHER_DIRECTION
            };
            if found.len() < most && found.iter().all(far) {
                found.push(candidate);
            }
        }
        for candidate in &mut found {
            *candidate = polished(blocks, *candidate, epsilon, turns);
        }
        found
    }
}

/// The candidate after a search of ever smaller steps around it.
fn polished(blocks: &[Moments], mut best: Candidate, epsilon: f64, turns: bool) -> Candidate {
    let mut step = 0.08;
    for _ in 0..5 {
        let direction = best.translation.normalize_or_zero();
        let (b, c) = direction.any_orthonormal_pair();
        let around = [b, -b, c, -c].map(|side| (direction + side * step).normalize());
        let tried = around.map(|direction| judge(blocks, direction, epsilon, turns));
        match tried.into_iter().min_by(|a, b| a.cost.total_cmp(&b.cost)) {
            Some(better) if better.cost < best.cost => best = better,
            _ => step *= 0.5,
        }
    }
    best
}

/// What a unit direction of T costs, with the best ρ for it and the best ω if it `turns`.
fn judge(blocks: &[Moments], direction: DVec3, epsilon: f64, turns: bool) -> Candidate {
    let t = direction.to_array().map(|v| v as f32);
    let epsilon = epsilon as f32;
    let mut sums = [[0.0f32; 4]; 4];
    for m in blocks {
        let (square, cross) = along(m, t);
        let inverse = 1.0 / (square + epsilon);
        for i in 0..4 {
            for j in i..4 {
                sums[i][j] += m[at(3 + i, 3 + j)] - cross[i] * cross[j] * inverse;
            }
        }
    }
    let mut a = [[0.0; 3]; 3];
    let mut b = [0.0; 3];
    for i in 0..3 {
        for j in 0..3 {
            a[i][j] = f64::from(sums[i.min(j)][i.max(j)]);
        }
        a[i][i] += 1e-6 * a[i][i] + 1.0;
        b[i] = f64::from(-sums[i][3]);
    }
    let omega = if turns {
        solve(&a, &b).unwrap_or_default()
    } else {
        [0.0; 3]
    };
    let mut cost = f64::from(sums[3][3]);
    for i in 0..3 {
        cost -= b[i] * omega[i];
    }
    let w = omega.map(|v| v as f32);
    let (mut gains, mut top, mut bottom) = ([0.0f32; 2], 0.0f32, 0.0f32);
    for m in blocks {
        let (square, cross) = along(m, t);
        let square = square + epsilon;
        let offset = cross[3] + cross[0] * w[0] + cross[1] * w[1] + cross[2] * w[2];
        gains[usize::from(offset > 0.0)] += offset * offset / square;
        top -= offset;
        bottom += square;
    }
    let rho = f64::from(top / bottom);
    let rho = if rho.abs() < 1e-5 { 1e-5 } else { rho };
    Candidate {
        translation: direction * rho,
        rotation: turn(DVec3::from_array(omega)),
        cost: cost + f64::from(gains[0].min(gains[1])),
    }
}

/// Tᵀ M_hh T, and Tᵀ M with the four other columns.
fn along(m: &Moments, t: [f32; 3]) -> (f32, [f32; 4]) {
    let product = |j: usize| (0..3).map(|i| t[i] * m[at(i, j)]).sum::<f32>();
    let square = (0..3).map(|j| product(j) * t[j]).sum();
    (square, std::array::from_fn(|j| product(3 + j)))
}

/// Where an entry of the 7×7 matrix is kept.
fn at(i: usize, j: usize) -> usize {
    let (i, j) = if i <= j { (i, j) } else { (j, i) };
    i * 7 + j - i * (i + 1) / 2
}

fn moments(scale: &Scale, support: &Support, flow: &PlanarFlow) -> Vec<Moments> {
    let window = support.window;
    let side = BLOCK[usize::from(window.width * window.height <= SMALL)];
    let columns = window.width.div_ceil(side);
    let mut blocks = vec![([0.0f32; 28], 0u32); columns * window.height.div_ceil(side)];
    let (focal, cx, cy) = (
        scale.camera.focal as f32,
        scale.camera.cx as f32,
        scale.camera.cy as f32,
    );
    let sigma = flow.sigma.max(0.7);
    let (cut, share) = (1.0 / (4.0 * sigma).powi(2), 1.0 / (sigma * sigma));
    flow.for_each(scale, support, |x, y, [e, gx, gy]| {
        let px = (x * focal + cx).round() as usize - window.left;
        let py = (y * focal + cy).round() as usize - window.top;
        let (sums, count) = &mut blocks[py / side * columns + px / side];
        let weight = share / (1.0 + e * e * cut);
        let h = [gx, gy, -(gx * x + gy * y)];
        let (u, v) = flow.at(x, y);
        let a = [
            h[0],
            h[1],
            h[2],
            y * h[2] - h[1],
            h[0] - x * h[2],
            x * h[1] - y * h[0],
            e - gx * u - gy * v,
        ];
        for i in 0..7 {
            let weighted = weight * a[i];
            for j in i..7 {
                sums[at(i, j)] += weighted * a[j];
            }
        }
        *count += 1;
    });
    let full = blocks.into_iter().filter(|(_, count)| *count >= 8);
    full.map(|(sums, _)| sums).collect()
}

#[cfg(test)]
mod tests {
    use super::super::normal_equations::tests::Made;
    use super::super::planar::Degree;
    use super::*;

    fn blocks(made: &Made) -> Blocks {
        let problem = made.problem(2);
        let mut flow = PlanarFlow::default();
        flow.fit(&made.scale, &problem.support, Degree::Plane, 6);
        Blocks::gather(&made.scale, &problem.support, &flow)
    }

    /// Degrees between the best of `found` and `truth`.
    fn nearest(found: &[Candidate], truth: DVec3) -> f64 {
        let angles = found
            .iter()
            .map(|c| c.translation.angle_between(truth).to_degrees());
        angles.fold(180.0, f64::min)
    }

    #[test]
    fn the_true_translation_is_among_the_directions() {
        for (t, w) in [
            (DVec3::new(0.03, -0.02, 0.02), DVec3::ZERO),
            (DVec3::new(0.0, 0.04, -0.03), DVec3::new(0.01, 0.0, 0.01)),
            (DVec3::new(-0.04, 0.0, 0.0), DVec3::new(0.0, 0.02, 0.0)),
            (DVec3::new(0.0, 0.0, 0.06), DVec3::new(0.0, 0.0, 0.02)),
        ] {
            let made = Made::new(80, 64, t, w);
            let found = blocks(&made).directions(5, true);
            assert!((2..=5).contains(&found.len()));
            let angle = nearest(&found, t);
            assert!(angle < 15.0, "{t}, {w}: {angle}° off");
        }
    }

    #[test]
    fn without_a_turn_only_the_translation_is_looked_for() {
        let t = DVec3::new(0.03, -0.02, 0.02);
        let made = Made::new(80, 64, t, DVec3::ZERO);
        let found = blocks(&made).directions(3, false);
        assert!(found.iter().all(|c| c.rotation == DMat3::IDENTITY));
        let best = found[0].translation;
        assert!(best.angle_between(t).to_degrees() < 8.0, "{best}");
        assert!((best.length() / t.length() - 1.0).abs() < 0.1, "{best}");
    }

    #[test]
    fn a_turn_alone_is_found() {
        let w = DVec3::new(0.01, -0.015, 0.02);
        let made = Made::new(80, 64, DVec3::ZERO, w);
        let found = crate::camera::omega(&blocks(&made).rotation());
        assert!((found - w).length() < 1e-3, "{found}");
    }
}
