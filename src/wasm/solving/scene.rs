//! Sequences made by the project, with their truth.

use std::cell::OnceCell;

use js_sys::Array;
use wasm_bindgen::prelude::wasm_bindgen;

use super::files::listed;
use super::{Frame, Json, Picture, Word, draw, write};
use crate::error::Error;
use crate::file::motion::{MotionFile, RegionMotion};
use crate::file::{png, result};
use crate::frames::FramePair;
use crate::horn_schunck::interpreted;
use crate::interpretation::Interpretation;
use crate::scene::{self, Sequence};
use crate::view;

/// A built-in sequence, rendered.
#[wasm_bindgen]
pub struct Scene {
    sequence: Sequence,
    /// Horn–Schunck on its frames, once someone asks.
    baseline: OnceCell<Interpretation>,
}

#[wasm_bindgen]
impl Scene {
    /// Renders the sequence called `name` at a size of one's own.
    #[wasm_bindgen(constructor)]
    pub fn new(name: &Word, width: usize, height: usize) -> Result<Scene, Error> {
        Ok(Self {
            sequence: scene::render(&name.text("name of the sequence")?, width, height)?,
            baseline: OnceCell::new(),
        })
    }

    /// Its name for people.
    #[wasm_bindgen(getter)]
    pub fn title(&self) -> String {
        self.sequence.title.clone()
    }

    /// What it teaches.
    #[wasm_bindgen(getter)]
    pub fn lesson(&self) -> String {
        self.sequence.lesson.clone()
    }

    /// The first frame.
    pub fn first(&self) -> Frame {
        Frame(self.sequence.frames[0].clone())
    }

    /// The second frame.
    pub fn second(&self) -> Frame {
        Frame(self.sequence.frames[1].clone())
    }

    /// Its camera, as a solver takes it.
    #[wasm_bindgen(getter, js_name = cameraJson)]
    pub fn camera_json(&self) -> String {
        write(&self.sequence.truth.camera)
    }

    /// Curves to start from, as a solver takes them.
    #[wasm_bindgen(getter, js_name = shapesJson)]
    pub fn shapes_json(&self) -> String {
        write(&self.sequence.curves)
    }

    /// A picture of the truth: one of `viewCatalogue()`, with parameters of its own as JSON.
    pub fn view(&self, kind: &Word, params: &Json) -> Result<Picture, Error> {
        let Sequence { frames, truth, .. } = &self.sequence;
        draw(
            &kind.view()?,
            [&frames[0], &frames[1]],
            truth,
            &[],
            &params.view_params()?,
        )
    }

    /// What the colours of such a picture stand for: a `Legend` as JSON, `null` where they are no measure.
    pub fn legend(&self, kind: &Word, params: &Json) -> Result<String, Error> {
        let params = params.view_params()?;
        let truth = &self.sequence.truth;
        Ok(write(&view::legend(&kind.view()?, truth, &params)?))
    }

    /// `params` with the ends of the colours set as the truth would have them, where they are left open: what is drawn
    /// with them can be compared with the truth by eye.
    #[wasm_bindgen(js_name = sameColours)]
    pub fn same_colours(&self, params: &Json) -> Result<String, Error> {
        let params = params.view_params()?;
        Ok(write(&view::same_colours(&self.sequence.truth, &params)))
    }

    /// Frames and truth, as an array of files `{name, bytes}`.
    #[wasm_bindgen(unchecked_return_type = "{ name: string; bytes: Uint8Array<ArrayBuffer> }[]")]
    pub fn files(&self) -> Result<Array, Error> {
        let Sequence { frames, truth, .. } = &self.sequence;
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
        &self.sequence
    }

    pub(super) fn baseline(&self) -> Result<&Interpretation, Error> {
        if self.baseline.get().is_none() {
            let [first, second] = self.sequence.frames.clone();
            let found = interpreted(&FramePair::new(first, second)?)?;
            let _ = self.baseline.set(found);
        }
        Ok(self.baseline.get().expect("it was just set"))
    }
}
