//! Symmetric positive definite systems whose entries lie near the diagonal, by Cholesky's factorisation.
//!
//! ```text
//! A = L Lᵀ,   a_ij = 0 where |i − j| > bandwidth
//! ```
//!
//! in n · bandwidth² operations. Columns of the lower half are stored one after the other, each from its diagonal down,
//! with zeros behind it, so that four earlier columns are taken from a later one in runs of eight.

use wide::f32x8;

/// Columns that are taken from a later one together.
const TOGETHER: usize = 4;
/// Numbers that are worked on together.
const LANES: usize = 8;

/// A symmetric matrix of which the lower band is kept, then its factor.
#[derive(Clone, Default)]
pub(crate) struct Banded {
    size: usize,
    bandwidth: usize,
    /// Column j holds rows j to j + bandwidth, then zeros.
    columns: Vec<f32>,
}

impl Banded {
    /// Makes it a zero matrix of that size; memory is used again.
    pub fn clear(&mut self, size: usize, bandwidth: usize) {
        self.size = size;
        self.bandwidth = bandwidth;
        self.columns.clear();
        self.columns.resize(size * self.stride(), 0.0);
    }

    fn stride(&self) -> usize {
        self.bandwidth + TOGETHER + LANES
    }

    /// Adds to a_ij, and so to a_ji; |i − j| must not exceed the bandwidth.
    #[inline]
    pub fn add(&mut self, i: usize, j: usize, value: f32) {
        let (low, high) = (i.max(j), i.min(j));
        let at = high * self.stride() + low - high;
        self.columns[at] += value;
    }

    /// Adds to a diagonal entry a share of itself and a constant.
    pub fn stiffen(&mut self, i: usize, share: f32, constant: f32) {
        let at = i * self.stride();
        self.columns[at] += share * self.columns[at] + constant;
    }

    /// Replaces the matrix by its factor L, whose diagonal is kept inverted. A pivot that rounding has made
    /// negative is taken for a tiny one.
    pub fn factorise(&mut self) {
        let (bandwidth, stride) = (self.bandwidth, self.stride());
        for k in 0..self.size {
            let (earlier, column) = self.columns.split_at_mut(k * stride);
            let column = &mut column[..stride];
            // Row i of column j stands at i − j.
            let from = |j: usize| &earlier[j * stride + k - j..(j + 1) * stride];
            let mut j = k.saturating_sub(bandwidth);
            while j < k {
                let count = (k - j).min(TOGETHER);
                let rows = bandwidth + j + count - k;
                if count == TOGETHER {
                    take(
                        column,
                        [from(j), from(j + 1), from(j + 2), from(j + 3)],
                        rows,
                    );
                } else {
                    (j..k).for_each(|j| take(column, [from(j)], rows));
                }
                j += count;
            }
            let inverse = column[0].max(1e-12).sqrt().recip();
            column[0] = inverse;
            let below = (self.size - 1 - k).min(bandwidth);
            column[1..=below].iter_mut().for_each(|l| *l *= inverse);
        }
    }

    /// Solves A X = B for eight right-hand sides at once, in place; after [`Self::factorise`].
    pub fn solve(&self, b: &mut [[f32; LANES]]) {
        let stride = self.stride();
        let column = |j: usize| {
            let below = (self.size - 1 - j).min(self.bandwidth);
            let column = &self.columns[j * stride..=j * stride + below];
            (f32x8::splat(column[0]), &column[1..])
        };
        for j in 0..self.size {
            let (inverse, column) = column(j);
            let (own, below) = b[j..].split_at_mut(1);
            let x = f32x8::new(own[0]) * inverse;
            own[0] = x.to_array();
            for (l, b) in column.iter().zip(below) {
                *b = (f32x8::new(*b) - f32x8::splat(*l) * x).to_array();
            }
        }
        for j in (0..self.size).rev() {
            let (inverse, column) = column(j);
            let (own, below) = b[j..].split_at_mut(1);
            let mut x = f32x8::new(own[0]);
            for (l, b) in column.iter().zip(below) {
                x -= f32x8::splat(*l) * f32x8::new(*b);
            }
            own[0] = (x * inverse).to_array();
        }
    }
}

/// Takes from the first `rows` rows of a column what earlier ones hold there, each from that column's row on, times its
/// own first entry. Behind the last row there are zeros, to which nothing is done.
#[inline(always)]
fn take<const M: usize>(column: &mut [f32], earlier: [&[f32]; M], rows: usize) {
    let factors = earlier.map(|c| f32x8::splat(c[0]));
    let runs = rows.div_ceil(LANES);
    let earlier = earlier.map(|c| &c.as_chunks::<LANES>().0[..runs]);
    for (n, eight) in column.as_chunks_mut::<LANES>().0[..runs]
        .iter_mut()
        .enumerate()
    {
        let mut left = f32x8::new(*eight);
        for m in 0..M {
            left -= factors[m] * f32x8::new(earlier[m][n]);
        }
        *eight = left.to_array();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solution_solves() {
        for (size, bandwidth) in [(40, 11), (40, 1), (37, 24), (9, 30), (3, 2)] {
            solve(size, bandwidth);
        }
    }

    fn solve(size: usize, bandwidth: usize) {
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
        let truth = |i: usize| std::array::from_fn::<f32, LANES, _>(|n| ((i + n * n) as f32).sin());
        let mut b: Vec<[f32; LANES]> = (0..size)
            .map(|i| {
                let mut sum = [0.0; LANES];
                for j in (0..size).filter(|j| i.abs_diff(*j) <= bandwidth) {
                    for n in 0..LANES {
                        sum[n] += entry(i.max(j), i.min(j)) * truth(j)[n];
                    }
                }
                sum
            })
            .collect();
        matrix.factorise();
        matrix.solve(&mut b);
        for (i, x) in b.iter().enumerate() {
            for n in 0..LANES {
                assert!((x[n] - truth(i)[n]).abs() < 1e-4, "{size} {bandwidth}");
            }
        }
    }
}
