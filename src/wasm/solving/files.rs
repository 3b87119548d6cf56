//! Results as files, for downloading and for the command line.

use js_sys::{Array, Object, Reflect, Uint8Array};
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsCast, JsValue};

use super::write;
use crate::error::Error;
use crate::file::parts::Parts;
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

#[wasm_bindgen]
extern "C" {
    /// An array of `{name, bytes}`.
    #[wasm_bindgen(typescript_type = "{ name: string; bytes: Uint8Array }[]")]
    pub type Files;
}

/// What there is of a result, read back from files.
#[wasm_bindgen(js_name = SavedResult)]
pub struct SavedResult(Parts);

#[wasm_bindgen(js_class = SavedResult)]
impl SavedResult {
    /// Reads what there is among `files`: labels.png, depth.pfm, flow.flo, flow.png as KITTI has it, occlusion.png and
    /// motion.json.
    #[wasm_bindgen(constructor)]
    pub fn new(files: &Files) -> Result<SavedResult, Error> {
        let wrong = |reason: &str| Error::Json {
            what: "list of files",
            reason: reason.to_owned(),
        };
        let list = files.dyn_ref::<Array>();
        let list = list.ok_or_else(|| wrong("it must be an array of {name, bytes}"))?;
        let read = |entry: JsValue| {
            let get = |key: &str| Reflect::get(&entry, &key.into()).ok();
            let name = get("name").and_then(|name| name.as_string());
            let bytes = get("bytes").and_then(|bytes| bytes.dyn_into::<Uint8Array>().ok());
            let both = name.zip(bytes.map(|bytes| bytes.to_vec()));
            both.ok_or_else(|| wrong("each entry must have a name and bytes"))
        };
        let files: Vec<_> = list.iter().map(read).collect::<Result<_, _>>()?;
        Ok(Self(Parts::read(&files)?))
    }

    /// How far this is from the truth, as far as both have the same parts: `PartScores` as JSON.
    pub fn scores(&self, truth: &SavedResult) -> Result<String, Error> {
        Ok(write(&score::compare_known(&self.0, &truth.0)?))
    }
}
