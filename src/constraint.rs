//! The 3-D rigid motion constraint: what brightness says of depth and motion, with no flow left in it.
//!
//! ```text
//! ψ = It + s·T/Z + q·ω,   e = x Ix + y Iy
//! s = ( f Ix, f Iy, −e )      q = ( −f Iy − y e/f,  f Ix + x e/f,  x Iy − y Ix )
//! ```
//!
//! ψ is in grey levels; (x, y) in pixels from the principal point. It is equation (1) put into
//! Ix u + Iy v + It = 0.

use glam::DVec3;

use crate::camera::{Camera, RigidMotion};
use crate::frames::Derivatives;
use crate::grid::Grid;

/// The vectors s and q at an image point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// Multiplies T/Z.
    pub s: DVec3,
    /// Multiplies ω.
    pub q: DVec3,
}

impl Coefficients {
    /// s and q for a brightness gradient `(ix, iy)` at pixel `(px, py)`.
    pub fn at(camera: &Camera, px: f64, py: f64, ix: f64, iy: f64) -> Self {
        let f = camera.focal;
        let (x, y) = (px - camera.cx, py - camera.cy);
        let e = x * ix + y * iy;
        Self {
            s: DVec3::new(f * ix, f * iy, -e),
            q: DVec3::new(-f * iy - y * e / f, f * ix + x * e / f, x * iy - y * ix),
        }
    }

    /// ψ for a temporal derivative `it`, a motion, and inverse depth `rho`.
    pub fn psi(&self, it: f64, motion: &RigidMotion, rho: f64) -> f64 {
        it + self.s.dot(motion.translation) * rho + self.q.dot(motion.rotation)
    }
}

/// Calls `visit(pixel index, slope, offset)` for every pixel, where ψ = slope · ρ + offset: the slope
/// is s·T, the offset It + q·ω. That is all which depth and curves need to know of a motion.
pub fn along_depth(
    camera: &Camera,
    derivatives: &Derivatives,
    motion: &RigidMotion,
    mut visit: impl FnMut(usize, f32, f32),
) {
    let Derivatives { ix, iy, it } = derivatives;
    let (width, height) = (ix.width(), ix.height());
    let f = camera.focal;
    let (t, w) = (motion.translation, motion.rotation);
    for py in 0..height {
        let y = py as f64 - camera.cy;
        for px in 0..width {
            let x = px as f64 - camera.cx;
            let i = py * width + px;
            let (gx, gy) = (f64::from(ix.data()[i]), f64::from(iy.data()[i]));
            // ∇I against the two parts of (1): cheaper than building s and q.
            let slope = gx * (f * t.x - x * t.z) + gy * (f * t.y - y * t.z);
            let turn_u = -x * y / f * w.x + (f + x * x / f) * w.y - y * w.z;
            let turn_v = -(f + y * y / f) * w.x + x * y / f * w.y + x * w.z;
            let offset = f64::from(it.data()[i]) + gx * turn_u + gy * turn_v;
            visit(i, slope as f32, offset as f32);
        }
    }
}

/// ψ at every pixel, in grey levels, for one motion and a field of inverse depth.
pub fn residual(
    camera: &Camera,
    derivatives: &Derivatives,
    motion: &RigidMotion,
    rho: &Grid<f32>,
) -> Grid<f32> {
    let mut psi = Grid::new(rho.width(), rho.height(), 0.0f32);
    let out = psi.data_mut();
    along_depth(camera, derivatives, motion, |i, slope, offset| {
        out[i] = slope * rho.data()[i] + offset;
    });
    psi
}
