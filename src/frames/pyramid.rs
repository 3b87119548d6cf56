//! Halving a picture: smoothed with σ = 0.9, then the mean of each 2×2 pixels.
//!
//! Coarse pixel (x, y) covers fine pixels 2x, 2x+1 by 2y, 2y+1; its centre is at (2x + ½, 2y + ½).

use super::gaussian::blur;
use crate::camera::Camera;
use crate::grid::Grid;

/// A picture of half the size; an odd last row or column is dropped.
pub fn halved(picture: &Grid<f32>) -> Grid<f32> {
    let smooth = blur(picture, 0.9);
    Grid::from_fn(picture.width() / 2, picture.height() / 2, |x, y| {
        let (x, y) = (2 * x, 2 * y);
        0.25 * (smooth[(x, y)] + smooth[(x + 1, y)] + smooth[(x, y + 1)] + smooth[(x + 1, y + 1)])
    })
}

/// The camera that sees the halved picture.
pub fn halved_camera(camera: &Camera) -> Camera {
    Camera {
        focal: camera.focal / 2.0,
        cx: (camera.cx - 0.5) / 2.0,
        cy: (camera.cy - 0.5) / 2.0,
    }
}

/// A field of a halved picture read at the pixels of a `width × height` one.
pub fn doubled(field: &Grid<f32>, width: usize, height: usize) -> Grid<f32> {
    Grid::from_fn(width, height, |x, y| {
        field.bilinear((x as f32 - 0.5) / 2.0, (y as f32 - 0.5) / 2.0)
    })
}
