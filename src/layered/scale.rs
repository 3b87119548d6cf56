//! The two frames at one scale, ready to be compared where a motion leads.
//!
//! The first frame has its brightness and gradient at every pixel; the second is a cubic spline
//! (Unser 1999),
//!
//! ```text
//! I2(x, y) = Σij c_ij β(x − i) β(y − j)        β the cubic B-spline
//! ```
//!
//! whose value and gradient are read at any place. Both frames are smoothed first: the noise that a spline lets
//! through depends on where between pixels it is read, which draws motion towards whole pixels. Labels are judged by
//! frames that are not smoothed, or outlines would be mixtures of both sides. Grey levels, pixels
//! of this scale; a pixel of the next coarser scale covers 2×2 of this one.

use wide::f32x4;

use crate::camera::Camera;
use crate::frames::{FramePair, Lighting, blur};
use crate::grid::Grid;

/// Pixels by which the spline goes on beyond the frame.
const PAD: usize = 3;
/// The pole of the recursive filter that makes a spline of pixels, √3 − 2.
const POLE: f32 = -0.267_949_2;
/// A scale whose shorter side has fewer pixels than this is too coarse to show anything.
const SHORTEST: usize = 24;

/// The frames at one scale.
pub(crate) struct Scale {
    pub width: usize,
    pub height: usize,
    pub camera: Camera,
    /// Brightness of the first frame.
    pub first: Grid<f32>,
    /// Its gradient, ∂/∂x and ∂/∂y.
    pub gradient: [Grid<f32>; 2],
    /// Coefficients of the second frame's spline, `PAD` pixels larger on each side.
    second: Grid<f32>,
    /// Brightness of the first frame before it was smoothed.
    pub plain: Grid<f32>,
    /// The spline of the second frame before it was smoothed.
    plain_second: Grid<f32>,
}

/// All scales, the finest first, of frames smoothed by `smoothing` pixels, the first in the light of the second.
pub(crate) fn pyramid(
    pair: &FramePair,
    camera: Camera,
    smoothing: f64,
    lighting: Lighting,
) -> Vec<Scale> {
    let (gain, offset) = (lighting.gain as f32, lighting.offset as f32);
    let mut plain = [
        pair.first().grey.map(|v| gain * v + offset),
        (*pair.second().grey).clone(),
    ];
    let mut smooth = [blur(&plain[0], smoothing), blur(&plain[1], smoothing)];
    let mut camera = camera;
    let mut scales = Vec::new();
    loop {
        let (w, h) = (plain[0].width(), plain[0].height());
        let half = |frames: &[Grid<f32>; 2]| [halved(&frames[0]), halved(&frames[1])];
        let coarser = (w.min(h) / 2 >= SHORTEST).then(|| (half(&smooth), half(&plain)));
        scales.push(Scale::new(smooth, plain, camera));
        let Some(next) = coarser else {
            return scales;
        };
        (smooth, plain) = next;
        camera = Camera {
            focal: camera.focal / 2.0,
            cx: (camera.cx - 0.5) / 2.0,
            cy: (camera.cy - 0.5) / 2.0,
        };
    }
}

impl Scale {
    fn new(smooth: [Grid<f32>; 2], plain: [Grid<f32>; 2], camera: Camera) -> Self {
        let ([first, second], [plain, plain_second]) = (smooth, plain);
        Self {
            width: first.width(),
            height: first.height(),
            camera,
            gradient: gradient(&first),
            second: spline(&second),
            first,
            plain,
            plain_second: spline(&plain_second),
        }
    }

    /// Whether the second frame has something to compare with at (x, y): a pixel reaches half of one beyond its
    /// centre.
    #[inline(always)]
    pub fn contains(&self, x: f32, y: f32) -> bool {
        x > -0.5 && y > -0.5 && x < self.width as f32 - 0.5 && y < self.height as f32 - 0.5
    }

    /// Brightness of the second frame at a pixel.
    pub fn pixel(&self, x: usize, y: usize) -> f32 {
        let (c, x, y) = (&self.second, x + PAD, y + PAD);
        let across = |y| 4.0 * c[(x, y)] + c[(x - 1, y)] + c[(x + 1, y)];
        (4.0 * across(y) + across(y - 1) + across(y + 1)) * (1.0 / 36.0)
    }

    /// Brightness of the second frame at (x, y), which [`Self::contains`], and its gradient.
    #[inline(always)]
    pub fn read(&self, x: f32, y: f32) -> [f32; 3] {
        let (four, bx, dx) = self.four(x, y);
        let value = (four[0] * bx).reduce_add();
        let gx = (four[0] * dx).reduce_add();
        let gy = (four[1] * bx).reduce_add();
        [value, gx, gy]
    }

    /// Brightness of the second frame at (x, y), which [`Self::contains`].
    #[inline(always)]
    pub fn brightness(&self, x: f32, y: f32) -> f32 {
        value(&self.second, x, y)
    }

    /// The same of the second frame before it was smoothed.
    #[inline(always)]
    pub fn plain_brightness(&self, x: f32, y: f32) -> f32 {
        value(&self.plain_second, x, y)
    }

