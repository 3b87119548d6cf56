//! A smaller picture whose pixels are the means of n × n pixels each, of brightness as encoded, as everything that the
//! solver reads. Columns and rows that fill no pixel, n − 1 at most, are left out on the right and below.
//!
//! Pixel x of the smaller picture covers pixels nx … nx + n − 1; its centre is at n (x + ½) − ½.

use crate::camera::Camera;
use crate::grid::Grid;

/// Brightness, shrunk `n` times.
pub fn shrunk(picture: &Grid<f32>, n: usize) -> Grid<f32> {
    let width = picture.width() / n;
    let mut out = Grid::new(width, picture.height() / n, 0.0f32);
    let share = 1.0 / (n * n) as f32;
    for y in 0..out.height() {
        let row = out.row_mut(y);
        for j in 0..n {
            let from = picture.row(n * y + j).chunks_exact(n);
            for (sum, few) in row.iter_mut().zip(from) {
                *sum += few.iter().sum::<f32>();
            }
        }
        row.iter_mut().for_each(|sum| *sum *= share);
    }
    out
}

/// Colours, shrunk `n` times and rounded.
pub fn shrunk_colours(picture: &Grid<[u8; 3]>, n: usize) -> Grid<[u8; 3]> {
    let width = picture.width() / n;
    let mut out = Grid::new(width, picture.height() / n, [0u8; 3]);
    let all = (n * n) as u32;
    let mut sums = vec![[0u32; 3]; width];
    for y in 0..out.height() {
        sums.fill([0; 3]);
        for j in 0..n {
            let from = picture.row(n * y + j).chunks_exact(n);
            for (sum, few) in sums.iter_mut().zip(from) {
                for colour in few {
                    for (s, &c) in sum.iter_mut().zip(colour) {
                        *s += u32::from(c);
                    }
                }
            }
        }
        for (to, sum) in out.row_mut(y).iter_mut().zip(&sums) {
            *to = sum.map(|s| ((s + all / 2) / all) as u8);
        }
    }
    out
}

/// 1 where any of the pixels that were put together is 1.
pub fn shrunk_mask(mask: &Grid<u8>, n: usize) -> Grid<u8> {
    Grid::from_fn(mask.width() / n, mask.height() / n, |x, y| {
        let any = |j| {
            mask.row(n * y + j)[n * x..n * (x + 1)]
                .iter()
                .any(|&m| m != 0)
        };
        u8::from((0..n).any(any))
    })
}

/// The camera that sees the picture shrunk `n` times.
pub fn shrunk_camera(camera: &Camera, n: usize) -> Camera {
    let n = n as f64;
    Camera {
        focal: camera.focal / n,
        cx: (camera.cx + 0.5) / n - 0.5,
        cy: (camera.cy + 0.5) / n - 0.5,
    }
}
