//! The linear system of depth with smoothing, A x = b, by conjugate gradients under a multigrid
//! preconditioner.
//!
//! ```text
//! (A x)_i = d_i x_i + Σ_j c_ij (x_i − x_j)      j the four neighbours, d ≥ 0, c ≥ 0
//! ```
//!
//! is symmetric and positive definite as soon as some d > 0 in each connected part, so that conjugate
//! gradients provably converge. The preconditioner is one V-cycle of symmetric Gauss–Seidel on 2×2
//! aggregates, which is symmetric positive definite itself and keeps the number of iterations nearly
//! independent of the frame's size. Several right-hand sides that share A are solved side by side, one
//! a lane. Stops when every lane's residual has fallen to `tolerance` of its right-hand side's norm, or
//! after `most` iterations.

/// A symmetric five-point operator on a `width × height` grid.
#[derive(Clone, Debug)]
pub struct Elliptic {
    width: usize,
    height: usize,
    /// d.
    data: Vec<f32>,
    /// c to the neighbour on the right; 0 in the last column.
    right: Vec<f32>,
    /// c to the neighbour below; 0 in the last row.
    below: Vec<f32>,
    /// 1 / (d + Σ c).
    inverse: Vec<f32>,
    coarser: Option<Box<Elliptic>>,
}

/// Grids of at most this many pixels are not coarsened any more.
const COARSEST: usize = 16;
/// Sweeps on the coarsest grid.
const COARSEST_SWEEPS: usize = 8;
/// Added to the diagonal, as a share of it: keeps a part without data solvable.
const FLOOR: f32 = 1e-6;

type Lanes<const L: usize> = Vec<[f32; L]>;

impl Elliptic {
    /// The operator for data weights d and edge weights c, all in row order and of `width · height`
    /// values.
    pub fn new(
        width: usize,
        height: usize,
        data: Vec<f32>,
        right: Vec<f32>,
        below: Vec<f32>,
    ) -> Self {
        let mut inverse = vec![0.0; data.len()];
        for y in 0..height {
            for x in 0..width {
                let i = y * width + x;
                let mut sum = data[i] + right[i] + below[i];
                if x > 0 {
                    sum += right[i - 1];
                }
                if y > 0 {
                    sum += below[i - width];
                }
                inverse[i] = 1.0 / (sum * (1.0 + FLOOR) + f32::MIN_POSITIVE.sqrt());
            }
        }
        let mut operator = Self {
            width,
            height,
            data,
            right,
            below,
            inverse,
            coarser: None,
        };
        if width * height > COARSEST {
            operator.coarser = Some(Box::new(operator.aggregated()));
        }
        operator
    }

    /// Solves A x = b lane by lane from the given x; returns the iterations made.
    pub fn solve<const L: usize>(
        &self,
        b: &[[f32; L]],
        x: &mut [[f32; L]],
        tolerance: f64,
        most: usize,
    ) -> usize {
        let n = b.len();
        let mut r = vec![[0.0f32; L]; n];
        self.residual(b, x, &mut r);
        let goal = dot(b, b).map(|bb| bb * tolerance * tolerance);
        let mut direction: Lanes<L> = vec![[0.0; L]; n];
        let mut image: Lanes<L> = vec![[0.0; L]; n];
        let mut rz_before = [0.0f64; L];
        for iteration in 0..most {
            let rr = dot(&r, &r);
            if (0..L).all(|l| rr[l] <= goal[l]) {
                return iteration;
            }
            let z = self.cycle(&r);
            let rz = dot(&r, &z);
            let beta: [f32; L] = std::array::from_fn(|l| {
                if iteration == 0 || rz_before[l] <= 0.0 {
                    0.0
                } else {
                    (rz[l] / rz_before[l]) as f32
                }
            });
            for (p, z) in direction.iter_mut().zip(&z) {
                for l in 0..L {
                    p[l] = z[l] + beta[l] * p[l];
                }
            }
            self.apply(&direction, &mut image);
            let curvature = dot(&direction, &image);
            let alpha: [f32; L] = std::array::from_fn(|l| {
                if curvature[l] > 0.0 && rr[l] > goal[l] {
                    (rz[l] / curvature[l]) as f32
                } else {
                    0.0
                }
            });
            for i in 0..n {
                for l in 0..L {
                    x[i][l] += alpha[l] * direction[i][l];
                    r[i][l] -= alpha[l] * image[i][l];
                }
            }
            rz_before = rz;
        }
        most
    }

    /// Diagonal of A at pixel i.
    fn diagonal(&self, i: usize) -> f32 {
        self.inverse[i].recip()
    }

