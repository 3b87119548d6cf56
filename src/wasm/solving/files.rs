//! Results as files, for downloading and for the command line.

use js_sys::{Array, Object, Reflect, Uint8Array};
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsCast, JsValue};

use super::write;
use crate::error::Error;
use crate::file::motion::MotionFile;
use crate::file::parts::Parts;
use crate::file::{glb, ply, result};
use crate::frames::Frame;
use crate::interpretation::Interpretation;
use crate::score;
use crate::view::Mesh;

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

/// One file of what was found, by its name: of [`result::NAMES`], or, of the surface on
/// its frame, relief.glb and relief.ply.
pub(super) fn one(
    name: &str,
    found: &Interpretation,
    motion: &MotionFile,
    surface: impl FnOnce() -> (Mesh, Frame),
) -> Result<Uint8Array, Error> {
    let bytes = match name {
        "relief.glb" => {
            let (mesh, frame) = surface();
            glb::write(&mesh, &frame.rgb)?
        }
        "relief.ply" => ply::write(&surface().0),
        _ => result::file(name, found, motion)?,
    };
    Ok(Uint8Array::from(bytes.as_slice()))
}

#[wasm_bindgen]
extern "C" {
    /// An array of `{name, bytes}`.
    #[wasm_bindgen(typescript_type = "{ name: string; bytes: Uint8Array }[]")]
    pub type Files;
}

/// Names and contents.
pub(super) fn files_of(files: &Files) -> Result<Vec<(String, Vec<u8>)>, Error> {
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
    list.iter().map(read).collect()
}

/// What there is of a result, read back from files.
#[wasm_bindgen(js_name = SavedResult)]
pub struct SavedResult(Parts);

#[wasm_bindgen(js_class = SavedResult)]
impl SavedResult {
    /// Reads what there is among `files`: labels.png, depth.pfm, a 16-bit depth.png, flow.flo, flow.png as KITTI has it,
    /// occlusion.png and motion.json. `fileKind` tells what a file of another name is.
    #[wasm_bindgen(constructor)]
    pub fn new(files: &Files) -> Result<SavedResult, Error> {
        Ok(Self(Parts::read(&files_of(files)?)?))
    }

    /// How far this is from the truth, as far as both have the same parts: `PartScores` as JSON.
    pub fn scores(&self, truth: &SavedResult) -> Result<String, Error> {
        Ok(write(&score::compare_known(&self.0, &truth.0)?))
    }
}
