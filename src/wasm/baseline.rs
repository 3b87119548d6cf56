//! Horn–Schunck beside the method.

use crate::camera::{Camera, RigidMotion};
use crate::error::Error;
use crate::frames::FramePair;
use crate::grid::Grid;
use crate::horn_schunck::{ALPHA, SWEEPS, solve};
use crate::interpretation::Interpretation;

/// What Horn–Schunck makes of a pair: image motion, and nothing known of anything else.
pub(super) fn baseline(pair: &FramePair) -> Result<Interpretation, Error> {
    let (width, height) = (pair.width(), pair.height());
    Ok(Interpretation {
        camera: Camera::centred(width as f64, width, height)?,
        labels: Grid::new(width, height, 0),
        depth: Grid::new(width, height, 1.0),
        flow: solve(pair, ALPHA, SWEEPS),
        confidence: Grid::new(width, height, 0.0),
        occluded: Grid::new(width, height, 0),
        motions: vec![RigidMotion::default()],
    })
}
