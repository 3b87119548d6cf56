//! Every weight and choice, once: its meaning, unit, range, default, and the term of (7) it scales.
//!
//! The command line, the page, the documentation and the tests read [`catalogue`]; none has a list
//! of its own. Options cross every border as one JSON object `{"preset": "paper", key: value, …}`;
//! keys that are missing keep the preset's default, and `null` means *chosen from the data* where
//! the option allows it.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::error::Error;

/// Curves that may be drawn at most; with the background that makes eight regions.
pub const MAX_CURVES: usize = 7;

/// A configuration to start from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// The method as printed: one scale, Z by descent, one depth field.
    #[default]
    Paper,
    /// Coarse to fine, a field of inverse depth per region, depth eliminated from the motion step.
    Best,
}

impl Preset {
    /// All of them, the default first.
    pub const ALL: &'static [Self] = &[Self::Paper, Self::Best];

    /// What to show for it.
    pub fn label(self) -> &'static str {
        match self {
            Self::Paper => "as in the paper",
            Self::Best => "best: coarse to fine",
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
    /// Whether directions of T are searched over the whole sphere.
    pub search: bool,
    /// Whether the simplest kind of motion that explains a region is chosen.
    pub choose_kind: bool,
    /// Whether large residuals count less than their square.
    pub robust: bool,
    /// Whether regions compete in units of each residual's uncertainty.
    pub normalised: bool,
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
                search: false,
                choose_kind: false,
                robust: false,
                normalised: false,
                max_passes: 150,
                tolerance: 2e-4,
            },
            Preset::Best => Self {
                motion: MotionMethod::Joint,
                depth: DepthMethod::Layers,
                epsilon: 3e-3,
                smoothing: 0.7,
                search: true,
                choose_kind: true,
                robust: true,
                normalised: true,
                max_passes: 60,
                preset,
                ..Self::preset(Preset::Paper)
            },
        }
    }

    /// Reads settings from a JSON object of keys and values.
    ///
    /// # Errors
    /// [`Error::Json`] when the text is no JSON object, [`Error::Choice`] for a key or a choice that
    /// does not exist, [`Error::Option`] for a number outside its range.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let unreadable = |e: serde_json::Error| Error::Json {
            what: "options",
            reason: e.to_string(),
        };
        let given: Map<String, Value> = serde_json::from_str(text).map_err(unreadable)?;
        let preset = match given.get("preset") {
            None => Preset::default(),
            Some(value) => serde_json::from_value(value.clone())
                .map_err(|_| choice("preset", value, &["paper", "best"]))?,
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
    /// [`Error::Option`] for the first one outside.
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

/// What kind of control an option wants.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Control {
    /// A real number.
    Number {
        /// Least value.
        min: f64,
        /// Greatest value.
        max: f64,
        /// Whether `null` stands for *chosen from the data*.
        automatic: bool,
        /// Whether a slider should be logarithmic.
        logarithmic: bool,
    },
    /// A whole number.
    Integer {
        /// Least value.
        min: f64,
        /// Greatest value.
        max: f64,
    },
    /// One of several words.
    Choice {
        /// The words and what each says.
        choices: &'static [Choice],
    },
    /// On or off.
    Toggle,
}

/// One of the words an option can be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Choice {
    /// The word.
    pub value: &'static str,
    /// What to show for it.
    pub label: &'static str,
}

/// One option, described.
#[derive(Clone, Debug, Serialize)]
pub struct Descriptor {
    /// Its key in JSON; on the command line `--` and the key with dashes.
    pub key: &'static str,
    /// Short name.
    pub label: &'static str,
    /// What it does, in a sentence.
    pub meaning: &'static str,
    /// The term of (7), or the step, that it belongs to.
    pub term: &'static str,
    /// Unit, empty when it has none.
    pub unit: &'static str,
    /// Its kind and range.
    #[serde(flatten)]
    pub control: Control,
}

impl Descriptor {
    fn check(&self, value: &Value) -> Result<(), Error> {
        let outside = |min: f64, max: f64| Error::Option {
            key: self.key.to_owned(),
            value: value.to_string(),
            min,
            max,
        };
        match self.control {
            Control::Number {
                automatic: true, ..
            } if value.is_null() => Ok(()),
            Control::Number { min, max, .. } => match value.as_f64() {
                Some(v) if (min..=max).contains(&v) => Ok(()),
                _ => Err(outside(min, max)),
            },
            Control::Integer { min, max } => match value.as_u64() {
                Some(v) if (min..=max).contains(&(v as f64)) => Ok(()),
                _ => Err(outside(min, max)),
            },
            Control::Choice { choices } => {
                let words: Vec<&str> = choices.iter().map(|c| c.value).collect();
                match value.as_str() {
                    Some(v) if words.contains(&v) => Ok(()),
                    _ => Err(choice(self.key, value, &words)),
                }
            }
            Control::Toggle if value.is_boolean() => Ok(()),
            Control::Toggle => Err(choice(self.key, value, &["true", "false"])),
        }
    }
}

fn choice(what: &str, value: &Value, choices: &[&str]) -> Error {
    Error::Choice {
        what: what.to_owned(),
        value: value
            .as_str()
            .map_or_else(|| value.to_string(), str::to_owned),
        choices: choices.join(", "),
    }
}

