//! Results as files, for downloading and for the command line.

use js_sys::{Array, Object, Reflect, Uint8Array};
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

use super::{Word, write};
use crate::error::Error;
use crate::file::result::ResultFiles;
use crate::interpretation::Interpretation;
use crate::score;

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
        motion: &Word,
        occlusion: Option<Box<[u8]>>,
    ) -> Result<SavedResult, Error> {
        let files = ResultFiles {
            labels,
            depth,
            flow,
            motion: &motion.text("motion.json")?,
            occlusion: occlusion.as_deref(),
        };
        Ok(Self(files.read()?))
    }

    /// How far this is from the truth, as JSON.
    pub fn scores(&self, truth: &SavedResult) -> Result<String, Error> {
        Ok(write(&score::compare(&self.0, &truth.0)?))
    }
}
