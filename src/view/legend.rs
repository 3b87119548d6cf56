//! What the colours of a picture stand for, in numbers.

use serde::Serialize;

use super::ViewParams;
use super::flow::{full_speed, wheel};
use super::palette::{LABEL_COLOURS, Palette};
use super::span::Span;
use crate::error::Error;
use crate::interpretation::Interpretation;

/// Colours of a ramp or of a wheel that a legend lists.
const STEPS: usize = 24;
/// Marks along a ramp.
const MARKS: usize = 5;

/// How a legend is to be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// Colours from one end to the other.
    Ramp,
    /// Colours of the directions, from right clockwise on screen, white in the middle.
    Wheel,
    /// Lengths of arrows.
    Arrow,
    /// A colour for each label, 0 the background.
    Keys,
}

/// A value at a place of the legend.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Mark {
    /// 0 at the start (or the middle of a wheel), 1 at the end (or its rim).
    pub at: f32,
    /// What stands there, in the legend's unit.
    pub value: f32,
}

/// The legend of a picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Legend {
    /// How it is to be drawn.
    pub form: Form,
    /// What is shown.
    pub quantity: &'static str,
    /// Its unit, empty where it has none.
    pub unit: &'static str,
    /// `#rrggbb`, in order.
    pub colours: Vec<String>,
    /// What each colour is called, where those are no labels.
    pub names: Vec<&'static str>,
    /// Values along it, in order.
    pub marks: Vec<Mark>,
    /// What would draw the same colours for the same values whatever is found later; null where that is so anyway.
    pub hold: Option<Hold>,
}

/// The ends of a range, as [`ViewParams`] take them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Hold {
    /// For [`ViewParams::span`].
    pub span: Option<[f64; 2]>,
    /// For [`ViewParams::speed`].
    pub speed: Option<f64>,
    /// For [`ViewParams::most`].
    pub most: Option<f64>,
}

impl Legend {
    /// The same for frames `n` times as large as those that are drawn.
    pub fn enlarged(mut self, n: usize) -> Self {
        if matches!(self.form, Form::Wheel | Form::Arrow) {
            for mark in &mut self.marks {
                mark.value *= n as f32;
            }
            if let Some(Hold {
                speed: Some(speed), ..
            }) = &mut self.hold
            {
                *speed *= n as f64;
            }
        }
        self
    }
}

/// The legend of the view `kind` of `found`; `None` for a view whose colours are no measure, and for depth where none
/// is known.
///
/// # Errors
/// [`Error::Choice`] for an unknown palette, [`Error::Option`] for a parameter out of range.
pub fn legend(
    kind: &str,
    found: &Interpretation,
    params: &ViewParams,
) -> Result<Option<Legend>, Error> {
    params.check()?;
    let scaled;
    let found = if params.scales.iter().all(|&s| s == 1.0) {
        found
    } else {
        scaled = found.scaled(&params.scales);
        &scaled
    };
    Ok(match kind {
        "depth" => of_depth(found, params)?,
        "flow" => Some(of_motion(found, params, Form::Wheel)),
        "arrows" => Some(of_motion(found, params, Form::Arrow)),
        "confidence" => Some(Legend {
            form: Form::Ramp,
            quantity: "Confidence",
            unit: "",
            colours: ramp(&Palette::named(&params.palette)?),
            names: Vec::new(),
            marks: marks(|t| t),
            hold: None,
        }),
        "labels" => Some(Legend {
            form: Form::Keys,
            quantity: "Region",
            unit: "",
            colours: (LABEL_COLOURS.iter().cycle().take(found.regions()))
                .map(|&rgb| hex(rgb))
                .collect(),
            names: Vec::new(),
            marks: Vec::new(),
            hold: None,
        }),
        _ => None,
    })
}

/// Linear in 1/Z, marked in Z.
fn of_depth(found: &Interpretation, params: &ViewParams) -> Result<Option<Legend>, Error> {
    let palette = Palette::named(&params.palette)?;
    let given = |[far, near]: [f64; 2]| Span {
        far: far as f32,
        near: near as f32,
    };
    let span = params.span.map(given);
    // A range for each region is no range of the picture.
    let span = match span {
        None if params.per_region => None,
        None => Span::of(found, false, |_| true),
        given => given,
    };
    Ok(span.map(|Span { far, near }| Legend {
        form: Form::Ramp,
        quantity: "Depth",
        unit: "Z̄",
        colours: ramp(&palette),
        names: Vec::new(),
        marks: marks(|t| 1.0 / (far + t * (near - far))),
        hold: Some(Hold {
            span: Some([far, near].map(f64::from)),
            ..Hold::default()
        }),
    }))
}

fn of_motion(found: &Interpretation, params: &ViewParams, form: Form) -> Legend {
    let full = full_speed(found, params);
    let wheel = wheel();
    let colours = match form {
        Form::Wheel => (0..STEPS)
            .map(|i| hex(wheel[i * wheel.len() / STEPS]))
            .collect(),
        _ => Vec::new(),
    };
    Legend {
        form,
        quantity: "Motion",
        unit: "px/frame",
        colours,
        names: Vec::new(),
        marks: vec![Mark {
            at: 1.0,
            value: full,
        }],
        hold: Some(Hold {
            speed: Some(full.into()),
            ..Hold::default()
        }),
    }
}

/// Colours along a palette.
pub(super) fn ramp(palette: &Palette) -> Vec<String> {
    (0..STEPS)
        .map(|i| hex(palette.at(i as f32 / (STEPS - 1) as f32)))
        .collect()
}

pub(super) fn marks(value: impl Fn(f32) -> f32) -> Vec<Mark> {
    (0..MARKS)
        .map(|i| i as f32 / (MARKS - 1) as f32)
        .map(|at| Mark {
            at,
            value: value(at),
        })
        .collect()
}

pub(super) fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