fn descriptor(key: &str) -> Result<&'static Descriptor, Error> {
    catalogue().iter().find(|d| d.key == key).ok_or_else(|| {
        let keys: Vec<&str> = catalogue().iter().map(|d| d.key).collect();
        choice("option", &Value::from(key), &keys)
    })
}

const fn number(min: f64, max: f64, logarithmic: bool) -> Control {
    Control::Number {
        min,
        max,
        automatic: false,
        logarithmic,
    }
}

const fn weight(max: f64) -> Control {
    Control::Number {
        min: 0.0,
        max,
        automatic: true,
        logarithmic: true,
    }
}

const fn toggle(
    key: &'static str,
    label: &'static str,
    meaning: &'static str,
    term: &'static str,
) -> Descriptor {
    Descriptor {
        key,
        label,
        meaning,
        term,
        unit: "",
        control: Control::Toggle,
    }
}

/// Every option in the order in which a form should show it.
pub fn catalogue() -> &'static [Descriptor] {
    CATALOGUE
}

static CATALOGUE: &[Descriptor] = &[
    Descriptor {
        key: "mu",
        label: "Smoothness μ",
        meaning: "How much smooth depth counts against fitting the frames.",
        term: "μ g(‖∇Z‖) in (7)",
        unit: "grey levels²",
        control: weight(1e6),
    },
    Descriptor {
        key: "lambda",
        label: "Length λ",
        meaning: "How much a pixel of curve costs: larger gives shorter, smoother outlines.",
        term: "λ ∮ds in (7)",
        unit: "grey levels²·px",
        control: weight(1e6),
    },
    Descriptor {
        key: "diffusion",
        label: "Diffusion",
        meaning: "What smooths depth: a function that keeps depth edges, or one that blurs them.",
        term: "g in (7)",
        unit: "",
        control: Control::Choice {
            choices: &[
                Choice {
                    value: "anisotropic",
                    label: "edge-keeping (11)",
                },
                Choice {
                    value: "isotropic",
                    label: "blurring (12)",
                },
            ],
        },
    },
    Descriptor {
        key: "epsilon",
        label: "Edge scale ε",
        meaning: "Depth gradient from which (11) takes a step for an edge; a region's mean inverse depth is 1.",
        term: "g(r/ε) in (7)",
        unit: "1/px",
        control: number(1e-3, 10.0, true),
    },
    Descriptor {
        key: "motion",
        label: "Motion step",
        meaning: "How a region's T and ω are found. With one depth field for all regions it is held fixed.",
        term: "step 1",
        unit: "",
        control: Control::Choice {
            choices: &[
                Choice {
                    value: "least-squares",
                    label: "least squares, depth fixed",
                },
                Choice {
                    value: "joint",
                    label: "depth eliminated",
                },
            ],
        },
    },
    Descriptor {
        key: "rotation_ridge",
        label: "Rotation ridge",
        meaning: "Pull of f·ω towards 0, which a small region cannot tell from translation; a share of the mean diagonal of the normal equations.",
        term: "step 1",
        unit: "",
        control: number(0.0, 1.0, true),
    },
    Descriptor {
        key: "depth",
        label: "Depth step",
        meaning: "How depth is found.",
        term: "step 2",
        unit: "",
        control: Control::Choice {
            choices: &[
                Choice {
                    value: "descent",
                    label: "descent on Z (9), one scale, one field",
                },
                Choice {
                    value: "layers",
                    label: "linear in 1/Z, coarse to fine, a field per region",
                },
            ],
        },
    },
    toggle(
        "search",
        "Search directions",
        "Look for T over the whole sphere of directions, depth eliminated, before it is refined. Coarse to fine only.",
        "step 1",
    ),
    toggle(
        "choose_kind",
        "Choose kinds",
        "Take the simplest of still, rotation, translation and full motion that explains a region nearly as well as the best. Coarse to fine only.",
        "step 1",
    ),
    toggle(
        "robust",
        "Robust fit",
        "Count large residuals less than their square when motion and depth are fitted. Coarse to fine only.",
        "ψ in (7)",
    ),
    toggle(
        "normalised",
        "Fair competition",
        "Let regions compete in units of each residual's uncertainty, so that strong texture does not out-vote weak. Coarse to fine only.",
        "ξ in (17)",
    ),
    Descriptor {
        key: "depth_steps",
        label: "Depth steps",
        meaning: "Steps of (9) in a pass.",
        term: "step 2",
        unit: "",
        control: Control::Integer {
            min: 1.0,
            max: 1000.0,
        },
    },
    Descriptor {
        key: "curve_steps",
        label: "Curve steps",
        meaning: "Steps of (17) in a pass.",
        term: "step 3",
        unit: "",
        control: Control::Integer {
            min: 1.0,
            max: 1000.0,
        },
    },
    Descriptor {
        key: "smoothing",
        label: "Smoothing",
        meaning: "Standard deviation of the Gaussian that both frames are smoothed with before they are differentiated.",
        term: "ψ in (7)",
        unit: "px",
        control: number(0.0, 5.0, false),
    },
    Descriptor {
        key: "max_passes",
        label: "Most passes",
        meaning: "Passes after which the solver stops even if curves still move.",
        term: "stopping",
        unit: "",
        control: Control::Integer {
            min: 1.0,
            max: 10000.0,
        },
    },
    Descriptor {
        key: "tolerance",
        label: "Tolerance",
        meaning: "Share of pixels that may change region in a pass that still counts as standing still.",
        term: "stopping",
        unit: "",
        control: number(0.0, 0.1, true),
    },
];
