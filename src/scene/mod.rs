//! Sequences made by the project itself, with everything about them known.
//!
//! Each is a `stage::Stage` — solids, solid textures, lamps and rigid motions as data — seen by one
//! ray caster, at any size. Textures have detail at every scale the picture can show.

mod blocks;
mod carousel;
mod cast;
mod columns;
mod dice;
mod draw;
mod figure;
mod film;
mod flight;
mod head;
mod lottery;
mod mild;
mod noise;
mod passing;
mod picture;
mod shade;
mod solid;
mod squares;
mod stage;
mod terrain;
mod texture;
mod truth;
mod variant;

use serde::Serialize;

use crate::camera::Camera;
use crate::curves::Shape;
use crate::error::Error;
use crate::frames::{Frame, check_size};
use crate::interpretation::Interpretation;
use stage::Stage;

pub use draw::Draw;
pub use film::{Film, render_film, variant_film};
pub use mild::mild;
pub use passing::passing;
pub use variant::variant;

/// Two frames, the curves to start from, and the truth.
///
/// ```
/// use relievo::scene;
///
/// for entry in scene::catalogue() {
///     println!("{}: {}", entry.title, entry.lesson);
/// }
/// let blocks = scene::render("blocks", 80, 60)?;
/// assert_eq!(blocks.frames[0].width(), 80);
/// assert_eq!(blocks.curves.len() + 1, blocks.truth.regions());
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    /// Its name, as [`names`] lists it.
    pub name: String,
    /// Its name for people.
    pub title: String,
    /// What it teaches, in a sentence or two.
    pub lesson: String,
    /// The two frames, 8 bits per channel.
    pub frames: [Frame; 2],
    /// One circle per moving object, covering about a third of it; none where there is one region.
    pub curves: Vec<Shape>,
    /// Labels, depth, motions, flow, occlusion and camera of the first frame.
    pub truth: Interpretation,
}

/// A sequence that can be rendered.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify),
    tsify(rename = "SceneEntry")
)]
pub struct Entry {
    /// What [`render`] calls it.
    pub name: &'static str,
    /// What people call it.
    pub title: &'static str,
    /// What it teaches.
    pub lesson: &'static str,
    #[serde(skip)]
    stage: fn() -> Stage,
}

const CATALOGUE: [Entry; 7] = [
    squares::ENTRY,
    blocks::ENTRY,
    figure::ENTRY,
    head::ENTRY,
    flight::ENTRY,
    columns::ENTRY,
    carousel::ENTRY,
];

/// All built-in sequences with their titles and lessons.
pub fn catalogue() -> &'static [Entry] {
    &CATALOGUE
}

/// The names of all built-in sequences.
pub fn names() -> impl Iterator<Item = &'static str> {
    CATALOGUE.iter().map(|entry| entry.name)
}

/// Renders the sequence `name` at `width × height` pixels. The field of view stays, so image motion
/// in pixels grows with the size; at 320×240 it is a pixel or so, and up to four where the
/// camera passes something near.
///
/// # Errors
/// [`Error::Choice`] for an unknown name, [`Error::Size`] outside the limits of a frame.
pub fn render(name: &str, width: usize, height: usize) -> Result<Sequence, Error> {
    let entry = entry(name)?;
    render_film(name, width, height, 2).map(|film| film.sequence(entry))
}

/// The built-in sequence of that name.
fn entry(name: &str) -> Result<&'static Entry, Error> {
    let found = CATALOGUE.iter().find(|e| e.name == name);
    found.ok_or_else(|| Error::Choice {
        what: "built-in sequence".to_owned(),
        value: name.to_owned(),
        choices: names().collect::<Vec<_>>().join(", "),
    })
}

/// A camera whose horizontal field of view is 53° in a 4:3 frame; in a flatter or taller frame the
/// largest 4:3 part of it has that field of view.
fn camera(name: &str, width: usize, height: usize) -> Result<Camera, Error> {
    check_size(&format!("the sequence {name}"), width, height)?;
    Camera::centred((width as f64).min(height as f64 * 4.0 / 3.0), width, height)
}
