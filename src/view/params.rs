//! What a user may set about views, with ranges and defaults.

use serde::{Deserialize, Serialize};

use crate::error::{Error, within};
use crate::json;

/// One of several things to choose from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Choice {
    /// What the program calls it.
    pub value: &'static str,
    /// What people call it.
    pub label: &'static str,
}

/// Settings of all views; each reads those it needs. Missing ones take their defaults.
///
/// ```
/// use relievo::view::{self, ViewParams};
/// use relievo::{file::png, scene};
///
/// let columns = scene::render("columns", 64, 48)?;
/// let params = ViewParams { glasses: "green-magenta".to_owned(), ..ViewParams::default() };
/// let picture = view::draw("anaglyph", &columns.frames[0], &columns.truth, &[], &params)?;
/// assert_eq!((picture.width(), picture.height()), (64, 48));
/// let bytes = png::write_rgba(&picture)?;
/// assert!(bytes.starts_with(b"\x89PNG"));
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(default, deny_unknown_fields)]
pub struct ViewParams {
    /// Factor on each region's depth, the background first; 1 where missing.
    pub scales: Vec<f64>,
    /// Colours of depth, confidence, residuals and errors, a value of [`PALETTES`](super::PALETTES).
    pub palette: String,
    /// Whether each region's depth fills the palette on its own.
    pub per_region: bool,
    /// Least and greatest 1/Z that the palette goes over; null: chosen from the depth shown.
    pub span: Option<[f64; 2]>,
    /// Residual or error, in its unit, at the end of the palette; null: the 98th percentile.
    pub most: Option<f64>,
    /// How strongly regions are tinted, 0–1.
    pub tint: f64,
    /// Brightness left to a frame beneath arrows and masks, 0–1.
    pub dim: f64,
    /// Whether the colour wheel is drawn in a corner of the flow.
    pub legend: bool,
    /// Pixels between arrows; null: chosen from the frame's size.
    pub spacing: Option<f64>,
    /// Speed in pixels per frame at which flow has full colour; null: the 98th percentile.
    pub speed: Option<f64>,
    /// Glasses of the anaglyph, a value of [`GLASSES`](super::GLASSES).
    pub glasses: String,
    /// How the stereo pair is laid out, a value of [`LAYOUTS`](super::LAYOUTS).
    pub layout: String,
    /// Whether the eyes' pictures are exchanged, for glasses worn the other way round.
    pub swap: bool,
    /// Largest parallax as a share of the frame's width, 0–0.2.
    pub baseline: f64,
    /// What lies in the plane of the screen: 0 the farthest point, 1 the nearest; null: what is nearest at the frame's
    /// left and right border, with half of the depth behind it at least.
    pub convergence: Option<f64>,
    /// Whether the second eye's picture is interpolated between pixels.
    pub interpolate: bool,
    /// Degrees by which the relief is turned to the right, −80 to 80.
    pub turn: f64,
    /// Degrees by which the relief is tilted towards the viewer, −80 to 80.
    pub tilt: f64,
    /// Factor on the relief's depth; null: chosen so that it shows.
    pub relief: Option<f64>,
    /// Pixels between the relief's vertices; null: chosen from the frame's size.
    pub step: Option<usize>,
    /// Picture pixels per frame pixel for curves and arrows, 1–4.
    pub magnify: usize,
    /// Pixels of the frame that is drawn on at most: a larger one is shrunk by a whole number first, and what counts
    /// pixels here counts those of the shrunk frame, but for `speed`. Null: no limit.
    pub pixels: Option<usize>,
}

impl Default for ViewParams {
    fn default() -> Self {
        Self {
            scales: Vec::new(),
            palette: "ember".to_owned(),
            per_region: false,
            span: None,
            most: None,
            tint: 0.22,
            dim: 0.5,
            legend: true,
            spacing: None,
            speed: None,
            glasses: "red-cyan".to_owned(),
            layout: "parallel".to_owned(),
            swap: false,
            baseline: 0.025,
            convergence: None,
            interpolate: true,
            turn: 14.0,
            tilt: 12.0,
            relief: None,
            step: None,
            magnify: 1,
            pixels: None,
        }
    }
}

impl ViewParams {
    /// Reads them from JSON.
    ///
    /// # Errors
    /// [`Error::Json`] when it is no JSON object of such settings, [`Error::Option`] for one out of range.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let params: Self = json::read(text, "view settings")?;
        params.check()?;
        Ok(params)
    }

    /// Whether every number lies in its range.
    ///
    /// # Errors
    /// [`Error::Option`] for the first that does not; not-a-number never does.
    pub fn check(&self) -> Result<(), Error> {
        for &scale in &self.scales {
            within("scales", scale, 1e-3, 1e3)?;
        }
        let [far, near] = self.span.unwrap_or([0.0, 1.0]);
        within("span", far, 0.0, 1e6)?;
        within("span", near - far, 1e-9, 1e6)?;
        within("most", self.most.unwrap_or(1.0), 1e-6, 1e6)?;
        within("tint", self.tint, 0.0, 1.0)?;
        within("dim", self.dim, 0.0, 1.0)?;
        within("spacing", self.spacing.unwrap_or(16.0), 4.0, 4096.0)?;
        within("speed", self.speed.unwrap_or(1.0), 1e-6, 1e6)?;
        within("baseline", self.baseline, 0.0, 0.2)?;
        within("convergence", self.convergence.unwrap_or(0.5), 0.0, 1.0)?;
        within("turn", self.turn, -80.0, 80.0)?;
        within("tilt", self.tilt, -80.0, 80.0)?;
        within("relief", self.relief.unwrap_or(1.0), 0.0, 100.0)?;
        within("step", self.step.unwrap_or(1) as f64, 1.0, 64.0)?;
        within("pixels", self.pixels.unwrap_or(1) as f64, 1.0, 1e9)?;
        within("magnify", self.magnify as f64, 1.0, 4.0)
    }
}

/// The choice among `choices` whose value is `value`.
pub(super) fn choose(what: &str, value: &str, choices: &[Choice]) -> Result<usize, Error> {
    let index = choices.iter().position(|c| c.value == value);
    index.ok_or_else(|| Error::Choice {
        what: what.to_owned(),
        value: value.to_owned(),
        choices: choices
            .iter()
            .map(|c| c.value)
            .collect::<Vec<_>>()
            .join(", "),
    })
}
