//! Brightness between pixels: the cubic spline through a picture.
//!
//! ```text
//! I(x, y) = Σij c_ij β(x − i) β(y − j)        β the cubic B-spline,  c such that I(i, j) is the pixel
//! ```
//!
//! Cubics that read their slopes off neighbouring pixels are several percent off in texture as fine as a few
//! pixels, more so halfway between two, and image motion read by them is drawn towards whole pixels; the spline
//! is a tenth as far off (Unser 1999). c = pixels / β by a recursive filter, once a picture, which mirrors it
//! at its border. Outside it has the border's values.

use crate::grid::Grid;

/// The pole of the recursive filter, √3 − 2.
const POLE: f32 = -0.267_949_2;
/// Pixels after which the pole's powers are below rounding.
const HORIZON: usize = 16;

/// The cubic spline through a picture.
#[derive(Clone, Debug)]
pub struct Spline {
    coefficients: Grid<f32>,
}

impl Spline {
    /// The spline that has the pixels' values at whole coordinates.
    pub fn through(picture: &Grid<f32>) -> Self {
        let mut coefficients = picture.clone();
        for y in 0..picture.height() {
            filter(coefficients.row_mut(y));
        }
        let mut column = vec![0.0; picture.height()];
        for x in 0..picture.width() {
            for (y, c) in column.iter_mut().enumerate() {
                *c = coefficients[(x, y)];
            }
            filter(&mut column);
            for (y, c) in column.iter().enumerate() {
                coefficients[(x, y)] = *c;
            }
        }
        Self { coefficients }
    }

    /// Its value at real coordinates, 0 at the middle of the first pixel.
    pub fn at(&self, x: f32, y: f32) -> f32 {
        let (width, height) = (self.coefficients.width(), self.coefficients.height());
        let x = x.clamp(0.0, (width - 1) as f32);
        let y = y.clamp(0.0, (height - 1) as f32);
        let (x0, y0) = (x.floor(), y.floor());
        let (wx, wy) = (weights(x - x0), weights(y - y0));
        let (x0, y0) = (x0 as usize, y0 as usize);
        let within = x0 >= 1 && y0 >= 1 && x0 + 2 < width && y0 + 2 < height;
        let mut sum = 0.0;
        for (j, wy) in wy.into_iter().enumerate() {
            let across = if within {
                let four = &self.coefficients.row(y0 + j - 1)[x0 - 1..x0 + 3];
                wx[0] * four[0] + wx[1] * four[1] + wx[2] * four[2] + wx[3] * four[3]
            } else {
                let row = self.coefficients.row(mirrored(y0 + j, height));
                let each = wx.iter().enumerate();
                each.map(|(i, w)| w * row[mirrored(x0 + i, width)]).sum()
            };
            sum += wy * across;
        }
        sum
    }
}

/// The pixel that stands one before `next`, mirrored at the first and the last of `count`.
fn mirrored(next: usize, count: usize) -> usize {
    let place = if next == 0 { 1 } else { next - 1 };
    let place = if place < count {
        place
    } else {
        (2 * (count - 1)).saturating_sub(place)
    };
    place.min(count - 1)
}

/// β at the four pixels around a point at fraction `t` past the second.
fn weights(t: f32) -> [f32; 4] {
    let (s, t2, t3) = (1.0 - t, t * t, t * t * t);
    [
        s * s * s / 6.0,
        (4.0 - 6.0 * t2 + 3.0 * t3) / 6.0,
        (1.0 + 3.0 * t + 3.0 * t2 - 3.0 * t3) / 6.0,
        t3 / 6.0,
    ]
}

/// Pixels of a row into its coefficients, there and back.
fn filter(row: &mut [f32]) {
    let n = row.len();
    if n < 2 {
        return;
    }
    row.iter_mut().for_each(|c| *c *= 6.0);
    let mut power = 1.0;
    let mut first = 0.0;
    for i in 0..HORIZON {
        // The row mirrored at its first pixel, as it would have come in.
        first += power * row[mirrored(i + 1, n)];
        power *= POLE;
    }
    row[0] = first;
    for i in 1..n {
        row[i] += POLE * row[i - 1];
    }
    row[n - 1] = POLE / (POLE * POLE - 1.0) * (row[n - 1] + POLE * row[n - 2]);
    for i in (0..n - 1).rev() {
        row[i] = POLE * (row[i + 1] - row[i]);
    }
}
