//! Motion models: which of still, rotation, translation and full a motion is, as far as it shows.

use serde::{Deserialize, Serialize};

use crate::camera::{Camera, RigidMotion};

/// The motion model of a region.
///
/// ```
/// use relievo::{Camera, MotionModel, RigidMotion};
///
/// let camera = Camera::centred(320.0, 320, 240)?;
/// let mut motion = RigidMotion::default();
/// assert_eq!(MotionModel::seen(&camera, &motion), MotionModel::Still);
/// motion.translation.x = 0.01;
/// assert_eq!(MotionModel::seen(&camera, &motion), MotionModel::Translation);
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(rename_all = "lowercase")]
pub enum MotionModel {
    /// T = 0 and ω = 0.
    Still,
    /// T = 0: depth does not show.
    Rotation,
    /// ω = 0.
    Translation,
    /// Both.
    #[default]
    Full,
}

/// Image motion below which a part of a motion cannot be told from none, in pixels: the error that
/// derivatives of sampled brightness leave.
const UNSEEN: f64 = 0.1;

impl MotionModel {
    /// The kind of a motion as far as it shows, for a region whose mean 1/Z is 1.
    pub fn seen(camera: &Camera, motion: &RigidMotion) -> Self {
        let moves = camera.focal * motion.translation.length() > UNSEEN;
        let turns = camera.focal * motion.rotation.length() > UNSEEN;
        match (moves, turns) {
            (false, false) => MotionModel::Still,
            (false, true) => MotionModel::Rotation,
            (true, false) => MotionModel::Translation,
            (true, true) => MotionModel::Full,
        }
    }

    /// Whether T is free, and depth shows.
    pub fn translates(self) -> bool {
        matches!(self, MotionModel::Translation | MotionModel::Full)
    }

    /// Whether ω is free.
    pub fn rotates(self) -> bool {
        matches!(self, MotionModel::Rotation | MotionModel::Full)
    }
}
