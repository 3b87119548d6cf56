//! The three derivatives of brightness, Ix, Iy (grey levels per pixel) and It (grey levels per frame).
//!
//! Space: the five-point stencil (1, −8, 0, 8, −1)/12, exact for polynomials up to degree four, on
//! the mean of both frames. Time: the difference of the frames. Both therefore belong to the moment
//! halfway between them, where a motion over the whole interval is best linearised.

use crate::grid::Grid;

/// Ix, Iy and It at every pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivatives {
    /// ∂I/∂x, grey levels per pixel.
    pub ix: Grid<f32>,
    /// ∂I/∂y, grey levels per pixel, downwards.
    pub iy: Grid<f32>,
    /// ∂I/∂t, grey levels per frame.
    pub it: Grid<f32>,
}

impl Derivatives {
    /// The derivatives of two frames of the same size.
    pub fn between(first: &Grid<f32>, second: &Grid<f32>) -> Self {
        let mut mean = first.clone();
        let mut it = second.clone();
        for ((m, t), &a) in mean
            .data_mut()
            .iter_mut()
            .zip(it.data_mut())
            .zip(first.data())
        {
            let b = *t;
            *m = 0.5 * (a + b);
            *t = b - a;
        }
        let [ix, iy] = gradient(&mean);
        Self { ix, iy, it }
    }
}

/// ∂/∂x and ∂/∂y of a picture by the five-point stencil, the border repeated outwards.
pub fn gradient(picture: &Grid<f32>) -> [Grid<f32>; 2] {
    let (width, height) = (picture.width(), picture.height());
    let stencil = |a: f32, b: f32, c: f32, d: f32| (a - d + 8.0 * (c - b)) / 12.0;
    let mut ix = Grid::new(width, height, 0.0f32);
    let mut iy = ix.clone();
    let mut padded = vec![0.0f32; width + 4];
    for y in 0..height {
        let row = picture.row(y);
        padded[..2].fill(row[0]);
        padded[2..width + 2].copy_from_slice(row);
        padded[width + 2..].fill(row[width - 1]);
        for (out, v) in ix.row_mut(y).iter_mut().zip(padded.windows(5)) {
            *out = stencil(v[0], v[1], v[3], v[4]);
        }
        let at = |down: usize| picture.row((y + down).saturating_sub(2).min(height - 1));
        let (a, b, c, d) = (at(0), at(1), at(3), at(4));
        for (x, out) in iy.row_mut(y).iter_mut().enumerate() {
            *out = stencil(a[x], b[x], c[x], d[x]);
        }
    }
    [ix, iy]
}
