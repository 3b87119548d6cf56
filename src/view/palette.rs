//! Colours: those of regions, and ramps for what is measured at each pixel.
//!
//! Ember, lagoon and grey are our own. Viridis and magma, by S. van der Walt and N. Smith (matplotlib, 2015, CC0), are given
//! by every tenth part of theirs, and straight lines between. Turbo is the polynomial by A. Mikhailov (Google, 2019,
//! Apache 2.0). All but turbo grow steadily lighter; turbo tells more values apart, and is lightest in the middle.

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
pub const PALETTES: [Choice; 6] = [
    choice("ember", "Ember"),
    choice("lagoon", "Lagoon"),
    choice("turbo", "Turbo"),
    choice("viridis", "Viridis"),
    choice("magma", "Magma"),
    choice("grey", "Grey"),
];

const fn choice(value: &'static str, label: &'static str) -> Choice {
    Choice { value, label }
}

/// Eleven colours, each tenth part of the way.
const VIRIDIS: [u32; 11] = [
    0x44_01_54, 0x48_24_75, 0x41_44_87, 0x35_5f_8d, 0x2a_78_8e, 0x21_91_8c, 0x22_a8_84, 0x44_bf_70,
    0x7a_d1_51, 0xbd_df_26, 0xfd_e7_25,
];
const MAGMA: [u32; 11] = [
    0x00_00_04, 0x14_0e_36, 0x3b_0f_70, 0x64_1a_80, 0x8c_29_81, 0xb7_37_79, 0xde_49_68, 0xf7_70_5c,
    0xfe_9f_6d, 0xfe_cf_92, 0xfc_fd_bf,
];

/// Red, green and blue of turbo, 0–1, from the constant to the fifth power.
const TURBO: [[f32; 6]; 3] = [
    [
        0.135_721, 4.615_393, -42.660_32, 132.131_1, -152.942_4, 59.286_38,
    ],
    [
        0.091_403, 2.194_188, 4.842_967, -14.185_03, 4.277_299, 2.829_566,
    ],
    [
        0.106_673, 12.641_95, -60.582_05, 110.362_8, -89.903_11, 27.348_25,
    ],
];

/// A ramp of 256 colours, from far, little or bad to near, much or good.
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
                "turbo" => TURBO.map(|powers| {
                    let value = powers.iter().rev().fold(0.0, |sum, c| sum * t + c);
                    (255.0 * value.clamp(0.0, 1.0)).round() as u8
                }),
                "viridis" => between(&VIRIDIS, t),
                "magma" => between(&MAGMA, t),
                _ => from_oklch(0.10 + 0.89 * t, 0.0, 0.0),
            }
        })))
    }

    /// The colour at `t` from 0 to 1; clamped.
    pub fn at(&self, t: f32) -> [u8; 3] {
        self.0[(t.clamp(0.0, 1.0) * 255.0).round() as usize]
    }
}

/// The colour at `t` on straight lines between colours that are equally far apart.
fn between(stops: &[u32; 11], t: f32) -> [u8; 3] {
    let place = t * (stops.len() - 1) as f32;
    let i = (place as usize).min(stops.len() - 2);
    let [a, b] = [stops[i], stops[i + 1]].map(|stop| stop.to_be_bytes());
    super::mix([a[1], a[2], a[3]], [b[1], b[2], b[3]], place - i as f32)
}

/// The colour of a label.
pub(super) fn label_colour(label: u8) -> [u8; 3] {
    LABEL_COLOURS[usize::from(label) % LABEL_COLOURS.len()]
}
