//! Horn–Schunck beside the method.

use std::cell::RefCell;
use std::rc::Rc;

use wasm_bindgen::prelude::wasm_bindgen;

use super::shown::{Drawn, Shown, Shrunk, drawn_of};
use super::{Frame, Json, Picture, Word};
use crate::error::Error;
use crate::frames::FramePair;
use crate::horn_schunck::interpreted;
use crate::interpretation::Interpretation;

/// What Horn–Schunck makes of two frames.
#[wasm_bindgen]
pub struct Baseline {
    pair: Rc<FramePair>,
    found: Rc<Interpretation>,
    /// Both shrunk, as they were drawn last.
    shrunk: RefCell<Option<Shrunk>>,
}

/// Runs Horn–Schunck on two frames.
#[wasm_bindgen(js_name = hornSchunck)]
pub fn horn_schunck(first: &Frame, second: &Frame) -> Result<Baseline, Error> {
    let pair = FramePair::new(first.0.clone(), second.0.clone())?;
    let found = interpreted(&pair)?;
    Ok(Baseline {
        pair: Rc::new(pair),
        found: Rc::new(found),
        shrunk: RefCell::default(),
    })
}

#[wasm_bindgen]
impl Baseline {
    /// What the colours of a picture stand for: a `Legend` as JSON, `null` where they are no measure.
    pub fn legend(&self, kind: &Word, params: &Json) -> Result<String, Error> {
        self.drawn(params)?.legend(&kind.view()?)
    }

    /// A picture of what it found, which is motion only: `flow` or `arrows`; see `viewCatalogue()`.
    pub fn view(&self, kind: &Word, params: &Json) -> Result<Picture, Error> {
        self.drawn(params)?.picture(&kind.view()?, &[])
    }
}

impl Baseline {
    pub(super) fn found(&self) -> &Interpretation {
        &self.found
    }

    fn drawn(&self, params: &Json) -> Result<Drawn, Error> {
        let params = params.view_params()?;
        Ok(drawn_of(&self.pair, &self.found, &params, &self.shrunk))
    }

    pub(super) fn shown(&self) -> Shown {
        Shown {
            pair: self.pair.clone(),
            found: self.found.clone(),
        }
    }
}
