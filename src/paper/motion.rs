//! Step 1: the (T, ω) of each region that minimises Σ ψ² over its pixels, with Z held fixed.
//!
//! ψ = It + (s/Z, q)·(T, ω) is linear in the six unknowns, so that this is one 6×6 system of normal equations a region.
//! A ridge pulls f·ω, which has T's unit of pixels, towards 0: a small region cannot tell t1 from w2 nor t2 from −w1.
//! One walk over the rows: the seven numbers of ψ at every pixel of a row, then their products summed over the
//! stretches of each region.

use glam::DVec3;

use super::rows::runs;
use crate::camera::{Camera, RigidMotion};
use crate::frames::Derivatives;
use crate::grid::Grid;
use crate::linalg::{dot, solve as solve_positive};

/// Relative weight that keeps a region without gradients solvable: its motion is 0.
const FLOOR: f64 = 1e-9;

/// The motions of the pixels labelled 0 to `regions` − 1, for depth `z`; T is in units of `z` per frame, ω in radians
/// per frame.
///
/// `ridge` is the weight of |f ω|² as a share of the mean diagonal of the translation's block.
/// `None` where a region has no texture to measure with.
pub fn least_squares(
    camera: &Camera,
    derivatives: &Derivatives,
    z: &Grid<f32>,
    labels: &Grid<u8>,
    regions: usize,
    ridge: f64,
) -> Vec<Option<RigidMotion>> {
    let mut sums = vec![NormalEquations::default(); regions];
    let mut rows: [Vec<f32>; 6] = std::array::from_fn(|_| vec![0.0; z.width()]);
    let Derivatives { ix, iy, it } = derivatives;
    for y in 0..z.height() {
        write_rows(camera, y, [ix.row(y), iy.row(y), z.row(y)], &mut rows);
        for (k, run) in runs(labels.row(y)) {
            if let Some(sums) = sums.get_mut(k) {
                sums.pixels += run.len();
                for i in 0..6 {
                    for j in 0..=i {
                        sums.normal[i][j] += dot(&rows[i][run.clone()], &rows[j][run.clone()]);
                    }
                    sums.right[i] -= dot(&rows[i][run.clone()], &it.row(y)[run.clone()]);
                }
            }
        }
    }
    let solved = sums.iter().map(|sums| sums.solve(camera.focal, ridge));
    solved.collect()
}

/// (s/Z, q) at every pixel of row `py`, a slice for each of the six.
fn write_rows(
    camera: &Camera,
    py: usize,
    [ix, iy, z]: [&[f32]; 3],
    [s1, s2, s3, q1, q2, q3]: &mut [Vec<f32>; 6],
) {
    let (f, cx) = (camera.focal as f32, camera.cx as f32);
    let y = (py as f64 - camera.cy) as f32;
    let per_focal = f.recip();
    let n = z.len();
    let (ix, iy) = (&ix[..n], &iy[..n]);
    let (s1, s2, s3) = (&mut s1[..n], &mut s2[..n], &mut s3[..n]);
    let (q1, q2, q3) = (&mut q1[..n], &mut q2[..n], &mut q3[..n]);
    for i in 0..n {
        let (x, gx, gy) = (i as i32 as f32 - cx, ix[i], iy[i]);
        let rho = z[i].recip();
        let e = x * gx + y * gy;
        s1[i] = f * gx * rho;
        s2[i] = f * gy * rho;
        s3[i] = -e * rho;
        q1[i] = -f * gy - y * e * per_focal;
        q2[i] = f * gx + x * e * per_focal;
        q3[i] = x * gy - y * gx;
    }
}

/// Σ (s/Z, q) (s/Z, q)ᵀ, of which the lower triangle is kept, and −Σ (s/Z, q) It.
#[derive(Clone, Default)]
struct NormalEquations {
    normal: [[f64; 6]; 6],
    right: [f64; 6],
    pixels: usize,
}

impl NormalEquations {
    fn solve(&self, focal: f64, ridge: f64) -> Option<RigidMotion> {
        let mut normal = self.normal;
        let mean = (normal[0][0] + normal[1][1]) / 2.0;
        let floor = FLOOR * (focal * focal * self.pixels as f64 + mean);
        for (i, row) in normal.iter_mut().enumerate() {
            row[i] += floor + if i < 3 { 0.0 } else { ridge * mean };
        }
        let [t1, t2, t3, w1, w2, w3] = solve_positive(&normal, &self.right)?;
        Some(RigidMotion {
            translation: DVec3::new(t1, t2, t3),
            rotation: DVec3::new(w1, w2, w3),
        })
    }
}
