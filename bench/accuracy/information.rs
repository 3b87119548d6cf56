//! What the pixels of a region tell of its depth and its T at best.
//!
//! With r ≈ a δρ + b·δm + noise of variance σ² at each pixel, m = (T, ω), and ρ a quadratic in the pixel's place whose
//! mean is held, δρ = c·q, no unbiased estimate of (m, c) has a smaller covariance than
//!
//! ```text
//! C = σ² ( Σ j jᵀ )⁻¹,   j = (b, a q)           (Cramér 1946, Rao 1945)
//! ```
//!
//! A surface that may be more than a quadratic, or a solver that has to find outlines and light as well, does worse.

use glam::DVec3;
use relievo::RigidMotion;
use relievo::motion::solve_positive;
use relievo::warp::Row;

/// Components of q, and of j.
const TERMS: usize = 5;
const FREE: usize = 6 + TERMS;

/// A pixel of the region: the derivatives of its residual, and its place in pixels.
pub type Pixel = (Row, [f64; 2]);

/// Errors that no unbiased estimate stays below on average.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtBest {
    /// Mean |δρ| of normal errors, ρ being 1 in the mean.
    pub depth: f64,
    /// Root mean square of the angle between T and its estimate, in degrees.
    pub heading: f64,
}

/// What `pixels` in noise of `sigma` grey levels tell of a region that moves by `motion`, T in units in which its mean
/// ρ is 1, and of which it is known whether it `turns`. None where they leave something open altogether.
pub fn at_best(pixels: &[Pixel], sigma: f64, motion: &RigidMotion, turns: bool) -> Option<AtBest> {
    let terms = quadratics(pixels);
    let mut information = [[0.0; FREE]; FREE];
    for ((row, _), q) in pixels.iter().zip(&terms) {
        let mut j = [0.0; FREE];
        for (j, d) in j.iter_mut().zip(&row[1..7]) {
            *j = f64::from(*d);
        }
        if !turns {
            j[3..6].fill(0.0);
        }
        for (j, q) in j[6..].iter_mut().zip(q) {
            *j = f64::from(row[0]) * q;
        }
        for (row, a) in information.iter_mut().zip(&j) {
            for (sum, b) in row.iter_mut().zip(&j) {
                *sum += a * b / (sigma * sigma);
            }
        }
    }
    if !turns {
        // What is known becomes an equation of its own.
        (3..6).for_each(|i| information[i][i] = 1.0);
    }
    let mut covariance = [[0.0; FREE]; FREE];
    for (i, column) in covariance.iter_mut().enumerate() {
        let unit = std::array::from_fn(|j| f64::from(u8::from(i == j)));
        *column = solve_positive(&information, &unit)?;
    }
    let along = motion.translation.try_normalize()?;
    let across = along.any_orthonormal_pair();
    let variance = |d: DVec3| quadratic_form::<3>(&covariance, 0, &d.to_array());
    let heading = (variance(across.0) + variance(across.1)).sqrt() / motion.translation.length();
    let spread = |q: &[f64; TERMS]| quadratic_form(&covariance, 6, q).sqrt();
    let depth = terms.iter().map(spread).sum::<f64>() / terms.len() as f64;
    Some(AtBest {
        depth: depth * std::f64::consts::FRAC_2_PI.sqrt(),
        heading: heading.to_degrees(),
    })
}

/// q of every pixel: x, y, x², xy, y², each with mean 0.
fn quadratics(pixels: &[Pixel]) -> Vec<[f64; TERMS]> {
    let n = pixels.len().max(1) as f64;
    let middle = [0, 1].map(|i| pixels.iter().map(|(_, at)| at[i]).sum::<f64>() / n);
    let raw = |at: &[f64; 2]| {
        let [x, y] = [at[0] - middle[0], at[1] - middle[1]];
        [x, y, x * x, x * y, y * y]
    };
    let mut terms: Vec<[f64; TERMS]> = pixels.iter().map(|(_, at)| raw(at)).collect();
    for i in 0..TERMS {
        let mean = terms.iter().map(|q| q[i]).sum::<f64>() / n;
        terms.iter_mut().for_each(|q| q[i] -= mean);
    }
    terms
}

/// dᵀ C d, where d has to do with the components from `from` on.
fn quadratic_form<const N: usize>(c: &[[f64; FREE]; FREE], from: usize, d: &[f64; N]) -> f64 {
    let row = |i: usize| (0..N).map(|j| c[from + i][from + j] * d[j]).sum::<f64>();
    (0..N).map(|i| d[i] * row(i)).sum::<f64>().max(0.0)
}
