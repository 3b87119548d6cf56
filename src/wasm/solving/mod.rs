//! The module that solves.

mod baseline;
#[cfg(feature = "bench")]
mod bench;
mod camera;
mod catalogue;
mod files;
mod film;
mod found;
mod frame;
mod kept;
mod mesh;
mod opening;
mod scene;
mod shown;
mod solver;
mod start;
mod truth;
mod working;

pub use baseline::{Baseline, horn_schunck};
#[cfg(feature = "bench")]
pub use bench::Kernels;
pub use catalogue::{limits, option_catalogue, preset_catalogue, scene_catalogue, view_catalogue};
pub use files::SavedResult;
pub use film::{Film, decode_all};
pub use frame::{Frame, Picture};
pub use kept::Kept;
pub use mesh::Mesh;
pub use opening::{needs_decoders, use_decoders};
pub use scene::Scene;
pub use solver::Solver;
pub use start::{displacement, find_curves, find_focal};
pub use truth::{Truth, file_kind};
pub use working::working_sizes;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsCast, JsValue};

use crate::Error;
use crate::json;
use crate::view::ViewParams;

#[wasm_bindgen]
extern "C" {
    /// A word. Nothing keeps JavaScript from passing something else, which would be read as if it were one.
    #[wasm_bindgen(typescript_type = "string")]
    pub type Word;

    /// JSON text, or what it would be parsed to.
    #[wasm_bindgen(typescript_type = "string | object")]
    pub type Json;
}

impl Word {
    /// The name of a view.
    fn view(&self) -> Result<String, Error> {
        self.text("name of the view")
    }

    /// What was passed; `what` is what an error calls it.
    fn text(&self, what: &'static str) -> Result<String, Error> {
        let it: &JsValue = self.as_ref();
        it.as_string().ok_or_else(|| Error::Json {
            what,
            reason: format!("it must be a string, and is {}", kind_of(it)),
        })
    }
}

impl Json {
    /// The text; `what` is what an error calls it.
    fn text(&self, what: &'static str) -> Result<String, Error> {
        let it: &JsValue = self.as_ref();
        if let Some(text) = it.as_string() {
            return Ok(text);
        }
        let text = it
            .is_object()
            .then(|| js_sys::JSON::stringify(it).ok()?.as_string());
        text.flatten().ok_or_else(|| Error::Json {
            what,
            reason: format!("it must be JSON or an object, and is {}", kind_of(it)),
        })
    }

    fn view_params(&self) -> Result<ViewParams, Error> {
        ViewParams::from_json(&self.text("view settings")?)
    }

    /// The object of type T that it stands for.
    fn read<T: DeserializeOwned>(&self, what: &'static str) -> Result<T, Error> {
        json::read(&self.text(what)?, what)
    }

    /// The array of such objects.
    fn list<T: DeserializeOwned>(&self, what: &'static str) -> Result<Vec<T>, Error> {
        match json::parsed(&self.text(what)?, what)? {
            Value::Array(all) => all.into_iter().map(|it| json::object(it, what)).collect(),
            _ => Err(Error::Json {
                what,
                reason: "a JSON array is needed".to_owned(),
            }),
        }
    }
}

/// What JavaScript calls its type.
fn kind_of(it: &JsValue) -> String {
    it.js_typeof().unchecked_into::<js_sys::JsString>().into()
}

/// Writes JSON for JavaScript. What is not a number becomes `null`.
fn write<T: Serialize + ?Sized>(it: &T) -> String {
    serde_json::to_string(it).expect("the core's own values have text for keys")
}
