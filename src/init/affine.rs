//! Affine flow by weighted least squares, from sums that add up: what two sets of matches have in common is found
//! without going through them again.
//!
//! ```text
//! d(x) = d₀ + A (x − m)/100,     χ² = min Σ (d(x_i) − d_i)ᵀ W_i (d(x_i) − d_i) + Σ a²/S²
//! ```
//!
//! W is the inverse covariance of a match, m the middle of the frame, a an entry of A and S [`SLOPE`]. Pixels.

use glam::DVec2;

use super::sample::Sample;
use crate::linalg::solve;

/// Pixels at which A is stated.
const FAR: f64 = 100.0;
/// S: flow seldom changes by more, in pixels over 100.
const SLOPE: f64 = 15.0;
/// What keeps a flow of no weight at all determined, 1/px².
const FLOOR: f64 = 1e-6;

/// The sums over a set of matches.
#[derive(Clone, Copy, Debug, Default)]
pub struct Moments {
    /// How many matches.
    pub count: usize,
    /// Σ W ⊗ φ φᵀ with φ = (1, x, y): for each of xx, xy, yy of W the products 11, x1, xx, y1, yx, yy.
    normal: [[f64; 6]; 3],
    /// Σ φ ⊗ W d, for u, then v.
    right: [f64; 6],
    /// Σ dᵀ W d.
    square: f64,
}

/// A flow, and χ² of the matches that it was found from.
#[derive(Clone, Copy, Debug)]
pub struct Affine {
    /// 1, x, y of u, then of v.
    parts: [f64; 6],
    /// χ².
    pub misfit: f64,
}

/// (x − m)/100.
fn basis(at: DVec2, middle: DVec2) -> [f64; 3] {
    let x = (at - middle) / FAR;
    [1.0, x.x, x.y]
}

impl Moments {
    /// Of one match.
    pub fn of(sample: &Sample, middle: DVec2) -> Self {
        let phi = basis(sample.at(), middle);
        let d = sample.displacement();
        let [xx, xy, yy] = sample.weight;
        let (u, v) = (xx * d.x + xy * d.y, xy * d.x + yy * d.y);
        let mut products = [0.0; 6];
        let mut n = 0;
        for a in 0..3 {
            for b in 0..=a {
                products[n] = phi[a] * phi[b];
                n += 1;
            }
        }
        Self {
            count: 1,
            normal: sample.weight.map(|w| products.map(|p| w * p)),
            right: std::array::from_fn(|k| phi[k % 3] * if k < 3 { u } else { v }),
            square: d.x * u + d.y * v,
        }
    }

    /// Of both sets.
    pub fn with(&self, other: &Self) -> Self {
        let mut sum = *self;
        sum.count += other.count;
        for (own, more) in sum.normal.iter_mut().zip(&other.normal) {
            own.iter_mut().zip(more).for_each(|(a, b)| *a += b);
        }
        sum.right
            .iter_mut()
            .zip(&other.right)
            .for_each(|(a, b)| *a += b);
        sum.square += other.square;
        sum
    }

    /// The variance of the flow at a pixel, px², were matches independent: the greater of u's and v's.
    pub fn variance(&self, at: DVec2, middle: DVec2) -> f64 {
        let [one, x, y] = basis(at, middle);
        let matrix = self.matrix();
        [0, 3]
            .map(|first| {
                let mut row = [0.0; 6];
                row[first..first + 3].copy_from_slice(&[one, x, y]);
                let inverse = solve(&matrix, &row).unwrap_or([f64::INFINITY; 6]);
                row.iter()
                    .zip(&inverse)
                    .map(|(a, b)| if *a == 0.0 { 0.0 } else { a * b })
                    .sum()
            })
            .into_iter()
            .fold(0.0, f64::max)
    }

    /// The flow that fits best.
    pub fn fit(&self) -> Affine {
        let parts = solve(&self.matrix(), &self.right).unwrap_or_default();
        let explained: f64 = parts.iter().zip(&self.right).map(|(a, b)| a * b).sum();
        Affine {
            parts,
            misfit: (self.square - explained).max(0.0),
        }
    }

    fn matrix(&self) -> [[f64; 6]; 6] {
        let mut matrix = [[0.0; 6]; 6];
        let place = |a: usize, b: usize| (a * (a + 1)) / 2 + b;
        for a in 0..3 {
            for b in 0..3 {
                let p = place(a.max(b), a.min(b));
                matrix[a][b] = self.normal[0][p];
                matrix[3 + a][b] = self.normal[1][p];
                matrix[3 + a][3 + b] = self.normal[2][p];
            }
        }
        for k in 0..6 {
            matrix[k][k] += if k % 3 == 0 {
                FLOOR
            } else {
                1.0 / (SLOPE * SLOPE)
            };
        }
        matrix
    }
}

impl Affine {
    /// The displacement at a pixel.
    pub fn displacement(&self, at: DVec2, middle: DVec2) -> DVec2 {
        let [_, x, y] = basis(at, middle);
        let p = &self.parts;
        DVec2::new(p[0] + p[1] * x + p[2] * y, p[3] + p[4] * x + p[5] * y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::init::matches::Match;

    const MIDDLE: DVec2 = DVec2::new(80.0, 60.0);

    /// An exact match of d = (1, −2) + A (x − m)/100 at (x, y).
    fn sample(x: f32, y: f32) -> Sample {
        let (p, q) = ((x - 80.0) / 100.0, (y - 60.0) / 100.0);
        let matched = Match {
            at: [x, y],
            to: [x + 1.0 + 3.0 * p - q, y - 2.0 + 0.5 * p + 2.0 * q],
            tensor: [4000.0, 300.0, 2500.0],
            residual: 1.0,
        };
        Sample::new(matched, &Camera::centred(160.0, 160, 120).unwrap())
    }

    fn sum(samples: &[Sample]) -> Moments {
        samples.iter().fold(Moments::default(), |sum, sample| {
            sum.with(&Moments::of(sample, MIDDLE))
        })
    }

    #[test]
    fn sums_over_parts_are_those_of_the_whole_and_give_the_flow() {
        let samples: Vec<Sample> = (0..60)
            .map(|k| sample((k % 10 * 15) as f32, (k / 10 * 20) as f32))
            .collect();
        let whole = sum(&samples);
        let parts = sum(&samples[..23]).with(&sum(&samples[23..]));
        assert_eq!(whole.count, parts.count);
        let (flow, same) = (whole.fit(), parts.fit());
        // Slopes are held back a little.
        assert!(flow.misfit < 1.0, "{}", flow.misfit);
        for sample in &samples {
            let found = flow.displacement(sample.at(), MIDDLE);
            assert!((found - sample.displacement()).length() < 0.05);
            assert!((found - same.displacement(sample.at(), MIDDLE)).length() < 1e-9);
        }
    }

    #[test]
    fn the_more_matches_the_surer_and_farther_away_the_less() {
        let row = |n: usize| {
            sum(&(0..n)
                .map(|k| sample(4.0 * k as f32, 60.0))
                .collect::<Vec<_>>())
        };
        let at = DVec2::new(10.0, 60.0);
        assert!(row(20).variance(at, MIDDLE) < row(6).variance(at, MIDDLE));
        let far = DVec2::new(10.0, 20.0);
        assert!(row(20).variance(far, MIDDLE) > 4.0 * row(20).variance(at, MIDDLE));
    }
}
