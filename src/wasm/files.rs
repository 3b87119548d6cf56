//! Results as files, for downloading and for the command line.

use js_sys::{Array, Object, Reflect, Uint8Array};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

use super::write;
use crate::camera::Camera;
use crate::error::Error;
use crate::file::motion::MotionFile;
use crate::file::{flo, pfm, png};
use crate::grid::Grid;
use crate::interpretation::Interpretation;
use crate::score;

/// Labels, depth, flow, hidden pixels and motion: what measures, as opposed to what one looks at.
pub(super) fn data(
    it: &Interpretation,
    motion: &MotionFile,
) -> Result<Vec<(&'static str, Vec<u8>)>, Error> {
    // 255, so that the mask can be seen.
    let hidden = it.occluded.map(|hidden| 255 * u8::from(hidden != 0));
    Ok(vec![
        ("labels.png", png::write_labels(&it.labels)?),
        ("depth.pfm", pfm::write(&it.depth)),
        ("flow.flo", flo::write(&it.flow)),
        ("occlusion.png", png::write_labels(&hidden)?),
        ("motion.json", motion.write().into_bytes()),
    ])
}

/// An array of `{name, bytes}`.
pub(super) fn listed(files: Vec<(&'static str, Vec<u8>)>) -> Array {
    let entry = |(name, bytes): (&str, Vec<u8>)| {
        let entry = Object::new();
        let set = |key: &str, value: &JsValue| Reflect::set(&entry, &key.into(), value);
        set("name", &name.into()).expect("a plain object takes any property");
        set("bytes", &Uint8Array::from(bytes.as_slice()))
            .expect("a plain object takes any property");
        entry
    };
    files.into_iter().map(entry).collect()
}

/// An interpretation read back from the files it was written to.
#[wasm_bindgen(js_name = SavedResult)]
pub struct SavedResult(Interpretation);

#[wasm_bindgen(js_class = SavedResult)]
impl SavedResult {
    /// Reads the bytes of labels.png, depth.pfm, flow.flo and motion.json, and of occlusion.png where
    /// there is one.
    #[wasm_bindgen(constructor)]
    pub fn new(
        labels: &[u8],
        depth: &[u8],
        flow: &[u8],
        motion: &str,
        occlusion: Option<Box<[u8]>>,
    ) -> Result<SavedResult, Error> {
        let labels = png::read_labels(labels, "labels.png")?;
        let (width, height) = (labels.width(), labels.height());
        let occluded = match occlusion {
            Some(bytes) => png::read_labels(&bytes, "occlusion.png")?,
            None => Grid::new(width, height, 0),
        };
        let regions = MotionFile::read(motion)?.regions;
        // Where nothing travels depth leaves no trace, so that it is not there to be compared.
        let travels = |k: u8| {
            let region = regions.get(usize::from(k));
            region.is_none_or(|region| region.translation != [0.0; 3])
        };
        let read = Interpretation {
            // Scores do not ask for the camera, and the files do not say it.
            camera: Camera::centred(width as f64, width, height)?,
            depth: alike(&labels, pfm::read(depth, "depth.pfm")?, "depth.pfm")?,
            occluded: alike(&labels, occluded, "occlusion.png")?,
            confidence: labels.map(|k| f32::from(travels(k))),
            flow: flo::read(flow, "flow.flo")?,
            motions: regions.iter().map(|region| region.motion()).collect(),
            labels,
        };
        alike(&read.labels, read.flow.u.map(|_| ()), "flow.flo")?;
        Ok(Self(read))
    }

    /// How far this is from the truth, as JSON.
    pub fn scores(&self, truth: &SavedResult) -> Result<String, Error> {
        Ok(write(&score::compare(&self.0, &truth.0)?))
    }
}

fn alike<T: Copy>(labels: &Grid<u8>, it: Grid<T>, what: &'static str) -> Result<Grid<T>, Error> {
    if it.same_size(labels) {
        return Ok(it);
    }
    Err(Error::Length {
        what,
        width: labels.width(),
        height: labels.height(),
        expected: labels.len(),
        found: it.len(),
    })
}
