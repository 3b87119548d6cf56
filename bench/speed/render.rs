//! Three frames of a scene and the truth about each neighbouring two, as plain files that all who are timed can read.
//!
//! `frameN.rgba` and `labelsN.u8` are bytes in row order, `flowN.flo` is Middlebury's format, `scene.json` has size,
//! camera and circles.

use std::fs;
use std::path::Path;

use relievo::Error;
use relievo::file::flo;
use relievo::scene::{Draw, Film, render_film, variant_film};
use serde_json::{Value, json};

use crate::Failure;

/// Frames of each film: two to solve, and one to go on with.
const FRAMES: usize = 3;
/// Variants of the scene generator move by this many pixels at most at a width of 320, with this noise in grey levels.
const DISPLACEMENT: f64 = 4.0;
const NOISE: f32 = 1.0;

/// Renders `scene`, one of the built-in sequences or a variant such as `crowd-1`, into `folder`.
pub fn render(scene: &str, width: usize, height: usize, folder: &Path) -> Result<Value, Failure> {
    let film = film(scene, width, height)?;
    fs::create_dir_all(folder)?;
    for (i, frame) in film.frames.iter().enumerate() {
        let opaque = frame.rgb.map(|[r, g, b]| [r, g, b, 255]);
        fs::write(
            folder.join(format!("frame{i}.rgba")),
            opaque.data().as_flattened(),
        )?;
    }
    for (i, truth) in film.truths.iter().enumerate() {
        fs::write(folder.join(format!("labels{i}.u8")), truth.labels.data())?;
        fs::write(folder.join(format!("flow{i}.flo")), flo::write(&truth.flow))?;
    }
    let about = json!({
        "width": width,
        "height": height,
        "camera": film.truths[0].camera,
        "curves": film.curves,
    });
    fs::write(folder.join("scene.json"), about.to_string())?;
    Ok(about)
}

fn film(scene: &str, width: usize, height: usize) -> Result<Film, Error> {
    let variant = scene.split_once('-');
    match variant.and_then(|(base, seed)| Some((base, seed.parse().ok()?))) {
        Some((base, seed)) => {
            let draw = Draw {
                base,
                seed,
                noise_sigma: NOISE,
                displacement: DISPLACEMENT,
                size: [width, height],
            };
            variant_film(&draw, FRAMES)
        }
        None => render_film(scene, width, height, FRAMES),
    }
}
