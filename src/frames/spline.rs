//! Brightness between pixels: the cubic spline through a picture (Unser 1999).
//!
//! ```text
//! I(x, y) = Σij c_ij β(x − i) β(y − j)        β the cubic B-spline,  c such that I(i, j) is the pixel
//! ```
//!
//! Cubics that read their slopes off neighbouring pixels are several percent off in texture as fine as a few
//! pixels, more so halfway between two, and image motion read by them is drawn towards whole pixels; the spline
//! is a tenth as far off. c = pixels / β by a recursive filter, once a picture, which mirrors it at its border.

use wide::f32x4;

use crate::grid::Grid;

/// Places that are read together.
pub(crate) const LANES: usize = 4;
/// Pixels by which the spline goes on beyond the picture.
const PAD: usize = 3;
/// The pole of the recursive filter, √3 − 2.
const POLE: f32 = -0.267_949_2;

/// The cubic spline through a picture.
#[derive(Clone, Debug)]
pub(crate) struct Spline {
    /// 36 c, `PAD` pixels larger than the picture on each side.
    coefficients: Grid<f32>,
}

impl Spline {
    /// The spline that has the pixels' values at whole coordinates. The picture has at least four rows and columns.
    pub fn through(picture: &Grid<f32>) -> Self {
        let (width, height) = (picture.width(), picture.height());
        let mut c = picture.clone();
        filter_rows(&mut c);
        filter_columns(&mut c);
        let mirrored = |i: usize, n: usize| {
            let i = i.abs_diff(PAD);
            if i < n { i } else { 2 * n - 2 - i }
        };
        let mut padded = Grid::new(width + 2 * PAD, height + 2 * PAD, 0.0f32);
        for y in 0..height + 2 * PAD {
            let from = c.row(mirrored(y, height));
            for (x, to) in padded.row_mut(y).iter_mut().enumerate() {
                *to = 36.0 * from[mirrored(x, width)];
            }
        }
        Self {
            coefficients: padded,
        }
    }

    /// Its value at a pixel.
    pub fn pixel(&self, x: usize, y: usize) -> f32 {
        let (c, x, y) = (&self.coefficients, x + PAD, y + PAD);
        let across = |y| 4.0 * c[(x, y)] + c[(x - 1, y)] + c[(x + 1, y)];
        (4.0 * across(y) + across(y - 1) + across(y + 1)) * (1.0 / 36.0)
    }

    /// Its value at (x, y), which is at most a pixel outside of the picture.
    #[inline(always)]
    pub fn at(&self, x: f32, y: f32) -> f32 {
        let (xi, tx, yi, ty) = cell(x, y);
        let mut sum = f32x4::ZERO;
        for (j, b) in basis(ty).into_iter().enumerate() {
            sum += self.taps(xi, yi + j) * f32x4::splat(b);
        }
        (sum * f32x4::new(basis(tx))).reduce_add()
    }

    /// Its value there and its derivatives by x and by y.
    #[inline(always)]
    pub fn with_gradient(&self, x: f32, y: f32) -> [f32; 3] {
        let (xi, tx, yi, ty) = cell(x, y);
        let (by, dy) = (basis(ty), slope(ty));
        // The four columns around x, the rows summed by β and by β′.
        let (mut sum, mut down) = (f32x4::ZERO, f32x4::ZERO);
        for j in 0..4 {
            let row = self.taps(xi, yi + j);
            sum += row * f32x4::splat(by[j]);
            down += row * f32x4::splat(dy[j]);
        }
        let (bx, dx) = (f32x4::new(basis(tx)), f32x4::new(slope(tx)));
        [sum * bx, sum * dx, down * bx].map(f32x4::reduce_add)
    }

    /// The values at four places, which are taken to the nearest place that is at most a pixel outside of the picture.
    #[inline(always)]
    pub fn at_four(&self, x: [f32; LANES], y: [f32; LANES]) -> [f32; LANES] {
        let ([xi, yi], [tx, ty]) = self.cells(x, y);
        let by = basis_of_four(ty);
        let sums = self.sums(xi, yi, by.map(f32x4::to_array));
        across(sums, basis_of_four(tx)).to_array()
    }

    /// The values there and the derivatives by x and by y.
    #[inline(always)]
    pub fn four_with_gradient(&self, x: [f32; LANES], y: [f32; LANES]) -> [[f32; LANES]; 3] {
        let ([xi, yi], [tx, ty]) = self.cells(x, y);
        let (by, dy) = (basis_of_four(ty), slope_of_four(ty));
        let [sums, down] = [by, dy].map(|b| self.sums(xi, yi, b.map(f32x4::to_array)));
        let (bx, dx) = (basis_of_four(tx), slope_of_four(tx));
        [across(sums, bx), across(sums, dx), across(down, bx)].map(f32x4::to_array)
    }

