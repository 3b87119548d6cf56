//! The 3-D rigid motion constraint: what brightness says of depth and motion, with no flow left in it.
//!
//! ```text
//! ψ = It + s·T/Z + q·ω,   e = x Ix + y Iy
//! s = ( f Ix, f Iy, −e )      q = ( −f Iy − y e/f,  f Ix + x e/f,  x Iy − y Ix )
//! ```
//!
//! ψ is in grey levels; (x, y) in pixels from the principal point. It is equation (1) put into
//! Ix u + Iy v + It = 0.

use std::ops::Range;

use glam::DVec3;

use crate::camera::{Camera, RigidMotion};
use crate::frames::Derivatives;

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

/// One motion along one row of pixels, where equation (1) is a polynomial in x:
///
/// ```text
/// u = (f t1 − x t3)/Z + u0 + u1 x + u2 x²      v = (f t2 − y t3)/Z + v0 + v1 x
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RowMotion {
    cx: f32,
    /// f t1, −t3 and f t2 − y t3.
    moves: [f32; 3],
    /// u0, u1 and u2.
    turn_u: [f32; 3],
    /// v0 and v1.
    turn_v: [f32; 2],
}

impl RowMotion {
    /// `motion` along row `py`.
    pub fn new(camera: &Camera, motion: &RigidMotion, py: usize) -> Self {
        let (f, y) = (camera.focal, py as f64 - camera.cy);
        let (t, w) = (motion.translation, motion.rotation);
        Self {
            cx: camera.cx as f32,
            moves: [f * t.x, -t.z, f * t.y - y * t.z].map(|c| c as f32),
            turn_u: [f * w.y - y * w.z, -y / f * w.x, w.y / f].map(|c| c as f32),
            turn_v: [-(f + y * y / f) * w.x, y / f * w.y + w.z].map(|c| c as f32),
        }
    }

    /// ψ = slope/Z + offset for `pixels` of row `py`: writes the slope s·T and the offset It + q·ω.
    pub fn along_depth(
        &self,
        derivatives: &Derivatives,
        py: usize,
        pixels: Range<usize>,
        slope: &mut [f32],
        offset: &mut [f32],
    ) {
        let first = pixels.start as f32 - self.cx;
        let n = pixels.len();
        let Derivatives { ix, iy, it } = derivatives;
        let [ix, iy, it] = [ix, iy, it].map(|d| &d.row(py)[pixels.clone()][..n]);
        let (slope, offset) = (&mut slope[..n], &mut offset[..n]);
        for i in 0..n {
            (slope[i], offset[i]) = self.at(i as i32 as f32 + first, ix[i], iy[i], it[i]);
        }
    }

    /// ψ for `pixels` of row `py` at depths `z`, which hold these pixels alone; in grey levels.
    pub fn residual(
        &self,
        derivatives: &Derivatives,
        py: usize,
        pixels: Range<usize>,
        z: &[f32],
        psi: &mut [f32],
    ) {
        let first = pixels.start as f32 - self.cx;
        let n = pixels.len();
        let Derivatives { ix, iy, it } = derivatives;
        let [ix, iy, it] = [ix, iy, it].map(|d| &d.row(py)[pixels.clone()][..n]);
        let (z, psi) = (&z[..n], &mut psi[..n]);
        for i in 0..n {
            let (slope, offset) = self.at(i as i32 as f32 + first, ix[i], iy[i], it[i]);
            psi[i] = slope / z[i] + offset;
        }
    }

    /// Slope and offset at column `x`, in pixels from the principal point: ∇I against the two parts of (1), which is
    /// cheaper than s and q.
    #[inline]
    fn at(&self, x: f32, ix: f32, iy: f32, it: f32) -> (f32, f32) {
        let [m0, m1, m2] = self.moves;
        let [u0, u1, u2] = self.turn_u;
        let [v0, v1] = self.turn_v;
        let slope = ix * (m0 + m1 * x) + iy * m2;
        let offset = it + ix * (u0 + (u1 + u2 * x) * x) + iy * (v0 + v1 * x);
        (slope, offset)
    }
}
