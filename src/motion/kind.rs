//! What a motion shows of itself: which of still, rotation, translation and full it is.

use serde::Serialize;

use crate::camera::{Camera, RigidMotion};

/// What a motion is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
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

impl Kind {
    /// The kind of a motion as far as it shows, for a region whose mean 1/Z is 1.
    pub fn seen(camera: &Camera, motion: &RigidMotion) -> Self {
        let moves = camera.focal * motion.translation.length() > UNSEEN;
        let turns = camera.focal * motion.rotation.length() > UNSEEN;
        match (moves, turns) {
            (false, false) => Kind::Still,
            (false, true) => Kind::Rotation,
            (true, false) => Kind::Translation,
            (true, true) => Kind::Full,
        }
    }

    /// Whether T is free, and depth shows.
    pub fn translates(self) -> bool {
        matches!(self, Kind::Translation | Kind::Full)
    }

    /// Whether ω is free.
    pub fn rotates(self) -> bool {
        matches!(self, Kind::Rotation | Kind::Full)
    }
}
