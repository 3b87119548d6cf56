//! Random scenes whose background has little relief, before a camera that shifts and turns a little.
//!
//! The stage of a [`variant`](super::variant()) seen from far above: the ground lies nearly square to the line of sight, so
//! that a flat guess of its depth is off by 5 to 15 %. Such a background and its mirror image, hollow where the other
//! bulges and turning the other way, look almost the same.

use glam::{DMat3, DVec3};

use super::lottery::Course;
use super::variant::{Drawn, set_motion};
use super::{Draw, Sequence};
use crate::error::Error;

/// How steeply the camera looks down, radians.
const PITCH: [f64; 2] = [1.15, 1.35];
/// The camera's turn, as a share of its shift in scene units.
const TURN: f64 = 0.05;
/// Share of the largest displacement that the background covers.
const PACE: [f64; 2] = [0.3, 0.6];

/// Films the stage of the variant that `draw` decides from above.
///
/// # Errors
/// The same as those of [`variant`](super::variant()).
pub fn mild(draw: &Draw<'_>) -> Result<Sequence, Error> {
    let mut drawn = Drawn::new(draw)?;
    let ground = drawn.stage.parts[0].pose;
    let mut between = |[least, most]: [f64; 2]| drawn.dice.between(least, most);
    let around = std::f64::consts::TAU;
    let mut shift = |depth: f64| {
        let angle = between([0.0, around]);
        DVec3::new(angle.cos(), angle.sin(), between([-depth, depth]))
    };
    let mut courses = vec![Course {
        shift: shift(0.3),
        ..Course::default()
    }];
    let bodies = drawn.stage.motions.len() - 1;
    courses.extend((0..bodies).map(|_| Course {
        shift: shift(0.1),
        pace: 1.0,
        ..Course::default()
    }));
    courses[0].rotation = DVec3::new(
        between([-TURN, TURN]),
        between([-TURN, TURN]),
        between([-TURN, TURN]),
    );
    courses[0].pace = between(PACE);
    // The ground as it was looks down by its own pitch; the rest is added about the point that the camera looks at.
    let pitch = between(PITCH);
    let own = ground.rotation.y_axis.z.atan2(ground.rotation.y_axis.y);
    let more = DMat3::from_rotation_x(pitch - own);
    let stage = &mut drawn.stage;
    // The wall beyond the floor would stand before the camera.
    stage.parts.remove(1);
    for part in &mut stage.parts {
        part.pose.centre = ground.centre + more * (part.pose.centre - ground.centre);
        part.pose.rotation = more * part.pose.rotation;
    }
    set_motion(stage, &courses, draw.displacement);
    drawn.filmed(
        draw,
        "mild-",
        ", from above",
        ", a background of little relief",
    )
}
