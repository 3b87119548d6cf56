//! The frames, ready to be compared at sub-pixel: what a pixel's brightness says about its depth and the motion.
//!
//! ```text
//! e = I2(π(q)) − I1,   q = R ray + ρ T,     ∂e/∂ρ = g·T,   ∂e/∂T = ρ g,   ∂e/∂ω = (R ray) × g
//! g = (f/q_z) (I_x, I_y, −(I_x q_x + I_y q_y)/q_z)
//! ```
//!
//! I_x, I_y are the means of both frames' derivatives. Both frames are smoothed by [1 2 1]/4 both ways first, for a cubic
//! spline between noisy pixels is drawn towards what lies halfway; I2 is the cubic B-spline through its pixels.

use super::view::View;
use crate::grid::Grid;

/// Pixels by which coefficients are continued on all sides.
const PAD: usize = 3;
/// The pole of the spline's recursive filter, √3 − 2.
const POLE: f32 = -0.267_949_2;

/// Two frames.
pub struct Pair {
    guide: Grid<f32>,
    first: Grid<f32>,
    first_x: Grid<f32>,
    first_y: Grid<f32>,
    coefficients: Vec<f32>,
    stride: usize,
}

/// What each pixel says at the present depth and motion; 0 weight where it says nothing.
pub struct Linearisation {
    /// e in grey levels.
    pub residual: Vec<f32>,
    /// g, grey levels a unit of q.
    pub gradient: [Vec<f32>; 3],
    /// Whether the pixel is compared at all.
    pub compared: Vec<bool>,
}

impl Linearisation {
    /// Room for `count` pixels.
    pub fn new(count: usize) -> Self {
        Self {
            residual: vec![0.0; count],
            gradient: std::array::from_fn(|_| vec![0.0; count]),
            compared: vec![false; count],
        }
    }

    /// g of pixel i.
    pub fn gradient_at(&self, i: usize) -> [f32; 3] {
        [
            self.gradient[0][i],
            self.gradient[1][i],
            self.gradient[2][i],
        ]
    }

    /// Robust standard deviation of e over what is compared, at least half a grey level.
    pub fn spread(&self) -> f32 {
        /// Bins a grey level.
        const BINS: f32 = 16.0;
        let mut bins = [0u32; 1024];
        for (e, _) in self.residual.iter().zip(&self.compared).filter(|p| *p.1) {
            bins[((e.abs() * BINS) as usize).min(1023)] += 1;
        }
        let total: u32 = bins.iter().sum();
        let mut below = 0;
        let middle = bins.iter().position(|b| {
            below += b;
            2 * below >= total
        });
        let median = (middle.unwrap_or(0) as f32 + 0.5) / BINS;
        (1.4826 * median).max(0.5)
    }
}

impl Pair {
    /// From two frames of one size, grey levels.
    pub fn new(first: &Grid<f32>, second: &Grid<f32>) -> Self {
        let guide = first.clone();
        let first = smoothed(first);
        let (first_x, first_y) = derivatives(&first);
        let (coefficients, stride) = coefficients(&smoothed(second));
        Self {
            guide,
            first,
            first_x,
            first_y,
            coefficients,
            stride,
        }
    }

    /// The first frame as it came.
    pub fn guide(&self) -> &Grid<f32> {
        &self.guide
    }

    /// The first frame, smoothed.
    pub fn first(&self) -> &Grid<f32> {
        &self.first
    }

    /// The size of the first frame's gradient, grey levels a pixel.
    pub fn contrast(&self) -> Grid<f32> {
        let mut size = self.first_x.clone();
        for (s, &y) in size.data_mut().iter_mut().zip(self.first_y.data()) {
            *s = s.hypot(y);
        }
        size
    }

