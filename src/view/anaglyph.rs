//! Both eyes' pictures in one, for coloured glasses.
//!
//! Each output channel is a weighted sum of the six input channels, in linear light, clipped and encoded. Dubois chose the
//! weights so that, through the filters and on the screen that he measured, each eye's colours come as near to those of its
//! picture as least squares can bring them: "A projection method to generate anaglyph stereo images" (ICASSP 2001), and
//! the sets that he published from 2009 on. Weights of a channel that is used sum to 1, so that what both eyes see alike
//! keeps its brightness. Luminance is that of Rec. 709.

use super::colour::{Encoder, decode};
use super::params::{Choice, choose};
use super::stereo::pair;
use super::{Picture, ViewParams};
use crate::error::Error;
use crate::frames::Frame;
use crate::grid::Grid;
use crate::interpretation::Interpretation;

/// The glasses to choose from, left eye's colour first.
pub const GLASSES: [Choice; 7] = [
    Choice {
        value: "red-cyan",
        label: "Red / cyan",
    },
    Choice {
        value: "red-cyan-lcd",
        label: "Red / cyan, for LCD screens",
    },
    Choice {
        value: "half-colour",
        label: "Red / cyan, half colour",
    },
    Choice {
        value: "grey",
        label: "Red / cyan, in grey",
    },
    Choice {
        value: "green-magenta",
        label: "Green / magenta",
    },
    Choice {
        value: "amber-blue",
        label: "Amber / blue",
    },
    Choice {
        value: "red-blue",
        label: "Red / blue, in grey",
    },
];

/// By what each of [`GLASSES`] is served, with its source.
pub const METHODS: [&str; 7] = [
    "Least squares, E. Dubois, ICASSP 2001",
    "Least squares for LCD screens, E. Dubois 2009",
    "Half colour: the left eye's luminance, the right eye's green and blue",
    "Each eye's luminance (Rec. 709)",
    "Least squares, E. Dubois 2009",
    "Least squares, E. Dubois 2009",
    "Each eye's luminance (Rec. 709)",
];

/// Weights of one pair of glasses: rows R, G, B out; columns left R, G, B, right R, G, B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glasses(pub [[f32; 6]; 3]);

/// Dubois 2001.
const RED_CYAN: [[f32; 6]; 3] = [
    [
        0.4561,
        0.500484,
        0.176381,
        -0.0434706,
        -0.0879388,
        -0.00155529,
    ],
    [
        -0.0400822, -0.0378246, -0.0157589, 0.378476, 0.73364, -0.0184503,
    ],
    [
        -0.0152161,
        -0.0205971,
        -0.00546856,
        -0.0721527,
        -0.112961,
        1.2264,
    ],
];
/// Dubois 2009, for the primaries of LCD screens.
const RED_CYAN_LCD: [[f32; 6]; 3] = [
    [0.437, 0.449, 0.164, -0.011, -0.032, -0.007],
    [-0.062, -0.062, -0.024, 0.377, 0.761, 0.009],
    [-0.048, -0.050, -0.017, -0.026, -0.093, 1.234],
];
const GREEN_MAGENTA: [[f32; 6]; 3] = [
    [-0.062, -0.158, -0.039, 0.529, 0.705, 0.024],
    [0.284, 0.668, 0.143, -0.016, -0.015, -0.065],
    [-0.015, -0.027, 0.021, 0.009, 0.075, 0.937],
];
const AMBER_BLUE: [[f32; 6]; 3] = [
    [1.062, -0.205, 0.299, -0.016, -0.123, -0.017],
    [-0.026, 0.908, 0.068, 0.006, 0.062, -0.017],
    [-0.038, -0.173, 0.022, 0.094, 0.185, 0.911],
];
/// Of the left eye's picture, and of the right eye's.
const LUMINANCE: [[f32; 6]; 2] = [
    [0.2126, 0.7152, 0.0722, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.2126, 0.7152, 0.0722],
];
/// Colours of the right eye alone: the left eye sees no saturated red flicker.
const HALF_COLOUR: [[f32; 6]; 3] = [
    LUMINANCE[0],
    [0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
];
const GREY: [[f32; 6]; 3] = [LUMINANCE[0], LUMINANCE[1], LUMINANCE[1]];
/// No projection is published for these.
const RED_BLUE: [[f32; 6]; 3] = [LUMINANCE[0], [0.0; 6], LUMINANCE[1]];

impl Glasses {
    /// The weights of a value of [`GLASSES`].
    ///
    /// # Errors
    /// [`Error::Choice`] for any other.
    pub fn named(name: &str) -> Result<Self, Error> {
        let all = [
            RED_CYAN,
            RED_CYAN_LCD,
            HALF_COLOUR,
            GREY,
            GREEN_MAGENTA,
            AMBER_BLUE,
            RED_BLUE,
        ];
        choose("pair of glasses", name, &GLASSES).map(|i| Self(all[i]))
    }
}

/// The anaglyph of two sRGB pictures of the same size.
pub fn dubois(left: &Grid<[u8; 3]>, right: &Grid<[u8; 3]>, glasses: &Glasses) -> Picture {
    let linear: Vec<f32> = (0..=255).map(decode).collect();
    let encoder = Encoder::new();
    let mut out = Grid::new(left.width(), left.height(), [0, 0, 0, 255]);
    let pixels = left.data().iter().zip(right.data());
    for (out, (left, right)) in out.data_mut().iter_mut().zip(pixels) {
        let mut six = [0.0; 6];
        for (light, &byte) in six.iter_mut().zip(left.iter().chain(right)) {
            *light = linear[usize::from(byte)];
        }
        for (out, weights) in out.iter_mut().zip(&glasses.0) {
            let mut sum = 0.0;
            for (weight, light) in weights.iter().zip(&six) {
                sum += weight * light;
            }
            *out = encoder.encode(sum);
        }
    }
    out
}

/// The anaglyph of the frame and its second eye.
///
/// # Errors
/// [`Error::Choice`] for unknown glasses.
pub fn anaglyph(
    frame: &Frame,
    found: &Interpretation,
    params: &ViewParams,
) -> Result<Picture, Error> {
    let glasses = Glasses::named(&params.glasses)?;
    let [left, right] = pair(frame, found, params);
    Ok(dubois(&left, &right, &glasses))
}
