//! Camera, rigid motion, and the image motion that it gives: equation (1).
//!
//! The camera sits at the origin, x to the right, y down, Z forward. With image coordinates
//! (x, y) in pixels from the principal point, focal length f in pixels, T in units of depth per
//! frame and ω in radians per frame, dP/dt = T + ω × P projects to
//!
//! ```text
//! (1)  u = (f t1 − x t3)/Z − (xy/f) w1 + ((f²+x²)/f) w2 − y w3
//!      v = (f t2 − y t3)/Z − ((f²+y²)/f) w1 + (xy/f) w2 + x w3
//! ```
//!
//! Depth enters only as its inverse ρ = 1/Z, which therefore is what the functions here take: a
//! point at infinity is ρ = 0 and needs no exception.

use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::error::Error;

/// Least and greatest focal length, in pixels: from nearly a half-space to a telescope.
pub const FOCAL_RANGE: [f64; 2] = [1.0, 1e6];
/// How far from the frame's first pixel the principal point may be, in pixels.
pub const FARTHEST_CENTRE: f64 = 1e6;

/// A pinhole camera with square pixels.
///
/// ```
/// use relievo::{Camera, RigidMotion};
///
/// let camera = Camera::centred(300.0, 320, 240)?;
/// let sideways = RigidMotion { translation: [0.02, 0.0, 0.0].into(), ..Default::default() };
/// // f t1 / Z = 300 · 0.02 / 2 pixels to the right at depth 2.
/// let (u, v) = camera.image_motion(&sideways, 159.5, 119.5, 1.0 / 2.0);
/// assert!((u - 3.0).abs() < 1e-12 && v == 0.0);
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// Focal length in pixels, within [`FOCAL_RANGE`].
    pub focal: f64,
    /// Column of the principal point, pixel (0, 0) being the centre of the top-left pixel.
    pub cx: f64,
    /// Row of the principal point.
    pub cy: f64,
}

/// A rigid motion from one frame to the next: P' = R(ω) P + T, to first order dP/dt = T + ω × P.
///
/// ```
/// use std::f64::consts::FRAC_PI_2;
///
/// use relievo::RigidMotion;
/// use relievo::glam::DVec3;
///
/// // A quarter turn about the line of sight, then one unit away from the camera.
/// let motion = RigidMotion {
///     translation: DVec3::Z,
///     rotation: FRAC_PI_2 * DVec3::Z,
/// };
/// assert!((motion.apply(DVec3::X) - DVec3::new(0.0, 1.0, 1.0)).length() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RigidMotion {
    /// T, in units of depth per frame.
    pub translation: DVec3,
    /// ω, in radians per frame: its direction is the axis, its length the angle.
    pub rotation: DVec3,
}

impl Camera {
    /// A camera with focal length `focal` whose principal point is the centre of a
    /// `width × height` frame.
    ///
    /// # Errors
    /// [`Error::Focal`] unless `focal` is within [`FOCAL_RANGE`].
    pub fn centred(focal: f64, width: usize, height: usize) -> Result<Self, Error> {
        let (cx, cy) = ((width as f64 - 1.0) / 2.0, (height as f64 - 1.0) / 2.0);
        Self::new(focal, cx, cy)
    }

    /// A camera with a principal point of its own.
    ///
    /// # Errors
    /// [`Error::Focal`] unless `focal` is within [`FOCAL_RANGE`], [`Error::Centre`] unless both coordinates of the
    /// principal point are within ±[`FARTHEST_CENTRE`].
    pub fn new(focal: f64, cx: f64, cy: f64) -> Result<Self, Error> {
        let [least, greatest] = FOCAL_RANGE;
        if !(least..=greatest).contains(&focal) {
            return Err(Error::Focal(focal));
        }
        let near = |c: f64| c.abs() <= FARTHEST_CENTRE;
        if !(near(cx) && near(cy)) {
            return Err(Error::Centre(cx, cy));
        }
        Ok(Self { focal, cx, cy })
    }

    /// The direction (x/f, y/f, 1) in which pixel `(px, py)` looks.
    pub fn ray(&self, px: f64, py: f64) -> DVec3 {
        DVec3::new(
            (px - self.cx) / self.focal,
            (py - self.cy) / self.focal,
            1.0,
        )
    }

    /// The pixel at which a point in front of the camera is seen.
    pub fn project(&self, point: DVec3) -> (f64, f64) {
        (
            self.focal * point.x / point.z + self.cx,
            self.focal * point.y / point.z + self.cy,
        )
    }

    /// Equation (1): image motion in pixels per frame of what pixel `(px, py)` shows, at inverse
    /// depth `rho`.
    pub fn image_motion(&self, motion: &RigidMotion, px: f64, py: f64, rho: f64) -> (f64, f64) {
        let f = self.focal;
        let (x, y) = (px - self.cx, py - self.cy);
        let (t, w) = (motion.translation, motion.rotation);
        let u = (f * t.x - x * t.z) * rho - x * y / f * w.x + (f * f + x * x) / f * w.y - y * w.z;
        let v = (f * t.y - y * t.z) * rho - (f * f + y * y) / f * w.x + x * y / f * w.y + x * w.z;
        (u, v)
    }

    /// Where the point that pixel `(px, py)` shows is seen a whole frame later, less where it is
    /// seen now: π(R(ω) P + T) − π(P). Equation (1) is its first order; past a few pixels the
    /// difference counts. `None` when the point passes behind the camera.
    pub fn displacement(
        &self,
        motion: &RigidMotion,
        px: f64,
        py: f64,
        rho: f64,
    ) -> Option<(f64, f64)> {
        // P·ρ = ray, so that P' · ρ = R ray + ρ T: no division by a small ρ.
        let moved = motion.matrix() * self.ray(px, py) + motion.translation * rho;
        if moved.z <= 1e-6 {
            return None;
        }
        let (qx, qy) = self.project(moved);
        Some((qx - px, qy - py))
    }
}

/// The matrix that turns by ω.
pub(crate) fn turn(omega: DVec3) -> DMat3 {
    DMat3::from_quat(DQuat::from_scaled_axis(omega))
}

/// ω of a matrix that turns.
pub(crate) fn omega(rotation: &DMat3) -> DVec3 {
    DQuat::from_mat3(rotation).to_scaled_axis()
}

impl RigidMotion {
    /// The rotation matrix R(ω) = exp(`[ω]×`).
    pub fn matrix(&self) -> DMat3 {
        turn(self.rotation)
    }

    /// Where a point of the body is one frame later.
    pub fn apply(&self, point: DVec3) -> DVec3 {
        self.matrix() * point + self.translation
    }
}
