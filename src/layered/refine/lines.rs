//! The linear system of dense smoothing: data at each pixel, bending along rows and along columns.
//!
//! ```text
//! minimise  ½ Σ a (x − t)² + ½ Σ wx (∂xx x)² + ½ Σ wy (∂yy x)²
//! A x = a t,     A = H + V,     H = ½ a + ∂xxᵀ wx ∂xx,     V = ½ a + ∂yyᵀ wy ∂yy
//! ```
//!
//! ∂xx x = x(i−1) − 2 x(i) + x(i+1). Conjugate gradients, preconditioned by alternating directions (Peaceman and
//! Rachford): (V + τ)⁻¹ (H + τ)⁻¹, each a set of pentadiagonal systems of one line that are solved exactly. τ goes
//! through the given shifts, one a step: large ones settle fine detail, small ones what is smooth. No step raises the
//! sum. Where wx and wy are 0, lines are cut.

use crate::grid::Grid;
use crate::linalg::dot;

/// The weights of the sum.
pub struct Bending {
    /// Weight of the data at each pixel.
    pub data: Grid<f32>,
    /// Weight of ∂xx at each pixel; the first and last column must be 0.
    pub across: Grid<f32>,
    /// Weight of ∂yy at each pixel; the first and last row must be 0.
    pub down: Grid<f32>,
}

/// Room for one solve after another.
pub struct Lines {
    width: usize,
    height: usize,
    residual: Vec<f32>,
    direction: Vec<f32>,
    applied: Vec<f32>,
    step: Vec<f32>,
    turned: Vec<f32>,
    data_turned: Vec<f32>,
    across_turned: Vec<f32>,
    factors: Factors,
    stress: Vec<f32>,
}

/// The factors L D Lᵀ of the pentadiagonal systems of all lines.
struct Factors {
    one: Vec<f32>,
    two: Vec<f32>,
    inverse: Vec<f32>,
    /// Stands in for rows before the first and after the last.
    none: Vec<f32>,
}

impl Lines {
    /// Room for pictures of `width × height` pixels.
    pub fn new(width: usize, height: usize) -> Self {
        let plane = || vec![0.0f32; width * height];
        Self {
            width,
            height,
            residual: plane(),
            direction: plane(),
            applied: plane(),
            step: plane(),
            turned: plane(),
            data_turned: plane(),
            across_turned: plane(),
            factors: Factors {
                one: plane(),
                two: plane(),
                inverse: plane(),
                none: vec![0.0; width.max(height)],
            },
            stress: vec![0.0; width],
        }
    }

    /// Brings `x` nearer to the minimum, one step for each of `shifts`. `pull` is a (t − x).
    pub fn solve(&mut self, bending: &Bending, x: &mut [f32], pull: &[f32], shifts: &[f32]) {
        let (width, height) = (self.width, self.height);
        transpose(bending.data.data(), &mut self.data_turned, width, height);
        transpose(
            bending.across.data(),
            &mut self.across_turned,
            width,
            height,
        );
        // Residual a (t − x) less bending of x.
        self.apply(bending, x, false);
        for ((r, &p), &b) in self.residual.iter_mut().zip(pull).zip(&self.applied) {
            *r = p - b;
        }
        let mut curvature = 0.0;
        for (k, &shift) in shifts.iter().enumerate() {
            self.precondition(bending, shift);
            let beta = if k == 0 || curvature <= 0.0 {
                0.0
            } else {
                -(long_dot(&self.step, &self.applied) / curvature) as f32
            };
            for (d, &s) in self.direction.iter_mut().zip(&self.step) {
                *d = s + beta * *d;
            }
            let direction = std::mem::take(&mut self.direction);
            self.apply(bending, &direction, true);
            curvature = long_dot(&direction, &self.applied);
            if curvature > 0.0 {
                let length = (long_dot(&self.residual, &direction) / curvature) as f32;
                for (x, &d) in x.iter_mut().zip(&direction) {
                    *x += length * d;
                }
                for (r, &b) in self.residual.iter_mut().zip(&self.applied) {
                    *r -= length * b;
                }
            }
            self.direction = direction;
        }
    }

    /// `applied` = A x, or without the data's part.
    fn apply(&mut self, bending: &Bending, x: &[f32], with_data: bool) {
        let (width, height) = (self.width, self.height);
        let row = |y: usize| y * width..(y + 1) * width;
        let out = &mut self.applied;
        if with_data {
            for ((o, &a), &x) in out.iter_mut().zip(bending.data.data()).zip(x) {
                *o = a * x;
            }
        } else {
            out.fill(0.0);
        }
        let stress = &mut self.stress;
        for y in 0..height {
            let (x, w) = (&x[row(y)], bending.across.row(y));
            stress[0] = 0.0;
            stress[width - 1] = 0.0;
            for ((s, three), &w) in stress[1..].iter_mut().zip(x.windows(3)).zip(&w[1..]) {
                *s = w * (three[0] - 2.0 * three[1] + three[2]);
            }
            let out = &mut out[row(y)];
            for (o, three) in out[1..].iter_mut().zip(stress.windows(3)) {
                *o += three[0] - 2.0 * three[1] + three[2];
            }
            out[0] += stress[1];
            out[width - 1] += stress[width - 2];
        }
        for y in 1..height - 1 {
            let (a, b, c) = (&x[row(y - 1)], &x[row(y)], &x[row(y + 1)]);
            let w = bending.down.row(y);
            for i in 0..width {
                stress[i] = w[i] * (a[i] - 2.0 * b[i] + c[i]);
            }
            for (k, factor) in [(y - 1, 1.0), (y, -2.0), (y + 1, 1.0)] {
                for (o, &s) in out[row(k)].iter_mut().zip(stress.iter()) {
                    *o += factor * s;
                }
            }
        }
    }

