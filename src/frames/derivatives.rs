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
        let (ix, iy) = gradient(&mean);
        Self { ix, iy, it }
    }
}

/// ∂/∂x and ∂/∂y of a picture by the five-point stencil, the border repeated outwards.
pub fn gradient(picture: &Grid<f32>) -> (Grid<f32>, Grid<f32>) {
    let (width, height) = (picture.width(), picture.height());
    let stencil = |a: f32, b: f32, c: f32, d: f32| (a - d + 8.0 * (c - b)) / 12.0;
    let ix = Grid::from_fn(width, height, |x, y| {
        let row = picture.row(y);
        let at = |i: usize| row[i.min(width - 1)];
        stencil(
            at(x.saturating_sub(2)),
            at(x.saturating_sub(1)),
            at(x + 1),
            at(x + 2),
        )
    });
    let iy = Grid::from_fn(width, height, |x, y| {
        let at = |j: usize| picture[(x, j.min(height - 1))];
        stencil(
            at(y.saturating_sub(2)),
            at(y.saturating_sub(1)),
            at(y + 1),
            at(y + 2),
        )
    });
    (ix, iy)
}
