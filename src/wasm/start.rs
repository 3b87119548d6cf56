//! Curves to start from and a focal length, found in the frames.

use wasm_bindgen::prelude::wasm_bindgen;

use super::solver::camera_of;
use super::{Frame, Json, write};
use crate::error::Error;
use crate::frames::FramePair;
use crate::init;

/// A polygon roughly on each thing that moves by itself, the largest first and as many at most as a
/// solver takes them; `[]` where one motion explains both frames. `camera` is that of a solver.
#[wasm_bindgen(js_name = findCurves)]
pub fn find_curves(first: &Frame, second: &Frame, camera: &Json) -> Result<String, Error> {
    let pair = FramePair::new(first.0.clone(), second.0.clone())?;
    let camera = camera_of(&pair, camera)?;
    Ok(write(&init::find_curves(&pair, &camera)))
}

/// The focal length at which rigid motions explain the frames best, `{"focal", "least", "greatest"}` in
/// pixels: f, and the ends of its range. `null` where that of `camera`, a guess, does about as well.
#[wasm_bindgen(js_name = findFocal)]
pub fn find_focal(first: &Frame, second: &Frame, camera: &Json) -> Result<String, Error> {
    let pair = FramePair::new(first.0.clone(), second.0.clone())?;
    let camera = camera_of(&pair, camera)?;
    Ok(write(&init::focal_length(&pair, &camera)))
}
