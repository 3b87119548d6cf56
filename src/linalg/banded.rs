//! Symmetric positive definite systems whose entries lie near the diagonal, by Cholesky's factorisation.
//!
//! ```text
//! A = L Lᵀ,   a_ij = 0 where |i − j| > bandwidth
//! ```
//!
//! in n · bandwidth² operations. Each row is stored from its first entry to its diagonal, so that the inner loop is a
//! dot product of two runs of memory.

use wide::f32x8;

/// A symmetric matrix of which the lower band is kept, then its factor.
#[derive(Clone, Default)]
pub(crate) struct Banded {
    size: usize,
    bandwidth: usize,
    /// Row i holds columns i − bandwidth to i.
    rows: Vec<f32>,
}

impl Banded {
    /// Makes it a zero matrix of that size; memory is used again.
    pub fn clear(&mut self, size: usize, bandwidth: usize) {
        self.size = size;
        self.bandwidth = bandwidth;
        self.rows.clear();
        self.rows.resize(size * (bandwidth + 1), 0.0);
    }

    /// Adds to a_ij, and so to a_ji; |i − j| must not exceed the bandwidth.
    #[inline]
    pub fn add(&mut self, i: usize, j: usize, value: f32) {
        let (low, high) = (i.max(j), i.min(j));
        self.rows[low * (self.bandwidth + 1) + self.bandwidth - (low - high)] += value;
    }

    /// Adds to a diagonal entry a share of itself and a constant.
    pub fn stiffen(&mut self, i: usize, share: f32, constant: f32) {
        let at = i * (self.bandwidth + 1) + self.bandwidth;
        self.rows[at] += share * self.rows[at] + constant;
    }

    /// Replaces the matrix by its factor L, whose diagonal is kept inverted. A pivot that rounding has made
    /// negative is taken for a tiny one.
    pub fn factorise(&mut self) {
        let (bandwidth, stride) = (self.bandwidth, self.bandwidth + 1);
        for r in 0..self.size {
            let first = r.saturating_sub(bandwidth);
            let (above, row) = self.rows.split_at_mut(r * stride);
            let row = &mut row[..stride];
            // Column c of row r stands at c + bandwidth − r.
            for c in first..r {
                let start = first.max(c.saturating_sub(bandwidth));
                let other = &above[c * stride..(c + 1) * stride];
                let sum = dot(
                    &row[start + bandwidth - r..c + bandwidth - r],
                    &other[start + bandwidth - c..bandwidth],
                );
                row[c + bandwidth - r] = (row[c + bandwidth - r] - sum) * other[bandwidth];
            }
            let own = &row[first + bandwidth - r..bandwidth];
            let pivot = row[bandwidth] - dot(own, own);
            row[bandwidth] = pivot.max(1e-12).sqrt().recip();
        }
    }

    /// Solves A X = B for N right-hand sides at once, in place; after [`Self::factorise`].
    pub fn solve<const N: usize>(&self, b: &mut [[f32; N]]) {
        let (bandwidth, stride) = (self.bandwidth, self.bandwidth + 1);
        for r in 0..self.size {
            let first = r.saturating_sub(bandwidth);
            let row = &self.rows[r * stride..(r + 1) * stride];
            let mut sum = [0.0f32; N];
            for (l, x) in row[first + bandwidth - r..bandwidth]
                .iter()
                .zip(&b[first..r])
            {
                for n in 0..N {
                    sum[n] += l * x[n];
                }
            }
            for n in 0..N {
                b[r][n] = (b[r][n] - sum[n]) * row[bandwidth];
            }
        }
        for r in (0..self.size).rev() {
            let first = r.saturating_sub(bandwidth);
            let row = &self.rows[r * stride..(r + 1) * stride];
            let mut x = b[r];
            for n in 0..N {
                x[n] *= row[bandwidth];
            }
            b[r] = x;
            for (l, b) in row[first + bandwidth - r..bandwidth]
                .iter()
                .zip(&mut b[first..r])
            {
                for n in 0..N {
                    b[n] -= l * x[n];
                }
            }
        }
    }
}

/// Σ a b.
pub fn dot(a: &[f32], b: &[f32]) -> f32 {
    let (a8, a_rest) = a.as_chunks::<8>();
    let (b8, b_rest) = b.as_chunks::<8>();
    let mut sum = f32x8::ZERO;
    for (a, b) in a8.iter().zip(b8) {
        sum += f32x8::new(*a) * f32x8::new(*b);
    }
    let rest: f32 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sum.reduce_add() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solution_solves() {
        let (size, bandwidth) = (40, 11);
        let mut matrix = Banded::default();
        let entry = |i: usize, j: usize| {
            if i == j {
                30.0
            } else {
                ((i * 7 + j * 13 + i * j) % 17) as f32 / 17.0
            }
        };
        matrix.clear(size, bandwidth);
        for i in 0..size {
            for j in i.saturating_sub(bandwidth)..=i {
                matrix.add(i, j, entry(i, j));
            }
        }
        let truth = |i: usize| [(i as f32).sin(), 1.0 - 0.1 * i as f32];
        let mut b: Vec<[f32; 2]> = (0..size)
            .map(|i| {
                let mut sum = [0.0; 2];
                for j in 0..size {
                    if i.abs_diff(j) <= bandwidth {
                        for n in 0..2 {
                            sum[n] += entry(i.max(j), i.min(j)) * truth(j)[n];
                        }
                    }
                }
                sum
            })
            .collect();
        matrix.factorise();
        matrix.solve(&mut b);
        for (i, x) in b.iter().enumerate() {
            for n in 0..2 {
                assert!((x[n] - truth(i)[n]).abs() < 1e-4);
            }
        }
    }
}
