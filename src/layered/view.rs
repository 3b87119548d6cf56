//! Where pixels go under one rigid motion, in single precision for inner loops.
//!
//! With p = R ray(x, y) and m = (T_x, T_y) − T_z π(p), a point at inverse depth ρ is seen in the second frame at
//!
//! ```text
//! π(p + ρ T) = π(p) + u m,        u = ρ/(p_z + ρ T_z),     ρ = u p_z/(1 − u T_z)
//! ```
//!
//! so it moves along a line, by f |m| pixels for each unit of u. u grows with ρ.

use glam::{DMat3, DVec3};

use crate::camera::{Camera, RigidMotion};
use crate::grid::Grid;

/// A rigid motion seen by a camera.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub focal: f32,
    centre: [f32; 2],
    /// R by rows.
    pub rotation: [[f32; 3]; 3],
    /// T.
    pub translation: [f32; 3],
}

impl View {
    /// What `camera` sees of R and T.
    pub fn new(camera: &Camera, rotation: DMat3, translation: DVec3) -> Self {
        let rows = rotation.transpose().to_cols_array_2d();
        Self {
            focal: camera.focal as f32,
            centre: [camera.cx as f32, camera.cy as f32],
            rotation: rows.map(|row| row.map(|v| v as f32)),
            translation: translation.to_array().map(|v| v as f32),
        }
    }

    /// What `camera` sees of a motion.
    pub fn of(camera: &Camera, motion: &RigidMotion) -> Self {
        Self::new(camera, motion.matrix(), motion.translation)
    }

    /// R ray of pixel (x, y).
    #[inline(always)]
    pub fn turned(&self, x: usize, y: usize) -> [f32; 3] {
        let (share, [cx, cy]) = (1.0 / self.focal, self.centre);
        let (x, y) = ((x as f32 - cx) * share, (y as f32 - cy) * share);
        self.rotation.map(|r| r[0] * x + r[1] * y + r[2])
    }

    /// The pixel of the second frame along q.
    #[inline(always)]
    pub fn pixel(&self, q: [f32; 3]) -> [f32; 2] {
        let near = self.focal / q[2].max(1e-3);
        [q[0] * near + self.centre[0], q[1] * near + self.centre[1]]
    }

    /// Where pixel (x, y) goes at inverse depth ρ.
    #[inline(always)]
    pub fn target(&self, x: usize, y: usize, rho: f32) -> [f32; 2] {
        let (p, t) = (self.turned(x, y), self.translation);
        self.pixel([p[0] + rho * t[0], p[1] + rho * t[1], p[2] + rho * t[2]])
    }

    /// The pixel at u = 0, and by how many pixels it moves for each unit of u.
    pub fn line(&self, p: [f32; 3]) -> ([f32; 2], [f32; 2]) {
        let t = self.translation;
        let (px, py) = (p[0] / p[2], p[1] / p[2]);
        let step = [
            self.focal * (t[0] - t[2] * px),
            self.focal * (t[1] - t[2] * py),
        ];
        (self.pixel([px, py, 1.0]), step)
    }

    /// Pixels of image motion for each unit of ρ: the median of f |m| over the support, at least a millionth.
    pub fn pixels_a_rho(&self, support: &Grid<bool>) -> f32 {
        let mut speeds = Vec::new();
        for y in (0..support.height()).step_by(4) {
            for x in (0..support.width()).step_by(4) {
                if support[(x, y)] {
                    let (_, [u, v]) = self.line(self.turned(x, y));
                    speeds.push(u.hypot(v));
                }
            }
        }
        if speeds.is_empty() {
            return 1.0;
        }
        let middle = speeds.len() / 2;
        (*speeds.select_nth_unstable_by(middle, f32::total_cmp).1).max(1e-6)
    }

    /// ρ of u.
    pub fn rho(&self, p_z: f32, u: f32) -> f32 {
        u * p_z / (1.0 - u * self.translation[2]).max(0.02)
    }

    /// u of ρ.
    pub fn along(&self, p_z: f32, rho: f32) -> f32 {
        rho / (p_z + rho * self.translation[2]).max(0.02)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_camera() {
        let camera = Camera::centred(300.0, 320, 240).unwrap();
        let motion = RigidMotion {
            translation: DVec3::new(0.03, -0.02, 0.05),
            rotation: DVec3::new(0.01, 0.02, -0.015),
        };
        let view = View::of(&camera, &motion);
        for (x, y, rho) in [(10, 20, 0.3), (300, 200, 2.0), (160, 120, 1.0)] {
            let (u, v) = camera
                .displacement(&motion, x as f64, y as f64, rho)
                .unwrap();
            let [tx, ty] = view.target(x, y, rho as f32);
            assert!((f64::from(tx) - x as f64 - u).abs() < 1e-3);
            assert!((f64::from(ty) - y as f64 - v).abs() < 1e-3);
            let p = view.turned(x, y);
            let along = view.along(p[2], rho as f32);
            assert!((view.rho(p[2], along) - rho as f32).abs() < 1e-5);
            let (start, step) = view.line(p);
            assert!((start[0] + along * step[0] - tx).abs() < 1e-3);
            assert!((start[1] + along * step[1] - ty).abs() < 1e-3);
        }
    }
}