    /// The four columns around x with the rows summed by β and by β′, and the weights β and β′ of the columns.
    #[inline(always)]
    fn four(&self, x: f32, y: f32) -> ([f32x4; 2], f32x4, f32x4) {
        let (xi, tx, yi, ty) = cell(x, y);
        let (by, dy) = (basis(ty), slope(ty));
        let (mut sum, mut down) = (f32x4::ZERO, f32x4::ZERO);
        for j in 0..4 {
            let row = taps(&self.second, xi, yi + j);
            sum += row * f32x4::splat(by[j]);
            down += row * f32x4::splat(dy[j]);
        }
        ([sum, down], f32x4::new(basis(tx)), f32x4::new(slope(tx)))
    }
}

/// The spline's value at (x, y).
#[inline(always)]
fn value(spline: &Grid<f32>, x: f32, y: f32) -> f32 {
    let (xi, tx, yi, ty) = cell(x, y);
    let mut sum = f32x4::ZERO;
    for (j, b) in basis(ty).into_iter().enumerate() {
        sum += taps(spline, xi, yi + j) * f32x4::splat(b);
    }
    (sum * f32x4::new(basis(tx))).reduce_add()
}

#[inline(always)]
fn taps(spline: &Grid<f32>, x: usize, y: usize) -> f32x4 {
    let at = y * spline.width() + x;
    let row: [f32; 4] = spline.data()[at..at + 4].try_into().unwrap_or_default();
    f32x4::new(row)
}

/// First column and row of the four that matter at (x, y) in the padded spline, and the fractions past the second.
#[inline(always)]
fn cell(x: f32, y: f32) -> (usize, f32, usize, f32) {
    let (x, y) = (x + PAD as f32, y + PAD as f32);
    let (xi, yi) = (x as usize, y as usize);
    (xi - 1, x - xi as f32, yi - 1, y - yi as f32)
}

/// β at the four pixels around a point at fraction t past the second.
#[inline(always)]
fn basis(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    [
        s * s * s * (1.0 / 6.0),
        (4.0 + t * t * (3.0 * t - 6.0)) * (1.0 / 6.0),
        (4.0 + s * s * (3.0 * s - 6.0)) * (1.0 / 6.0),
        t * t * t * (1.0 / 6.0),
    ]
}

/// β′ there.
#[inline(always)]
fn slope(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    [
        -0.5 * s * s,
        t * (1.5 * t - 2.0),
        s * (2.0 - 1.5 * s),
        0.5 * t * t,
    ]
}

/// A picture of half the size, each pixel from 4×4 with weights (1, 3, 3, 1)/8 both ways; an odd last row or column
/// is dropped.
fn halved(picture: &Grid<f32>) -> Grid<f32> {
    let (width, height) = (picture.width(), picture.height());
    let mut across = Grid::new(width / 2, height, 0.0f32);
    for y in 0..height {
        let row = picture.row(y);
        for (x, out) in across.row_mut(y).iter_mut().enumerate() {
            let (left, right) = ((2 * x).max(1) - 1, (2 * x + 2).min(width - 1));
            *out = 0.125 * (row[left] + row[right]) + 0.375 * (row[2 * x] + row[2 * x + 1]);
        }
    }
    let mut out = Grid::new(width / 2, height / 2, 0.0f32);
    for y in 0..height / 2 {
        let (above, below) = ((2 * y).max(1) - 1, (2 * y + 2).min(height - 1));
        let rows = [above, 2 * y, 2 * y + 1, below].map(|y| across.row(y));
        for (x, out) in out.row_mut(y).iter_mut().enumerate() {
            *out = 0.125 * (rows[0][x] + rows[3][x]) + 0.375 * (rows[1][x] + rows[2][x]);
        }
    }
    out
}

/// ∂/∂x and ∂/∂y by the five-point stencil (1, −8, 0, 8, −1)/12, at the border by what there is.
fn gradient(picture: &Grid<f32>) -> [Grid<f32>; 2] {
    let (width, height) = (picture.width(), picture.height());
    let mut gx = Grid::new(width, height, 0.0f32);
    let mut gy = Grid::new(width, height, 0.0f32);
    let near = |i: usize, n: usize| (i.max(1) - 1, (i + 1).min(n - 1));
    for y in 0..height {
        let row = picture.row(y);
        let out = gx.row_mut(y);
        for (five, out) in row.windows(5).zip(&mut out[2..]) {
            *out = (8.0 * (five[3] - five[1]) - (five[4] - five[0])) * (1.0 / 12.0);
        }
        for x in [0, 1, width - 2, width - 1] {
            let (l, r) = near(x, width);
            out[x] = (row[r] - row[l]) / (r - l) as f32;
        }
        let out = gy.row_mut(y);
        let (a, b) = near(y, height);
        let (above, below) = (picture.row(a), picture.row(b));
        if y >= 2 && y + 2 < height {
            let (far_above, far_below) = (picture.row(y - 2), picture.row(y + 2));
            for x in 0..width {
                let inner = 8.0 * (below[x] - above[x]);
                out[x] = (inner - (far_below[x] - far_above[x])) * (1.0 / 12.0);
            }
        } else {
            let share = 1.0 / (b - a) as f32;
            for x in 0..width {
                out[x] = (below[x] - above[x]) * share;
            }
        }
    }
    [gx, gy]
}

