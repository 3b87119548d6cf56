//! What the core offers, as JSON, so that no one else keeps a list.

use serde_json::json;
use wasm_bindgen::prelude::wasm_bindgen;

use super::write;
use crate::frames::{MAX_SIDE, MIN_SIDE};
use crate::options::{self, MAX_CURVES};
use crate::scene;

/// Every option, described: an array in the order in which a form should show them.
#[wasm_bindgen(js_name = optionCatalogue)]
pub fn option_catalogue() -> String {
    write(options::catalogue())
}

/// Every built-in sequence: an array of `{"name", "title", "lesson"}`.
#[wasm_bindgen(js_name = sceneCatalogue)]
pub fn scene_catalogue() -> String {
    write(scene::catalogue())
}

/// `{"minSide", "maxSide"}` of a frame in pixels and `{"maxCurves"}`.
#[wasm_bindgen]
pub fn limits() -> String {
    write(&json!({ "minSide": MIN_SIDE, "maxSide": MAX_SIDE, "maxCurves": MAX_CURVES }))
}
