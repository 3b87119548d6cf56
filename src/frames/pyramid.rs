//! Halving a picture: each coarse pixel from 4×4 with weights (1, 3, 3, 1)/8 both ways.
//!
//! Coarse pixel (x, y) covers fine pixels 2x, 2x+1 by 2y, 2y+1; its centre is at (2x + ½, 2y + ½).

use crate::camera::Camera;
use crate::grid::Grid;

/// A picture of half the size; an odd last row or column is dropped.
pub fn halved(picture: &Grid<f32>) -> Grid<f32> {
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

/// The camera that sees the halved picture.
pub fn halved_camera(camera: &Camera) -> Camera {
    Camera {
        focal: camera.focal / 2.0,
        cx: (camera.cx - 0.5) / 2.0,
        cy: (camera.cy - 0.5) / 2.0,
    }
}
