//! What is estimated of a region: T, R(ω) and the surface that they move.

use glam::{DMat3, DQuat, DVec3};

use super::surface::Surface;
use crate::camera::{Camera, RigidMotion};
use crate::layered::view::View;
use crate::linalg::tangents;

/// What is estimated of a region.
#[derive(Clone, Debug, Default)]
pub(crate) struct State {
    pub translation: DVec3,
    pub rotation: DMat3,
    pub surface: Surface,
}

impl State {
    /// Nothing moves; a flat surface.
    pub fn still(surface: Surface) -> Self {
        Self {
            translation: DVec3::ZERO,
            rotation: DMat3::IDENTITY,
            surface,
        }
    }

    /// Where it leads, seen by a camera.
    pub fn view(&self, camera: &Camera) -> View {
        View::new(camera, self.rotation, self.translation)
    }

    /// Two directions perpendicular to T and as long.
    pub fn tangent(&self) -> [DVec3; 2] {
        let length = self.translation.length();
        let direction = self.translation.try_normalize();
        direction.map_or_else(Default::default, |t| tangents(t).map(|b| b * length))
    }

    /// T and ω.
    pub fn motion(&self) -> RigidMotion {
        RigidMotion {
            translation: self.translation,
            rotation: self.omega(),
        }
    }

    /// ω, radians per frame.
    pub fn omega(&self) -> DVec3 {
        DQuat::from_mat3(&self.rotation).to_scaled_axis()
    }
}

/// The matrix that turns by ω.
pub(crate) fn turn(omega: DVec3) -> DMat3 {
    DMat3::from_quat(DQuat::from_scaled_axis(omega))
}
