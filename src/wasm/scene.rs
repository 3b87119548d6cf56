//! Sequences made by the project, with their truth.

use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

use super::{Frame, write};
use crate::scene::{self, Sequence};

/// A built-in sequence, rendered.
#[wasm_bindgen]
pub struct Scene(pub(super) Sequence);

#[wasm_bindgen]
impl Scene {
    /// Renders the sequence called `name` at a size of one's own.
    #[wasm_bindgen(constructor)]
    pub fn new(name: &str, width: usize, height: usize) -> Result<Scene, JsError> {
        Ok(Self(scene::render(name, width, height)?))
    }

    /// Its name for people.
    #[wasm_bindgen(getter)]
    pub fn title(&self) -> String {
        self.0.title.clone()
    }

    /// What it teaches.
    #[wasm_bindgen(getter)]
    pub fn lesson(&self) -> String {
        self.0.lesson.clone()
    }

    /// The first frame.
    pub fn first(&self) -> Frame {
        Frame(self.0.frames[0].clone())
    }

    /// The second frame.
    pub fn second(&self) -> Frame {
        Frame(self.0.frames[1].clone())
    }

    /// Its camera, as a solver takes it.
    #[wasm_bindgen(getter, js_name = cameraJson)]
    pub fn camera_json(&self) -> String {
        write(&self.0.truth.camera)
    }

    /// Curves to start from, as a solver takes them.
    #[wasm_bindgen(getter, js_name = shapesJson)]
    pub fn shapes_json(&self) -> String {
        write(&self.0.curves)
    }
}