    /// Σ_j c_ij x_j.
    #[inline(always)]
    fn neighbours<const L: usize>(
        &self,
        x: &[[f32; L]],
        i: usize,
        px: usize,
        py: usize,
    ) -> [f32; L] {
        let w = self.width;
        let mut sum = [0.0; L];
        let mut add = |c: f32, v: &[f32; L]| {
            for l in 0..L {
                sum[l] += c * v[l];
            }
        };
        if px + 1 < w {
            add(self.right[i], &x[i + 1]);
        }
        if px > 0 {
            add(self.right[i - 1], &x[i - 1]);
        }
        if py + 1 < self.height {
            add(self.below[i], &x[i + w]);
        }
        if py > 0 {
            add(self.below[i - w], &x[i - w]);
        }
        sum
    }

    fn apply<const L: usize>(&self, x: &[[f32; L]], out: &mut [[f32; L]]) {
        for py in 0..self.height {
            for px in 0..self.width {
                let i = py * self.width + px;
                let sum = self.neighbours(x, i, px, py);
                let d = self.diagonal(i);
                for l in 0..L {
                    out[i][l] = d * x[i][l] - sum[l];
                }
            }
        }
    }

    fn residual<const L: usize>(&self, b: &[[f32; L]], x: &[[f32; L]], out: &mut [[f32; L]]) {
        self.apply(x, out);
        for (o, b) in out.iter_mut().zip(b) {
            for l in 0..L {
                o[l] = b[l] - o[l];
            }
        }
    }

    /// One V-cycle for A z = r from z = 0.
    fn cycle<const L: usize>(&self, r: &[[f32; L]]) -> Lanes<L> {
        let mut z = vec![[0.0; L]; r.len()];
        let Some(coarser) = &self.coarser else {
            for _ in 0..COARSEST_SWEEPS {
                self.sweep_down(r, &mut z);
                self.sweep_up(r, &mut z);
            }
            return z;
        };
        self.sweep_down(r, &mut z);
        let mut rest = vec![[0.0; L]; r.len()];
        self.residual(r, &z, &mut rest);
        let mut coarse = vec![[0.0; L]; coarser.width * coarser.height];
        self.visit_aggregates(|i, c| {
            for l in 0..L {
                coarse[c][l] += rest[i][l];
            }
        });
        let correction = coarser.cycle(&coarse);
        self.visit_aggregates(|i, c| {
            for l in 0..L {
                z[i][l] += correction[c][l];
            }
        });
        self.sweep_up(r, &mut z);
        z
    }

    fn sweep_down<const L: usize>(&self, b: &[[f32; L]], x: &mut [[f32; L]]) {
        for py in 0..self.height {
            for px in 0..self.width {
                self.relax(b, x, px, py);
            }
        }
    }

    fn sweep_up<const L: usize>(&self, b: &[[f32; L]], x: &mut [[f32; L]]) {
        for py in (0..self.height).rev() {
            for px in (0..self.width).rev() {
                self.relax(b, x, px, py);
            }
        }
    }

    #[inline(always)]
    fn relax<const L: usize>(&self, b: &[[f32; L]], x: &mut [[f32; L]], px: usize, py: usize) {
        let i = py * self.width + px;
        let sum = self.neighbours(x, i, px, py);
        for l in 0..L {
            x[i][l] = (b[i][l] + sum[l]) * self.inverse[i];
        }
    }

    fn visit_aggregates(&self, mut visit: impl FnMut(usize, usize)) {
        let coarse_width = self.width.div_ceil(2);
        for y in 0..self.height {
            for x in 0..self.width {
                visit(y * self.width + x, (y / 2) * coarse_width + x / 2);
            }
        }
    }

    fn aggregated(&self) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let mut data = vec![0.0; width * height];
        let mut right = vec![0.0; width * height];
        let mut below = vec![0.0; width * height];
        self.visit_aggregates(|i, c| {
            data[c] += self.data[i];
            let (x, y) = (i % self.width, i / self.width);
            // Piecewise constant aggregates are twice too stiff for smooth functions.
            if x % 2 == 1 {
                right[c] += 0.5 * self.right[i];
            }
            if y % 2 == 1 {
                below[c] += 0.5 * self.below[i];
            }
        });
        Self::new(width, height, data, right, below)
    }
}

fn dot<const L: usize>(a: &[[f32; L]], b: &[[f32; L]]) -> [f64; L] {
    let mut sum = [0.0f64; L];
    // Short runs in single precision, their sums in double.
    for (a, b) in a.chunks(256).zip(b.chunks(256)) {
        let mut part = [0.0f32; L];
        for (a, b) in a.iter().zip(b) {
            for l in 0..L {
                part[l] += a[l] * b[l];
            }
        }
        for l in 0..L {
            sum[l] += f64::from(part[l]);
        }
    }
    sum
}
