//! Curves to start from and a focal length, found in the frames; whether two frames go together.

use wasm_bindgen::prelude::wasm_bindgen;

use super::camera::camera_of;
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
    Ok(write(&crate::solver::find_curves(&pair, &camera)))
}

/// The focal length at which rigid motions explain the frames best, `{"focal", "least", "greatest"}` in
/// pixels: f, and the ends of its range. `null` where that of `camera`, a guess, does about as well.
#[wasm_bindgen(js_name = findFocal)]
pub fn find_focal(first: &Frame, second: &Frame, camera: &Json) -> Result<String, Error> {
    let pair = FramePair::new(first.0.clone(), second.0.clone())?;
    let camera = camera_of(&pair, camera)?;
    Ok(write(&init::focal_length(&pair, &camera)))
}

/// How far things move between two frames, and whether that is enough to see depth by and little enough to follow: a
/// `Displacement` as JSON. Frames of a few hundred pixels a side are enough, and quick.
#[wasm_bindgen]
pub fn displacement(first: &Frame, second: &Frame) -> Result<String, Error> {
    let [first, second] = [&first.0.grey, &second.0.grey];
    if !first.same_size(second) {
        return Err(Error::FramesDiffer {
            first: (first.width(), first.height()),
            second: (second.width(), second.height()),
        });
    }
    Ok(write(&init::displacement(first, second)))
}