    /// [`cell`] of four places.
    #[inline(always)]
    fn cells(&self, x: [f32; LANES], y: [f32; LANES]) -> ([[usize; LANES]; 2], [f32x4; 2]) {
        let c = &self.coefficients;
        let cells = |at: [f32; LANES], side: usize| {
            let last = f32x4::splat((side - 2 * PAD) as f32);
            let at = f32x4::new(at).max(-f32x4::ONE).min(last) + f32x4::splat(PAD as f32);
            let cell = at.fast_trunc_int();
            let first = cell.to_array().map(|i| i as usize - 1);
            (first, at - f32x4::from_i32x4(cell))
        };
        let ((xi, tx), (yi, ty)) = (cells(x, c.width()), cells(y, c.height()));
        ([xi, yi], [tx, ty])
    }

    /// For each of the four columns around four places, the rows' sum by weights, place by place.
    #[inline(always)]
    fn sums(&self, x: [usize; LANES], y: [usize; LANES], by: [[f32; LANES]; 4]) -> [f32x4; 4] {
        let sum = |n: usize| {
            let row = |j: usize| self.taps(x[n], y[n] + j) * f32x4::splat(by[j][n]);
            (row(0) + row(1)) + (row(2) + row(3))
        };
        f32x4::transpose([sum(0), sum(1), sum(2), sum(3)])
    }

    #[inline(always)]
    fn taps(&self, x: usize, y: usize) -> f32x4 {
        let at = y * self.coefficients.width() + x;
        let row = &self.coefficients.data()[at..at + 4];
        f32x4::new(row.try_into().unwrap_or_default())
    }
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

/// [`basis`] of four fractions.
#[inline(always)]
fn basis_of_four(t: f32x4) -> [f32x4; 4] {
    let s = f32x4::ONE - t;
    let sixth = f32x4::splat(1.0 / 6.0);
    let (three, four, six) = (f32x4::splat(3.0), f32x4::splat(4.0), f32x4::splat(6.0));
    [
        s * s * s * sixth,
        (four + t * t * (three * t - six)) * sixth,
        (four + s * s * (three * s - six)) * sixth,
        t * t * t * sixth,
    ]
}

/// [`slope`] of four fractions.
#[inline(always)]
fn slope_of_four(t: f32x4) -> [f32x4; 4] {
    let s = f32x4::ONE - t;
    let (half, more, two) = (f32x4::HALF, f32x4::splat(1.5), f32x4::splat(2.0));
    [
        -half * s * s,
        t * (more * t - two),
        s * (two - more * s),
        half * t * t,
    ]
}

/// The columns' sum by weights.
#[inline(always)]
fn across(columns: [f32x4; 4], by: [f32x4; 4]) -> f32x4 {
    (columns[0] * by[0] + columns[1] * by[1]) + (columns[2] * by[2] + columns[3] * by[3])
}

/// Powers of the pole that are not lost in rounding.
fn powers() -> impl Iterator<Item = f32> {
    std::iter::successors(Some(POLE), |p| Some(p * POLE)).take_while(|p| p.abs() > f32::EPSILON)
}

/// What starts the way back at the last pixel of a row that is mirrored there.
fn last(end: f32, before: f32) -> f32 {
    POLE / (POLE * POLE - 1.0) * (end + POLE * before)
}

fn filter_rows(c: &mut Grid<f32>) {
    let width = c.width();
    for y in 0..c.height() {
        let row = c.row_mut(y);
        row[0] += powers().zip(&row[1..]).map(|(p, v)| p * v).sum::<f32>();
        for x in 1..width {
            row[x] += POLE * row[x - 1];
        }
        row[width - 1] = last(row[width - 1], row[width - 2]);
        for x in (0..width - 1).rev() {
            row[x] = POLE * (row[x + 1] - row[x]);
        }
    }
}

/// The same down the columns, a row at a time.
fn filter_columns(c: &mut Grid<f32>) {
    let (width, height) = (c.width(), c.height());
    let (first, rest) = c.data_mut().split_at_mut(width);
    for (power, row) in powers().zip(rest.chunks(width)) {
        for (f, v) in first.iter_mut().zip(row) {
            *f += power * v;
        }
    }
    let data = c.data_mut();
    for y in 1..height {
        let (above, here) = data.split_at_mut(y * width);
        for (h, a) in here[..width].iter_mut().zip(&above[(y - 1) * width..]) {
            *h += POLE * a;
        }
    }
    let (above, end) = data.split_at_mut((height - 1) * width);
    for (e, a) in end.iter_mut().zip(&above[(height - 2) * width..]) {
        *e = last(*e, *a);
    }
    for y in (0..height - 1).rev() {
        let (here, below) = data.split_at_mut((y + 1) * width);
        for (h, b) in here[y * width..].iter_mut().zip(&below[..width]) {
            *h = POLE * (b - *h);
        }
    }
}

#[cfg(test)]
mod tests;
