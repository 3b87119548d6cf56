//! Horn–Schunck beside the method.

use wasm_bindgen::prelude::wasm_bindgen;

use super::shown::Shown;
use super::{Frame, Json, Picture, Word, draw};
use crate::error::Error;
use crate::frames::FramePair;
use crate::horn_schunck::interpreted;
use crate::interpretation::Interpretation;

/// What Horn–Schunck makes of two frames.
#[wasm_bindgen]
pub struct Baseline {
    pair: FramePair,
    found: Interpretation,
}

/// Runs Horn–Schunck on two frames.
#[wasm_bindgen(js_name = hornSchunck)]
pub fn horn_schunck(first: &Frame, second: &Frame) -> Result<Baseline, Error> {
    let pair = FramePair::new(first.0.clone(), second.0.clone())?;
    let found = interpreted(&pair)?;
    Ok(Baseline { pair, found })
}

#[wasm_bindgen]
impl Baseline {
    /// What the colours of a picture stand for: a `Legend` as JSON, `null` where they are no measure.
    pub fn legend(&self, kind: &Word, params: &Json) -> Result<String, Error> {
        self.shown().legend(kind, params)
    }

    /// A picture of what it found, which is motion only: `flow` or `arrows`; see `viewCatalogue()`.
    pub fn view(&self, kind: &Word, params: &Json) -> Result<Picture, Error> {
        let frames = [self.pair.first(), self.pair.second()];
        draw(
            &kind.view()?,
            frames,
            &self.found,
            &[],
            &params.view_params()?,
        )
    }
}

impl Baseline {
    pub(super) fn found(&self) -> &Interpretation {
        &self.found
    }

    pub(super) fn shown(&self) -> Shown<'_> {
        Shown {
            pair: &self.pair,
            found: &self.found,
        }
    }
}
