//! A camera as JavaScript gives it.

use serde::Deserialize;
use tsify::Tsify;

use super::Json;
use crate::camera::Camera;
use crate::error::Error;
use crate::frames::FramePair;

/// A camera.
#[derive(Deserialize, Tsify)]
#[tsify(rename = "Camera")]
#[serde(deny_unknown_fields)]
struct CameraJson {
    /// Focal length, pixels.
    focal: f64,
    /// Column of the principal point; without it that of the frame's centre.
    #[tsify(optional)]
    cx: Option<f64>,
    /// Row of the principal point; without it that of the frame's centre.
    #[tsify(optional)]
    cy: Option<f64>,
}

pub(super) fn camera_of(pair: &FramePair, json: &Json) -> Result<Camera, Error> {
    let given: CameraJson = json.read("camera")?;
    let mut camera = Camera::centred(given.focal, pair.width(), pair.height())?;
    camera.cx = given.cx.unwrap_or(camera.cx);
    camera.cy = given.cy.unwrap_or(camera.cy);
    Camera::new(camera.focal, camera.cx, camera.cy)
}
