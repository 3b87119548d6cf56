//! What is estimated of a region: a motion model, T, R(ω) and the surface that they move.

use glam::{DMat3, DVec3};

use super::candidates::Candidate;
use super::surface::Surface;
use crate::camera::{Camera, RigidMotion, omega};
use crate::layered::view::View;
use crate::linalg::tangents;
use crate::motion_model::MotionModel;

/// What is estimated of a region.
#[derive(Clone, Debug, Default)]
pub(crate) struct State {
    pub model: MotionModel,
    pub translation: DVec3,
    pub rotation: DMat3,
    pub surface: Surface,
}

impl State {
    /// Nothing moves; a flat surface.
    pub fn still(surface: Surface) -> Self {
        Self {
            model: MotionModel::Still,
            translation: DVec3::ZERO,
            rotation: DMat3::IDENTITY,
            surface,
        }
    }

    /// The same surface, moving as the candidate does.
    pub fn moving(&self, model: MotionModel, by: &Candidate) -> Self {
        Self {
            model,
            translation: by.translation,
            rotation: by.rotation,
            surface: self.surface.clone(),
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
        omega(&self.rotation)
    }
}
