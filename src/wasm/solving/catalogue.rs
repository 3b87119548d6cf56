//! What the core offers, as JSON, so that no one else keeps a list.

use serde::Serialize;
use serde_json::{Map, Value};
use tsify::Tsify;
use wasm_bindgen::prelude::wasm_bindgen;

use super::write;
use crate::frames::{MAX_PIXELS, MAX_SIDE, MIN_SIDE};
use crate::options::{self, Descriptor, MAX_CURVES, Options, Preset};
use crate::scene;
use crate::view::{
    self, Choice, GLASSES, LABEL_COLOURS, LAYOUTS, METHODS, PALETTES, View, ViewParams,
};

/// An option with its default under each preset.
#[derive(Serialize, Tsify)]
struct OptionEntry {
    #[serde(flatten)]
    #[tsify(type = "Descriptor")]
    descriptor: &'static Descriptor,
    /// Its value, by preset.
    #[tsify(type = "Record<Preset, string | number | boolean | null>")]
    defaults: Map<String, Value>,
}

/// A configuration to start from.
#[derive(Serialize, Tsify)]
struct PresetEntry {
    /// What the program calls it.
    value: Preset,
    /// What people call it.
    label: &'static str,
}

/// All about views.
#[derive(Serialize, Tsify)]
struct ViewCatalogue {
    /// What can be drawn.
    views: &'static [View],
    /// Colours of depth.
    palettes: &'static [Choice],
    /// Glasses of the anaglyph.
    glasses: &'static [Choice],
    /// By what each of them is served, with its source.
    methods: &'static [&'static str],
    /// Ways to lay out a stereo pair.
    layouts: &'static [Choice],
    /// `#rrggbb` of label 0, of label 1, …
    colours: Vec<String>,
    /// The parameters that views take.
    #[tsify(type = "Required<ViewParams>")]
    defaults: ViewParams,
}

/// What a frame and the curves on it may be at most.
#[derive(Serialize, Tsify)]
#[serde(rename_all = "camelCase")]
struct Limits {
    /// Shortest side of a frame, pixels.
    min_side: usize,
    /// Longest side of a frame, pixels.
    max_side: usize,
    /// Pixels of a frame.
    max_pixels: usize,
    /// Curves on a frame.
    max_curves: usize,
}

/// Every option, described, in the order in which a form should show them: `OptionEntry[]`.
#[wasm_bindgen(js_name = optionCatalogue)]
pub fn option_catalogue() -> String {
    let presets: Vec<(String, Value)> = Preset::ALL
        .iter()
        .map(|&preset| (word(preset), value(&Options::preset(preset))))
        .collect();
    let defaults = |key: &str| {
        let all = presets.iter();
        all.map(|(preset, values)| (preset.clone(), values[key].clone()))
            .collect()
    };
    let described = options::catalogue().iter().map(|descriptor| OptionEntry {
        descriptor,
        defaults: defaults(descriptor.key),
    });
    write(&described.collect::<Vec<_>>())
}

/// Every preset, the default first: `PresetEntry[]`.
#[wasm_bindgen(js_name = presetCatalogue)]
pub fn preset_catalogue() -> String {
    let presets = Preset::ALL.iter().map(|&value| PresetEntry {
        value,
        label: value.label(),
    });
    write(&presets.collect::<Vec<_>>())
}

/// Every built-in sequence: `SceneEntry[]`.
#[wasm_bindgen(js_name = sceneCatalogue)]
pub fn scene_catalogue() -> String {
    write(scene::catalogue())
}

/// All about views: `ViewCatalogue`.
#[wasm_bindgen(js_name = viewCatalogue)]
pub fn view_catalogue() -> String {
    write(&ViewCatalogue {
        views: view::catalogue(),
        palettes: &PALETTES,
        glasses: &GLASSES,
        methods: &METHODS,
        layouts: &LAYOUTS,
        colours: LABEL_COLOURS
            .map(|[r, g, b]| format!("#{r:02x}{g:02x}{b:02x}"))
            .into(),
        defaults: ViewParams::default(),
    })
}

/// What a frame and the curves on it may be at most: `Limits`.
#[wasm_bindgen]
pub fn limits() -> String {
    write(&Limits {
        min_side: MIN_SIDE,
        max_side: MAX_SIDE,
        max_pixels: MAX_PIXELS,
        max_curves: MAX_CURVES,
    })
}

fn word(preset: Preset) -> String {
    value(&preset).as_str().unwrap_or_default().to_owned()
}

fn value<T: Serialize>(it: &T) -> Value {
    serde_json::to_value(it).expect("the core's own values have text for keys")
}
