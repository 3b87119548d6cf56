//! What an option is: its name, its meaning, its range, and whether a value lies within it.

use serde::Serialize;
use serde_json::Value;

use super::Preset;
use super::catalogue::catalogue;
use crate::error::Error;

/// What kind of control an option wants.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
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
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Choice {
    /// The word.
    pub value: &'static str,
    /// What to show for it.
    pub label: &'static str,
}

/// One option, described.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Descriptor {
    /// Its key in JSON; on the command line `--` and the key with dashes.
    #[cfg_attr(
        all(target_arch = "wasm32", feature = "javascript"),
        tsify(type = "Exclude<keyof Options, \"preset\">")
    )]
    pub key: &'static str,
    /// The heading that it stands under: a term of (7), the frames, or when to stop.
    pub group: &'static str,
    /// Whether it is one of the few to be shown first.
    pub main: bool,
    /// Short name.
    pub label: &'static str,
    /// What it does, in a sentence.
    pub meaning: &'static str,
    /// The term of (7), or the step, that it belongs to.
    pub term: &'static str,
    /// Unit, empty when it has none.
    pub unit: &'static str,
    /// The presets that it has an effect under.
    pub presets: &'static [Preset],
    /// Its kind and range.
    #[serde(flatten)]
    // A union cannot be extended by an interface; named so, it becomes an intersection.
    #[cfg_attr(
        all(target_arch = "wasm32", feature = "javascript"),
        tsify(type = "Control")
    )]
    pub control: Control,
}

impl Descriptor {
    pub(super) fn check(&self, value: &Value) -> Result<(), Error> {
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
                _ => Err(Error::Count {
                    key: self.key.to_owned(),
                    value: value.to_string(),
                    min,
                    max,
                }),
            },
            Control::Choice { choices } => {
                let words: Vec<&str> = choices.iter().map(|c| c.value).collect();
                match value.as_str() {
                    Some(v) if words.contains(&v) => Ok(()),
                    _ => Err(choice(&of(self.key), value, &words)),
                }
            }
            Control::Toggle if value.is_boolean() => Ok(()),
            Control::Toggle => Err(choice(&of(self.key), value, &["true", "false"])),
        }
    }
}

fn of(key: &str) -> String {
    format!("value of {key}")
}

pub(super) fn choice(what: &str, value: &Value, choices: &[&str]) -> Error {
    Error::Choice {
        what: what.to_owned(),
        value: value
            .as_str()
            .map_or_else(|| value.to_string(), str::to_owned),
        choices: choices.join(", "),
    }
}

pub(super) fn descriptor(key: &str) -> Result<&'static Descriptor, Error> {
    catalogue().iter().find(|d| d.key == key).ok_or_else(|| {
        let keys: Vec<&str> = catalogue().iter().map(|d| d.key).collect();
        choice("option", &Value::from(key), &keys)
    })
}
