//! Sequences made by the project, with their truth.

use js_sys::Array;
use wasm_bindgen::prelude::wasm_bindgen;

use super::files::listed;
use super::{Frame, Word, write};
use crate::error::Error;
use crate::file::motion::{MotionFile, RegionMotion};
use crate::file::{png, result};
use crate::scene::{self, Sequence};

/// A built-in sequence, rendered.
#[wasm_bindgen]
pub struct Scene(Sequence);

#[wasm_bindgen]
impl Scene {
    /// Renders the sequence called `name` at a size of one's own.
    #[wasm_bindgen(constructor)]
    pub fn new(name: &Word, width: usize, height: usize) -> Result<Scene, Error> {
        let name = name.text("name of the sequence")?;
        Ok(Self(scene::render(&name, width, height)?))
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

    /// Frames and truth, as an array of files `{name, bytes}`.
    #[wasm_bindgen(unchecked_return_type = "{ name: string; bytes: Uint8Array<ArrayBuffer> }[]")]
    pub fn files(&self) -> Result<Array, Error> {
        let Sequence { frames, truth, .. } = &self.0;
        let motion = MotionFile {
            regions: RegionMotion::list(&truth.motions, &truth.models()),
            status: "truth".to_owned(),
            ..MotionFile::default()
        };
        let mut files = vec![
            ("frame0.png", png::write_rgb(&frames[0].rgb)?),
            ("frame1.png", png::write_rgb(&frames[1].rgb)?),
        ];
        files.extend(result::write(truth, &motion)?);
        Ok(listed(files))
    }
}

impl Scene {
    pub(super) fn sequence(&self) -> &Sequence {
        &self.0
    }
}
