//! At what sizes frames can be worked on, and how long that takes.

use wasm_bindgen::prelude::wasm_bindgen;

use super::write;
use crate::working;

/// The sizes at which frames of `width × height` pixels with so many curves on them can be worked on, by the option
/// *Detail*: `WorkingSize[]` as JSON. Seconds are those of a certain machine: multiply them with what a solve took here
/// over what was expected of it.
#[wasm_bindgen(js_name = workingSizes)]
pub fn working_sizes(width: usize, height: usize, curves: usize) -> String {
    write(&working::sizes(width, height, curves))
}
