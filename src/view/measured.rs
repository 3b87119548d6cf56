//! Maps of one number a pixel that is 0 at best: the residual, and how far from the truth.
//!
//! ```text
//! residual  |ψ|, grey levels                 labels  right or wrong
//! depth     100 |aẐ − Z|/Z, percent          motion  |(û, v̂) − (u, v)|, pixels per frame
//! ```
//!
//! a brings each region to the truth's scale, as scores have it; the mean of a map over what it shows is the score. What
//! is not known is hatched. Colours go from 0 to [`ViewParams::most`] or the 98th percentile.

use super::legend::{Form, Hold, Legend, hex, marks, ramp};
use super::palette::Palette;
use super::span::percentile;
use super::{Picture, ViewParams, hatched};
use crate::error::Error;
use crate::file::parts::Parts;
use crate::frames::FramePair;
use crate::grid::Grid;
use crate::interpretation::Interpretation;
use crate::probe::residual;
use crate::score;

const UNKNOWN: [u8; 3] = [104, 106, 112];
const HATCHING: [u8; 3] = [122, 124, 130];
/// Of labels.
const RIGHT: [u8; 3] = [44, 48, 54];
const WRONG: [u8; 3] = [255, 128, 64];
/// Less than this is no range.
const LEAST: f32 = 1e-3;

/// What a map of errors is of.
pub const ERRORS: [&str; 3] = ["labels", "depth", "flow"];

/// A map, and what it is called.
struct Measured {
    /// Not a number where not known.
    values: Grid<f32>,
    quantity: &'static str,
    unit: &'static str,
    /// Whether it is 0 or 1.
    yes_or_no: bool,
}

/// A picture of |ψ|, and its legend: what of the second frame's brightness the motion found leaves unexplained.
///
/// # Errors
/// [`Error::Choice`] for an unknown palette, [`Error::Option`] for a parameter out of range.
pub fn residuals(
    pair: &FramePair,
    found: &Interpretation,
    params: &ViewParams,
) -> Result<(Picture, Legend), Error> {
    let (width, height) = (found.labels.width(), found.labels.height());
    shown(
        &Measured {
            values: Grid::from_fn(width, height, |x, y| residual(pair, found, (x, y)).abs()),
            quantity: "Residual |ψ|",
            unit: "grey levels",
            yes_or_no: false,
        },
        params,
    )
}

/// A picture of how far `found` is from `truth` at each pixel in what is one of [`ERRORS`], and its legend.
///
/// # Errors
/// Those of [`residuals`], [`Error::TruthDiffers`] when the two are of different sizes, [`Error::NothingShared`] where
/// the truth does not have it.
pub fn errors(
    what: &str,
    found: &Interpretation,
    truth: &Parts,
    params: &ViewParams,
) -> Result<(Picture, Legend), Error> {
    let (values, quantity, unit) = match what {
        "labels" => (score::label_errors(found, truth)?, "Labels", ""),
        "depth" => {
            let shares = score::depth_errors(found, truth)?;
            (
                shares.map(|grid| grid.map(|e| 100.0 * e)),
                "Depth error",
                "%",
            )
        }
        "flow" => (score::flow_errors(found, truth)?, "Motion error", "px"),
        _ => {
            return Err(Error::Choice {
                what: "map of errors".to_owned(),
                value: what.to_owned(),
                choices: ERRORS.join(", "),
            });
        }
    };
    let values = values.ok_or(Error::NothingShared)?;
    let yes_or_no = what == "labels";
    shown(
        &Measured {
            values,
            quantity,
            unit,
            yes_or_no,
        },
        params,
    )
}

fn shown(of: &Measured, params: &ViewParams) -> Result<(Picture, Legend), Error> {
    params.check()?;
    let palette = Palette::named(&params.palette)?;
    let most = params
        .most
        .map_or_else(|| automatic(&of.values), |most| most as f32);
    let colour = |value: f32| match value {
        wrong if of.yes_or_no && wrong > 0.0 => WRONG,
        _ if of.yes_or_no => RIGHT,
        value => palette.at(value / most),
    };
    let (width, height) = (of.values.width(), of.values.height());
    let picture = Grid::from_fn(width, height, |x, y| {
        let value = of.values[(x, y)];
        let [r, g, b] = if value.is_finite() {
            colour(value)
        } else if hatched(x, y) {
            HATCHING
        } else {
            UNKNOWN
        };
        [r, g, b, 255]
    });
    let legend = Legend {
        form: if of.yes_or_no { Form::Keys } else { Form::Ramp },
        quantity: of.quantity,
        unit: of.unit,
        colours: if of.yes_or_no {
            [RIGHT, WRONG].map(hex).into()
        } else {
            ramp(&palette)
        },
        names: if of.yes_or_no {
            vec!["right", "wrong"]
        } else {
            Vec::new()
        },
        marks: if of.yes_or_no {
            Vec::new()
        } else {
            marks(|t| most * t)
        },
        hold: (!of.yes_or_no).then(|| Hold {
            most: Some(most.into()),
            ..Hold::default()
        }),
    };
    Ok((picture, legend))
}

/// Nearly the greatest: a few wild ones do not set the range.
fn automatic(values: &Grid<f32>) -> f32 {
    let known = values.data().iter().copied().filter(|v| v.is_finite());
    let mut known: Vec<f32> = known.collect();
    percentile(&mut known, 0.98).unwrap_or(0.0).max(LEAST)
}
