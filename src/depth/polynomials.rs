//! Polynomial surfaces of inverse depth: the part of a region's ρ that smoothness does not act on.
//!
//! ```text
//! ρ = ρ̄ + Σ_k q_k b_k + d,     Σ w b_k = 0,  Σ w b_j b_k = δ_jk Σ w,  Σ w d = Σ w d b_k = 0     (sums over the region)
//! ```
//!
//! b_1 … b_n span the polynomials in a pixel's place up to some degree, less the constant, and have no unit; d is
//! what departs from them. Two views hardly tell a deep relief that turns little from a shallow one that turns much.
//! Smoothness of all of ρ would therefore press bodies flat and turn their T; where it acts on d alone, the nine cubics
//! of a region are too few to follow noise, and κ (`region_field.rs`) is enough to keep them from growing where nothing
//! shows them. Quadratics cost nothing about their own slope (`bends.rs`) either, but only once what is expected has
//! followed, step by step: taken as they are, they let relief change with T and ω at once. Beyond [`REACH`] extents
//! of the region its surface goes on level along that way.

use crate::grid::Grid;

/// Pixels that a region has at least, to tell nine numbers.
const FEWEST: usize = 400;
/// Standard deviations of the region's pixels from their mean, along x and along y.
const REACH: f64 = 2.5;
/// The square of what is new in a polynomial, as a share of its own: with less it tells the region nothing new.
const NEW: f64 = 1e-6;

/// The polynomials over a region.
#[derive(Clone, Debug)]
pub struct Polynomials {
    weight: Grid<f32>,
    /// Σ w.
    total: f64,
    terms: Vec<Grid<f32>>,
}

impl Polynomials {
    /// How many b there are at most: cubics.
    pub const TERMS: usize = 9;

    /// The polynomials of `degree`, 1 to 3, and below over the region whose pixels have a `weight` over 0; none where they
    /// are fewer than 400.
    pub fn over(weight: &Grid<f32>, degree: i32) -> Option<Self> {
        let (width, height) = (weight.width(), weight.height());
        let (mut pixels, mut total) = (0, 0.0);
        let (mut mean, mut square) = ([0.0; 2], [0.0; 2]);
        for y in 0..height {
            for (x, &w) in weight.row(y).iter().enumerate() {
                let w = f64::from(w);
                pixels += usize::from(w > 0.0);
                total += w;
                for (axis, v) in [x as f64, y as f64].into_iter().enumerate() {
                    mean[axis] += w * v;
                    square[axis] += w * v * v;
                }
            }
        }
        if pixels < FEWEST {
            return None;
        }
        let mean = mean.map(|sum| sum / total);
        let along = |axis: usize, v: usize| {
            let spread = (square[axis] / total - mean[axis] * mean[axis]).sqrt();
            ((v as f64 - mean[axis]) / spread.max(1.0)).clamp(-REACH, REACH)
        };
        let columns: Vec<f64> = (0..width).map(|x| along(0, x)).collect();
        let rows: Vec<f64> = (0..height).map(|y| along(1, y)).collect();
        let mut all = Self {
            weight: weight.clone(),
            total,
            terms: Vec::with_capacity(Self::TERMS),
        };
        for degree in 1..=degree.min(3) {
            for of_y in 0..=degree {
                all.add(Grid::from_fn(width, height, |x, y| {
                    (columns[x].powi(degree - of_y) * rows[y].powi(of_y)) as f32
                }));
            }
        }
        Some(all)
    }

    /// Adds what is new in a polynomial (Gram and Schmidt).
    fn add(&mut self, polynomial: Grid<f32>) {
        let mut new = self.departure(&polynomial);
        let mean = self.sum(new.data().iter().copied()) / self.total;
        new.data_mut().iter_mut().for_each(|v| *v -= mean as f32);
        let square = |of: &Grid<f32>| self.sum(of.data().iter().map(|v| v * v));
        let left = square(&new);
        if left > NEW * square(&polynomial) {
            let scale = (self.total / left).sqrt() as f32;
            self.terms.push(new.map(|v| scale * v));
        }
    }

    /// b.
    pub fn terms(&self) -> &[Grid<f32>] {
        &self.terms
    }

    /// ρ̄ + d: what is left of `rho` without the b.
    pub fn departure(&self, rho: &Grid<f32>) -> Grid<f32> {
        let mut rest = rho.clone();
        for term in &self.terms {
            let products = rho.data().iter().zip(term.data()).map(|(r, b)| r * b);
            let share = (self.sum(products) / self.total) as f32;
            for (r, b) in rest.data_mut().iter_mut().zip(term.data()) {
                *r -= share * b;
            }
        }
        rest
    }

    /// Σ w v.
    fn sum(&self, each: impl Iterator<Item = f32>) -> f64 {
        let weighed = self.weight.data().iter().zip(each);
        weighed.map(|(w, v)| f64::from(*w) * f64::from(v)).sum()
    }
}