    /// Compares the frames at depth `rho` for the pixels that are in `support` and not `hidden`.
    pub fn linearise(
        &self,
        view: &View,
        rho: &Grid<f32>,
        support: &Grid<bool>,
        hidden: &Grid<bool>,
        out: &mut Linearisation,
    ) {
        let (width, height) = (rho.width(), rho.height());
        let t = view.translation;
        let (right, bottom) = (width as f32 - 1.0, height as f32 - 1.0);
        for y in 0..height {
            for x in 0..width {
                let i = y * width + x;
                out.compared[i] = false;
                out.residual[i] = 0.0;
                for g in &mut out.gradient {
                    g[i] = 0.0;
                }
                if hidden.data()[i] || !support.data()[i] {
                    continue;
                }
                let (p, r) = (view.turned(x, y), rho.data()[i]);
                let q = [p[0] + r * t[0], p[1] + r * t[1], p[2] + r * t[2]];
                let [tx, ty] = view.pixel(q);
                if !(tx >= 0.0 && ty >= 0.0 && tx <= right && ty <= bottom) {
                    continue;
                }
                let [grey, gx, gy] = self.sample(tx, ty);
                let scale = view.focal() / q[2];
                let gx = 0.5 * (gx + self.first_x.data()[i]) * scale;
                let gy = 0.5 * (gy + self.first_y.data()[i]) * scale;
                out.compared[i] = true;
                out.residual[i] = grey - self.first.data()[i];
                out.gradient[0][i] = gx;
                out.gradient[1][i] = gy;
                out.gradient[2][i] = -(gx * q[0] + gy * q[1]) / q[2];
            }
        }
    }

    /// The second frame at a place on it, and its derivatives.
    pub fn sample(&self, x: f32, y: f32) -> [f32; 3] {
        let (xi, yi) = (x as usize, y as usize);
        let (tx, ty) = (x - xi as f32, y - yi as f32);
        let (bx, by) = (weights(tx), weights(ty));
        let (dx, dy) = (slopes(tx), slopes(ty));
        let (mut value, mut slope) = ([0.0f32; 4], [0.0f32; 4]);
        for r in 0..4 {
            let first = (yi + r + PAD - 1) * self.stride + xi + PAD - 1;
            let row: &[f32; 4] = self.coefficients[first..first + 4]
                .try_into()
                .expect("a slice of four");
            for k in 0..4 {
                value[k] += by[r] * row[k];
                slope[k] += dy[r] * row[k];
            }
        }
        let mut out = [0.0f32; 3];
        for k in 0..4 {
            out[0] += bx[k] * value[k];
            out[1] += dx[k] * value[k];
            out[2] += bx[k] * slope[k];
        }
        out
    }
}

/// The B-spline at the four pixels around a point at fraction `t` past the second.
fn weights(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    let sixth = 1.0 / 6.0;
    [
        s * s * s * sixth,
        (4.0 + t * t * (3.0 * t - 6.0)) * sixth,
        (4.0 + s * s * (3.0 * s - 6.0)) * sixth,
        t * t * t * sixth,
    ]
}

/// Its derivative there.
fn slopes(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    [
        -0.5 * s * s,
        t * (1.5 * t - 2.0),
        s * (2.0 - 1.5 * s),
        0.5 * t * t,
    ]
}

/// [1 2 1]/4 both ways, the border continued.
pub fn smoothed(picture: &Grid<f32>) -> Grid<f32> {
    let (width, height) = (picture.width(), picture.height());
    let mut across = picture.clone();
    for y in 0..height {
        let row = picture.row(y);
        let out = across.row_mut(y);
        for (o, v) in out[1..].iter_mut().zip(row.windows(3)) {
            *o = 0.25 * (v[0] + v[2]) + 0.5 * v[1];
        }
        out[0] = 0.75 * row[0] + 0.25 * row[1];
        out[width - 1] = 0.75 * row[width - 1] + 0.25 * row[width - 2];
    }
    let mut out = across.clone();
    for y in 0..height {
        let (a, b) = (across.row(y.saturating_sub(1)), across.row(y));
        let c = across.row((y + 1).min(height - 1));
        for (((o, &a), &b), &c) in out.row_mut(y).iter_mut().zip(a).zip(b).zip(c) {
            *o = 0.25 * (a + c) + 0.5 * b;
        }
    }
    out
}

