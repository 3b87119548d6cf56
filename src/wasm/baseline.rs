//! Horn–Schunck beside the method.

use wasm_bindgen::prelude::wasm_bindgen;

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
