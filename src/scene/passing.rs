//! Random scenes that stand still and are filmed in passing: one rigid motion, depth that leaps, and no curve to draw.
//!
//! The stage of a [`variant`](super::variant()) whose bodies are brought nearer along their lines of sight, so that they
//! look as large as before and the ground that they hide is [`NEARER`] times as far and more. The camera passes in a
//! direction drawn from the same seed, turning a little.

use glam::DVec3;

use super::lottery::Course;
use super::stage::Shadows;
use super::variant::{Drawn, set_motion};
use super::{Draw, Sequence};
use crate::error::Error;

/// How many times nearer bodies are brought.
const NEARER: f64 = 2.0;
/// The camera's turn, as a share of its shift in scene units.
const TURN: f64 = 0.05;

/// Films the stage of the variant that `draw` decides, standing still.
///
/// # Errors
/// The same as those of [`variant`](super::variant()).
pub fn passing(draw: &Draw<'_>) -> Result<Sequence, Error> {
    let mut drawn = Drawn::new(draw)?;
    let stage = &mut drawn.stage;
    for part in &mut stage.parts {
        if part.body > 0 {
            part.bring_nearer(NEARER);
        }
        part.body = 0;
    }
    stage.motions.truncate(1);
    // The lamps stand still as well.
    stage.shadows = Shadows::Painted;
    let mut between = |least: f64, most: f64| drawn.dice.between(least, most);
    let angle = between(0.0, std::f64::consts::TAU);
    let course = Course {
        shift: DVec3::new(angle.cos(), 0.5 * angle.sin(), between(-0.7, 0.7)),
        rotation: DVec3::new(
            between(-TURN, TURN),
            between(-TURN, TURN),
            between(-TURN, TURN),
        ),
        pace: 1.0,
        ..Course::default()
    };
    set_motion(stage, &[course], draw.displacement);
    drawn.filmed(draw, "passing-", ", filmed in passing", ", one motion")
}
