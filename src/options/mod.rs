//! Every weight and choice, once: its meaning, unit, range, default, and the term of (7) it scales.
//!
//! The command line, the page, the documentation and the tests read [`catalogue`]; none has a list
//! of its own. Options cross every border as one JSON object `{"preset": "best", key: value, …}`;
//! keys that are missing keep the preset's default, a missing preset is `best`, and `null` means
//! *chosen from the data* where the option allows it.

mod catalogue;
mod descriptor;

pub use catalogue::catalogue;
pub use descriptor::{Choice, Control, Descriptor};

use descriptor::{choice, descriptor};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::error::Error;
use crate::json;

/// Curves that may be drawn at most; with the background that makes eight regions.
pub const MAX_CURVES: usize = 7;

/// A configuration to start from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// Coarse to fine, a field of inverse depth per region, depth eliminated from the motion step.
    #[default]
    Best,
    /// The method as printed: one scale, Z by descent, one depth field.
    Paper,
}

impl Preset {
    /// All of them, the default first.
    pub const ALL: &'static [Self] = &[Self::Best, Self::Paper];

    /// What to show beside its name.
    pub fn label(self) -> &'static str {
        match self {
            Self::Best => "coarse to fine",
            Self::Paper => "as printed",
        }
    }
}

/// The function g that smooths depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(rename_all = "kebab-case")]
pub enum Diffusion {
    /// (11) g(r) = 2√(1+r²) − 2: keeps depth edges.
    Anisotropic,
    /// (12) g(r) = r²: blurs them.
    Isotropic,
}

/// Size at which frames are worked on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(rename_all = "lowercase")]
pub enum Detail {
    /// About 0.15 megapixels.
    Fast,
    /// About 0.5 megapixels.
    #[default]
    Normal,
    /// About 2 megapixels.
    Fine,
    /// All pixels, up to 16 megapixels.
    Full,
}

impl Detail {
    /// All of them, the coarsest first.
    pub const ALL: &'static [Self] = &[Self::Fast, Self::Normal, Self::Fine, Self::Full];

    /// Pixels that frames are shrunk to, from 2/5 to 9/4 of that; `None` for all that there are.
    pub fn pixels(self) -> Option<usize> {
        match self {
            Self::Fast => Some(150_000),
            Self::Normal => Some(500_000),
            Self::Fine => Some(2_000_000),
            Self::Full => None,
        }
    }
}

/// All settings of a solver.
///
/// ```
/// use relievo::Options;
/// use relievo::options::{Preset, catalogue};
///
/// let options = Options { lambda: Some(200.0), ..Options::preset(Preset::Paper) };
/// options.validate()?;
/// assert_eq!(options, Options::from_json(r#"{"preset": "paper", "lambda": 200}"#)?);
///
/// let error = Options::from_json(r#"{"max_passes": 0}"#).unwrap_err();
/// assert!(error.to_string().starts_with("max_passes is 0; it must be a whole number from 1"));
///
/// for option in catalogue() {
///     println!("{}: {} {}", option.key, option.meaning, option.unit);
/// }
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Options {
    /// Which solver, and what the other settings started from.
    pub preset: Preset,
    /// Size at which frames are worked on.
    pub detail: Detail,
    /// μ, or from the data.
    pub mu: Option<f64>,
    /// λ, or from the data.
    pub lambda: Option<f64>,
    /// g of the smoothness term.
    pub diffusion: Diffusion,
    /// ε of g(r/ε).
    pub epsilon: f64,
    /// Standard deviation of the Gaussian that both frames are smoothed with, pixels.
    pub smoothing: f64,
    /// `best`: whether brightness may change between the frames by a gain and an offset.
    pub lighting: bool,
    /// `best`: whether the simplest motion model that explains a region is selected.
    pub model_selection: bool,
    /// `best`: whether occluded pixels are charged a constant.
    pub occlusion: bool,
    /// `best`: whether depth discontinuities are looked for at last, pixel by pixel.
    pub discontinuities: bool,
    /// `paper`: ridge on f·ω, as a share of the mean diagonal of the normal equations.
    pub rotation_ridge: f64,
    /// `paper`: descent steps of depth in a pass.
    pub depth_steps: usize,
    /// `paper`: steps of the curves in a pass.
    pub curve_steps: usize,
    /// Passes after which the solver gives up.
    pub max_passes: usize,
    /// Share of pixels that may still change region in a pass that counts as still.
    pub tolerance: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self::preset(Preset::default())
    }
}

impl Options {
    /// The settings of a preset.
    pub fn preset(preset: Preset) -> Self {
        let best = preset == Preset::Best;
        Self {
            preset,
            detail: Detail::default(),
            mu: None,
            lambda: None,
            diffusion: Diffusion::Anisotropic,
            epsilon: if best { 1e-3 } else { 0.05 },
            smoothing: if best { 0.7 } else { 1.0 },
            lighting: best,
            model_selection: best,
            occlusion: best,
            discontinuities: best,
            rotation_ridge: if best { 0.0 } else { 0.1 },
            depth_steps: 20,
            curve_steps: 20,
            max_passes: if best { 60 } else { 150 },
            tolerance: if best { 1e-3 } else { 2e-4 },
        }
    }

    /// Reads settings from a JSON object of keys and values.
    ///
    /// # Errors
    /// [`Error::Json`] when the text is no JSON object, [`Error::Choice`] for a key or a choice that
    /// does not exist, [`Error::Option`] and [`Error::Count`] for a number outside its range.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let given: Map<String, Value> = json::read(text, "options")?;
        let preset = match given.get("preset") {
            None => Preset::default(),
            Some(value) => serde_json::from_value(value.clone())
                .map_err(|_| choice("preset", value, &["best", "paper"]))?,
        };
        let mut all = Self::preset(preset).as_map();
        for (key, value) in given {
            if key != "preset" {
                descriptor(&key)?.check(&value)?;
                all.insert(key, value);
            }
        }
        Self::deserialize(all).map_err(|e| json::unreadable(e, "options"))
    }

    /// Checks every setting against its range.
    ///
    /// # Errors
    /// [`Error::Option`] or [`Error::Count`] for the first one outside.
    pub fn validate(&self) -> Result<(), Error> {
        // JSON has no word for these: they would pass for null, *chosen from the data*.
        for (key, value) in [("mu", self.mu), ("lambda", self.lambda)] {
            if let Some(value) = value.filter(|v| !v.is_finite()) {
                descriptor(key)?.check(&Value::from(value.to_string()))?;
            }
        }
        for (key, value) in self.as_map() {
            if key != "preset" {
                descriptor(&key)?.check(&value)?;
            }
        }
        Ok(())
    }

    fn as_map(&self) -> Map<String, Value> {
        match serde_json::to_value(self) {
            Ok(Value::Object(map)) => map,
            _ => Map::new(),
        }
    }
}