/// Central differences over five pixels, over three or two at the border.
fn derivatives(picture: &Grid<f32>) -> (Grid<f32>, Grid<f32>) {
    let (width, height) = (picture.width(), picture.height());
    let near = |k: usize, count: usize| (k.saturating_sub(1), (k + 1).min(count - 1));
    let mut gx = Grid::new(width, height, 0.0f32);
    let mut gy = Grid::new(width, height, 0.0f32);
    for y in 0..height {
        let row = picture.row(y);
        let out = gx.row_mut(y);
        for (o, v) in out[2..].iter_mut().zip(row.windows(5)) {
            *o = (8.0 * (v[3] - v[1]) - (v[4] - v[0])) * (1.0 / 12.0);
        }
        for x in [0, 1, width - 2, width - 1] {
            let (a, b) = near(x, width);
            out[x] = (row[b] - row[a]) / (b - a) as f32;
        }
        let (a, b) = near(y, height);
        let (above, below) = (picture.row(a), picture.row(b));
        let out = gy.row_mut(y);
        if y >= 2 && y + 2 < height {
            let (above2, below2) = (picture.row(y - 2), picture.row(y + 2));
            for x in 0..width {
                let (near, far) = (below[x] - above[x], below2[x] - above2[x]);
                out[x] = (8.0 * near - far) * (1.0 / 12.0);
            }
        } else {
            for x in 0..width {
                out[x] = (below[x] - above[x]) / (b - a) as f32;
            }
        }
    }
    (gx, gy)
}

/// The coefficients of the spline through a picture, mirrored outwards, and their row length.
fn coefficients(picture: &Grid<f32>) -> (Vec<f32>, usize) {
    let (width, height) = (picture.width(), picture.height());
    let mut c = picture.clone();
    for y in 0..height {
        filter(c.row_mut(y));
    }
    // Columns: the same filter, a row at a time.
    let row = |y: usize| y * width..(y + 1) * width;
    let data = c.data_mut();
    let mut first = data[row(0)].to_vec();
    let mut power = POLE;
    for y in 1..height.min(HORIZON) {
        for (f, &v) in first.iter_mut().zip(&data[row(y)]) {
            *f += power * v;
        }
        power *= POLE;
    }
    data[row(0)].copy_from_slice(&first);
    for y in 1..height {
        let (before, here) = data.split_at_mut(y * width);
        for (h, &b) in here[..width].iter_mut().zip(&before[row(y - 1)]) {
            *h += POLE * b;
        }
    }
    let (before, last) = data.split_at_mut((height - 1) * width);
    for (l, &b) in last.iter_mut().zip(&before[row(height - 2)]) {
        *l = POLE / (POLE * POLE - 1.0) * (*l + POLE * b);
    }
    for y in (0..height - 1).rev() {
        let (here, after) = data.split_at_mut((y + 1) * width);
        for (h, &a) in here[row(y)].iter_mut().zip(&after[..width]) {
            *h = POLE * (a - *h);
        }
    }
    data.iter_mut().for_each(|v| *v *= 6.0);
    let stride = width + 2 * PAD;
    let mirrored = |k: usize, count: usize| {
        let k = (k as isize - PAD as isize).unsigned_abs();
        if k < count { k } else { 2 * (count - 1) - k }
    };
    let mut out = Vec::with_capacity(stride * (height + 2 * PAD));
    for y in 0..height + 2 * PAD {
        let source = c.row(mirrored(y, height));
        out.extend((0..PAD).map(|x| source[mirrored(x, width)]));
        out.extend_from_slice(source);
        out.extend((width + PAD..stride).map(|x| source[mirrored(x, width)]));
    }
    (out, stride)
}

/// Pixels after which the pole's powers are below rounding.
const HORIZON: usize = 12;

/// A row of pixels into its coefficients, there and back.
fn filter(row: &mut [f32]) {
    let n = row.len();
    let mut power = POLE;
    for k in 1..n.min(HORIZON) {
        row[0] += power * row[k];
        power *= POLE;
    }
    for i in 1..n {
        row[i] += POLE * row[i - 1];
    }
    row[n - 1] = POLE / (POLE * POLE - 1.0) * (row[n - 1] + POLE * row[n - 2]);
    for i in (0..n - 1).rev() {
        row[i] = POLE * (row[i + 1] - row[i]);
    }
    row.iter_mut().for_each(|v| *v *= 6.0);
}

#[cfg(test)]
mod tests;
