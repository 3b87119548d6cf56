//! Colours: those of regions, and ramps for depth that grow steadily lighter.

use super::colour::from_oklch;
use super::params::{Choice, choose};
use crate::error::Error;

/// Colours of labels 0 to 7: grey for the background, then those of M. Okabe and K. Ito (2008), which
/// people with any kind of colour vision tell apart.
pub const LABEL_COLOURS: [[u8; 3]; 8] = [
    [136, 136, 142],
    [230, 159, 0],
    [86, 180, 233],
    [0, 158, 115],
    [240, 228, 66],
    [0, 114, 178],
    [213, 94, 0],
    [204, 121, 167],
];

/// The ramps to choose from.
pub const PALETTES: [Choice; 3] = [
    Choice {
        value: "ember",
        label: "Ember",
    },
    Choice {
        value: "lagoon",
        label: "Lagoon",
    },
    Choice {
        value: "grey",
        label: "Grey",
    },
];

/// A ramp of 256 colours from dark (far) to light (near).
#[derive(Clone, Debug, PartialEq)]
pub struct Palette([[u8; 3]; 256]);

impl Palette {
    /// The ramp of a value of [`PALETTES`].
    ///
    /// # Errors
    /// [`Error::Choice`] for any other.
    pub fn named(name: &str) -> Result<Self, Error> {
        choose("palette", name, &PALETTES)?;
        Ok(Self(std::array::from_fn(|i| {
            let t = i as f32 / 255.0;
            // Chroma vanishes at both ends; lightness rises steadily between.
            let bow = (std::f32::consts::PI * t.powf(0.8)).sin();
            match name {
                "ember" => from_oklch(0.16 + 0.81 * t, 0.02 + 0.17 * bow, 285.0 + 175.0 * t),
                "lagoon" => from_oklch(0.16 + 0.81 * t, 0.02 + 0.13 * bow, 290.0 - 180.0 * t),
                _ => from_oklch(0.10 + 0.89 * t, 0.0, 0.0),
            }
        })))
    }

    /// The colour at `t`, 0 = far and dark, 1 = near and light; clamped.
    pub fn at(&self, t: f32) -> [u8; 3] {
        self.0[(t.clamp(0.0, 1.0) * 255.0).round() as usize]
    }
}

/// The colour of a label.
pub(super) fn label_colour(label: u8) -> [u8; 3] {
    LABEL_COLOURS[usize::from(label) % LABEL_COLOURS.len()]
}
