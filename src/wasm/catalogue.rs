//! What the core offers, as JSON, so that no one else keeps a list.

use serde::Serialize;
use serde_json::{Map, Value, json};
use wasm_bindgen::prelude::wasm_bindgen;

use super::write;
use crate::frames::{MAX_SIDE, MIN_SIDE};
use crate::options::{self, MAX_CURVES, Options, Preset};
use crate::scene;
use crate::view::{self, GLASSES, LABEL_COLOURS, PALETTES, ViewParams};

/// Every option, described: an array in the order in which a form should show them. Each carries its
/// `defaults`, by preset.
#[wasm_bindgen(js_name = optionCatalogue)]
pub fn option_catalogue() -> String {
    let presets: Vec<(String, Value)> = Preset::ALL
        .iter()
        .map(|&preset| (word(preset), value(&Options::preset(preset))))
        .collect();
    let described = options::catalogue().iter().map(|descriptor| {
        let mut described = value(descriptor);
        let defaults: Map<String, Value> = presets
            .iter()
            .map(|(preset, all)| (preset.clone(), all[descriptor.key].clone()))
            .collect();
        described["defaults"] = Value::Object(defaults);
        described
    });
    write(&described.collect::<Vec<_>>())
}

/// Every preset, the default first: an array of `{"value", "label"}`.
#[wasm_bindgen(js_name = presetCatalogue)]
pub fn preset_catalogue() -> String {
    let presets = Preset::ALL
        .iter()
        .map(|&preset| json!({ "value": preset, "label": preset.label() }));
    write(&presets.collect::<Vec<_>>())
}

/// Every built-in sequence: an array of `{"name", "title", "lesson"}`.
#[wasm_bindgen(js_name = sceneCatalogue)]
pub fn scene_catalogue() -> String {
    write(scene::catalogue())
}

/// All about views: `{"views": [{"kind", "title", "meaning"}], "palettes": [{"value", "label"}],
/// "glasses": [{"value", "label"}], "colours": ["#rrggbb" of label 0, of label 1, …], "defaults": {…}}`,
/// the last being the parameters that views take and their defaults.
#[wasm_bindgen(js_name = viewCatalogue)]
pub fn view_catalogue() -> String {
    let colours = LABEL_COLOURS.map(|[r, g, b]| format!("#{r:02x}{g:02x}{b:02x}"));
    write(&json!({
        "views": view::catalogue(),
        "palettes": PALETTES,
        "glasses": GLASSES,
        "colours": colours,
        "defaults": ViewParams::default(),
    }))
}

/// `{"minSide", "maxSide"}` of a frame in pixels and `{"maxCurves"}`.
#[wasm_bindgen]
pub fn limits() -> String {
    write(&json!({ "minSide": MIN_SIDE, "maxSide": MAX_SIDE, "maxCurves": MAX_CURVES }))
}

fn word(preset: Preset) -> String {
    value(&preset).as_str().unwrap_or_default().to_owned()
}

fn value<T: Serialize>(it: &T) -> Value {
    serde_json::to_value(it).expect("the core's own values have text for keys")
}