    /// `step` = (V + τ)⁻¹ (H + τ)⁻¹ `residual`.
    fn precondition(&mut self, bending: &Bending, shift: f32) {
        let (width, height) = (self.width, self.height);
        transpose(&self.residual, &mut self.turned, width, height);
        self.factors.solve(
            [height, width],
            &self.data_turned,
            &self.across_turned,
            shift,
            &mut self.turned,
        );
        transpose(&self.turned, &mut self.step, height, width);
        self.factors.solve(
            [width, height],
            bending.data.data(),
            bending.down.data(),
            shift,
            &mut self.step,
        );
    }
}

impl Factors {
    /// Solves for every column at once; `x` is the right-hand side and becomes the solution.
    fn solve(
        &mut self,
        [width, height]: [usize; 2],
        data: &[f32],
        weight: &[f32],
        shift: f32,
        x: &mut [f32],
    ) {
        let row = |y: usize| y * width..(y + 1) * width;
        let none = &self.none[..width];
        for y in 0..height {
            let (done, rest) = x.split_at_mut(y * width);
            let r = &mut rest[..width];
            let (d1, d2) = self.inverse.split_at_mut(y * width);
            let (l1, l2) = self.one.split_at_mut(y * width);
            let (inverse, one) = (&mut d2[..width], &mut l2[..width]);
            let two = &mut self.two[row(y)];
            let (above, here) = (before(weight, y, 1, none), &weight[row(y)]);
            let below = if y + 1 < height {
                &weight[row(y + 1)]
            } else {
                none
            };
            let (inv1, inv2) = (before(d1, y, 1, none), before(d1, y, 2, none));
            let one1 = before(l1, y, 1, none);
            let (x1, x2) = (before(done, y, 1, none), before(done, y, 2, none));
            let data = &data[row(y)];
            for i in 0..width {
                let off2 = above[i];
                let off1 = -2.0 * (above[i] + here[i]);
                let diagonal = 0.5 * data[i] + shift + 4.0 * here[i] + above[i] + below[i];
                let m2 = off2 * inv2[i];
                let t1 = off1 - off2 * one1[i];
                let m1 = t1 * inv1[i];
                let pivot = (diagonal - t1 * m1 - off2 * m2).max(0.1 * shift);
                inverse[i] = 1.0 / pivot;
                one[i] = m1;
                two[i] = m2;
                r[i] -= m1 * x1[i] + m2 * x2[i];
            }
        }
        for y in (0..height).rev() {
            let (head, tail) = x.split_at_mut((y + 1) * width);
            let here = &mut head[row(y)];
            let inverse = &self.inverse[row(y)];
            let (m1, x1) = if y + 1 < height {
                (&self.one[row(y + 1)], &tail[..width])
            } else {
                (none, none)
            };
            let (m2, x2) = if y + 2 < height {
                (&self.two[row(y + 2)], &tail[width..2 * width])
            } else {
                (none, none)
            };
            for i in 0..width {
                here[i] = here[i] * inverse[i] - m1[i] * x1[i] - m2[i] * x2[i];
            }
        }
    }
}

/// The row `k` before row `y`, or what stands in for it: a row of 0.
fn before<'a>(plane: &'a [f32], y: usize, k: usize, none: &'a [f32]) -> &'a [f32] {
    let width = none.len();
    if y >= k {
        &plane[(y - k) * width..(y - k + 1) * width]
    } else {
        none
    }
}

/// `to` is `from` of `width × height` with rows and columns exchanged.
fn transpose(from: &[f32], to: &mut [f32], width: usize, height: usize) {
    const TILE: usize = 16;
    for top in (0..height).step_by(TILE) {
        for left in (0..width).step_by(TILE) {
            for x in left..(left + TILE).min(width) {
                let bottom = (top + TILE).min(height);
                for (y, o) in (top..bottom).zip(&mut to[x * height + top..x * height + bottom]) {
                    *o = from[y * width + x];
                }
            }
        }
    }
}

/// Σ a b, in f64 over runs of single precision.
fn long_dot(a: &[f32], b: &[f32]) -> f64 {
    let runs = a.chunks(1024).zip(b.chunks(1024));
    runs.map(|(a, b)| dot(a, b)).sum()
}

#[cfg(test)]
mod tests;
