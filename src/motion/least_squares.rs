//! Motion with depth held fixed: the (T, ω) of a region that minimises Σ ψ² over its pixels.
//!
//! ψ = It + (s/Z, q)·(T, ω) is linear in the six unknowns, so that this is one 6×6 system of normal
//! equations. A ridge pulls f·ω, which has T's unit of pixels, towards 0: a small region cannot tell
//! t1 from w2 nor t2 from −w1.

use glam::DVec3;

use super::solve_positive;
use crate::camera::{Camera, RigidMotion};
use crate::constraint::Coefficients;
use crate::frames::Derivatives;
use crate::grid::Grid;

/// The motion of the pixels labelled `label`, for inverse depth `rho`; T is in units of 1/`rho` per
/// frame, ω in radians per frame.
///
/// `ridge` is the weight of |f ω|² as a share of the mean diagonal of the translation's block.
/// `None` when the region has no texture to measure with.
pub fn least_squares(
    camera: &Camera,
    derivatives: &Derivatives,
    rho: &Grid<f32>,
    labels: &Grid<u8>,
    label: u8,
    ridge: f64,
) -> Option<RigidMotion> {
    let mut normal = [[0.0; 6]; 6];
    let mut right = [0.0; 6];
    let mut pixels = 0usize;
    let Derivatives { ix, iy, it } = derivatives;
    for py in 0..labels.height() {
        for px in 0..labels.width() {
            let at = (px, py);
            if labels[at] != label {
                continue;
            }
            pixels += 1;
            let c = Coefficients::at(
                camera,
                px as f64,
                py as f64,
                f64::from(ix[at]),
                f64::from(iy[at]),
            );
            let s = c.s * f64::from(rho[at]);
            let row = [s.x, s.y, s.z, c.q.x, c.q.y, c.q.z];
            for i in 0..6 {
                for j in 0..=i {
                    normal[i][j] += row[i] * row[j];
                }
                right[i] -= row[i] * f64::from(it[at]);
            }
        }
    }
    // A quantum of brightness per pixel keeps a region without gradients solvable: its motion is 0.
    let mean = (normal[0][0] + normal[1][1]) / 2.0;
    let floor = 1e-9 * camera.focal * camera.focal * pixels as f64 + 1e-9 * mean;
    for (i, row) in normal.iter_mut().enumerate() {
        row[i] += floor + if i < 3 { 0.0 } else { ridge * mean };
    }
    let x = solve_positive(&normal, &right)?;
    Some(RigidMotion {
        translation: DVec3::new(x[0], x[1], x[2]),
        rotation: DVec3::new(x[3], x[4], x[5]),
    })
}
