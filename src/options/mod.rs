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

/// Curves that may be drawn at most; with the background that makes eight regions.
pub const MAX_CURVES: usize = 7;

/// A configuration to start from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
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

/// How step 1 finds a region's motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MotionMethod {
    /// Least squares for (T, ω) with depth held fixed.
    LeastSquares,
    /// Gauss–Newton for (T, ω) with depth eliminated; only with a depth field per region.
    Joint,
}

/// How step 2 finds depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DepthMethod {
    /// Descent on Z, equation (9): one scale, one field.
    Descent,
    /// A linear system in 1/Z, coarse to fine: a field per region.
    Layers,
}

/// The function g that smooths depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Diffusion {
    /// (11) g(r) = 2√(1+r²) − 2: keeps depth edges.
    Anisotropic,
    /// (12) g(r) = r²: blurs them.
    Isotropic,
}

/// All settings of a solver.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Options {
    /// What the other settings started from.
    pub preset: Preset,
    /// Step 1.
    pub motion: MotionMethod,
    /// Step 2.
    pub depth: DepthMethod,
    /// g of the smoothness term.
    pub diffusion: Diffusion,
    /// μ, or from the data.
    pub mu: Option<f64>,
    /// λ, or from the data.
    pub lambda: Option<f64>,
    /// ε of g(r/ε).
    pub epsilon: f64,
    /// Standard deviation of the Gaussian that both frames are smoothed with.
    pub smoothing: f64,
    /// Ridge on f·ω, as a share of the mean diagonal of the normal equations.
    pub rotation_ridge: f64,
    /// Descent steps of depth in a pass.
    pub depth_steps: usize,
    /// Steps of the curves in a pass.
    pub curve_steps: usize,
    /// Whether curves start on the bodies that they are drawn on.
    pub bodies: bool,
    /// Whether directions of T are searched over the whole sphere.
    pub search: bool,
    /// Whether the simplest kind of motion that explains a region is chosen.
    pub choose_kind: bool,
    /// Whether large residuals count less than their square.
    pub robust: bool,
    /// Whether regions compete in units of each residual's uncertainty.
    pub normalised: bool,
    /// Whether brightness may change between the frames.
    pub lighting: bool,
    /// Whether gradients compete besides brightness until curves have settled.
    pub gradients: bool,
    /// Whether hidden pixels are excused from the competition.
    pub occlusion: bool,
    /// Whether a curve bounds one thing, without islands.
    pub islands: bool,
    /// Whether curves are taken to the least partition before (17) moves them.
    pub partition: bool,
    /// Whether regions are tried with what lies around them.
    pub growth: bool,
    /// Whether depth that the frames refute is sought anew.
    pub sweep: bool,
    /// Whether outlines cost less, and the background's depth may step, on edges of brightness.
    pub edges: bool,
    /// Whether each region takes the smoothness that best foretells pixels left out.
    pub cross_validation: bool,
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
        match preset {
            Preset::Best => Self {
                motion: MotionMethod::Joint,
                depth: DepthMethod::Layers,
                epsilon: 3e-3,
                smoothing: 0.5,
                bodies: true,
                search: true,
                choose_kind: true,
                robust: true,
                normalised: true,
                lighting: true,
                gradients: true,
                occlusion: true,
                islands: true,
                partition: true,
                growth: true,
                sweep: true,
                edges: true,
                cross_validation: true,
                max_passes: 60,
                preset,
                ..Self::preset(Preset::Paper)
            },
            Preset::Paper => Self {
                preset,
                motion: MotionMethod::LeastSquares,
                depth: DepthMethod::Descent,
                diffusion: Diffusion::Anisotropic,
                mu: None,
                lambda: None,
                epsilon: 0.05,
                smoothing: 1.0,
                rotation_ridge: 0.1,
                depth_steps: 20,
                curve_steps: 20,
                bodies: false,
                search: false,
                choose_kind: false,
                robust: false,
                normalised: false,
                lighting: false,
                gradients: false,
                occlusion: false,
                islands: false,
                partition: false,
                growth: false,
                sweep: false,
                edges: false,
                cross_validation: false,
                max_passes: 150,
                tolerance: 2e-4,
            },
        }
    }

    /// Reads settings from a JSON object of keys and values.
    ///
    /// # Errors
    /// [`Error::Json`] when the text is no JSON object, [`Error::Choice`] for a key or a choice that
    /// does not exist, [`Error::Option`] and [`Error::Count`] for a number outside its range.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let unreadable = |e: serde_json::Error| Error::Json {
            what: "options",
            reason: e.to_string(),
        };
        let given: Map<String, Value> = serde_json::from_str(text).map_err(unreadable)?;
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
        serde_json::from_value(Value::Object(all)).map_err(unreadable)
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