/// The coefficients of the spline through a picture, mirrored at its border and padded.
fn spline(picture: &Grid<f32>) -> Grid<f32> {
    let (width, height) = (picture.width(), picture.height());
    let mut c = picture.clone();
    for y in 0..height {
        let row = c.row_mut(y);
        let mut power = POLE;
        let mut first = row[0];
        for value in row.iter().skip(1).take(HORIZON) {
            first += power * value;
            power *= POLE;
        }
        row[0] = first;
        for x in 1..width {
            row[x] += POLE * row[x - 1];
        }
        row[width - 1] = LAST * (row[width - 1] + POLE * row[width - 2]);
        for x in (0..width - 1).rev() {
            row[x] = POLE * (row[x + 1] - row[x]);
        }
    }
    // The same down the columns, a row at a time.
    let mut power = POLE;
    for y in 1..height.min(HORIZON + 1) {
        for x in 0..width {
            c[(x, 0)] += power * c[(x, y)];
        }
        power *= POLE;
    }
    let data = c.data_mut();
    for y in 1..height {
        let (above, here) = data.split_at_mut(y * width);
        for (h, a) in here[..width].iter_mut().zip(&above[(y - 1) * width..]) {
            *h += POLE * a;
        }
    }
    let (above, last) = data.split_at_mut((height - 1) * width);
    for (l, a) in last.iter_mut().zip(&above[(height - 2) * width..]) {
        *l = LAST * (*l + POLE * a);
    }
    for y in (0..height - 1).rev() {
        let (here, below) = data.split_at_mut((y + 1) * width);
        for (h, b) in here[y * width..].iter_mut().zip(&below[..width]) {
            *h = POLE * (b - *h);
        }
    }
    let mirrored = |i: usize, n: usize| {
        let i = i.abs_diff(PAD);
        if i < n { i } else { 2 * n - 2 - i }
    };
    let mut padded = Grid::new(width + 2 * PAD, height + 2 * PAD, 0.0f32);
    for y in 0..height + 2 * PAD {
        let from = c.row(mirrored(y, height));
        let to = padded.row_mut(y);
        for (x, to) in to.iter_mut().enumerate() {
            *to = 36.0 * from[mirrored(x, width)];
        }
    }
    padded
}

/// Pixels after which the pole's powers are below rounding.
const HORIZON: usize = 12;
/// What starts the way back at the last pixel of a row that is mirrored there.
const LAST: f32 = POLE / (POLE * POLE - 1.0);

#[cfg(test)]
mod tests {
    use super::*;

    fn wavy(width: usize, height: usize) -> Grid<f32> {
        Grid::from_fn(width, height, |x, y| {
            128.0 + 50.0 * (0.4 * x as f32 + 0.2 * y as f32).sin() + 30.0 * (0.5 * y as f32).cos()
        })
    }

    fn scale(picture: &Grid<f32>) -> Scale {
        let camera = Camera::centred(50.0, picture.width(), picture.height()).unwrap();
        let frames = || [picture.clone(), picture.clone()];
        Scale::new(frames(), frames(), camera)
    }

    #[test]
    fn the_spline_has_the_pixels_values() {
        let picture = wavy(37, 29);
        let scale = scale(&picture);
        for y in 0..29 {
            for x in 0..37 {
                let [value, ..] = scale.read(x as f32, y as f32);
                assert!((value - picture[(x, y)]).abs() < 2e-3, "{x} {y}");
            }
        }
    }

    #[test]
    fn the_gradient_is_the_values_own() {
        let scale = scale(&wavy(40, 32));
        let step = 0.01;
        for (x, y) in [(7.3, 9.8), (20.5, 15.25), (-0.4, 3.0), (39.4, 31.4)] {
            let [_, gx, gy] = scale.read(x, y);
            let across = scale.brightness(x + step, y) - scale.brightness(x - step, y);
            let down = scale.brightness(x, y + step) - scale.brightness(x, y - step);
            assert!((gx - across / (2.0 * step)).abs() < 0.05, "{x} {y}");
            assert!((gy - down / (2.0 * step)).abs() < 0.05, "{x} {y}");
        }
    }

    #[test]
    fn between_pixels_it_is_near_the_wave_itself() {
        let scale = scale(&wavy(64, 64));
        for i in 0..200 {
            let (x, y) = (8.0 + 0.231 * i as f32, 10.0 + 0.207 * i as f32);
            let truth = 128.0 + 50.0 * (0.4 * x + 0.2 * y).sin() + 30.0 * (0.5 * y).cos();
            assert!((scale.brightness(x, y) - truth).abs() < 0.05);
        }
    }
}
