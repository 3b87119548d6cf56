//! What both presets rest on: camera, frames, curves, files, options, scores; and the curves and focal length to start from.

#[path = "../support/mod.rs"]
mod support;

// The tables draw with it, by this name.
#[allow(dead_code)]
#[path = "../../src/scene/dice.rs"]
mod dice;

mod camera;
mod constraint;
mod derivatives;
mod drawn;
mod fields;
mod files;
mod formats;
mod frames;
// WebAssembly reads no files.
mod horn_schunck;
#[cfg(not(target_arch = "wasm32"))]
mod hostile;
mod levels;
mod lighting;
mod options;
mod pyramid;
mod score;
mod surfaces;
mod tables;
mod window;
