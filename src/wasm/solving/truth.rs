//! What is known to be true of two frames: a built-in sequence's own, or read from files.

use std::cell::RefCell;
use std::rc::Rc;

use serde::Serialize;
use tsify::Tsify;
use wasm_bindgen::prelude::wasm_bindgen;

use super::files::{Files, files_of};
use super::shown::{Drawn, Shrunk, drawn_of};
use super::{Baseline, Frame, Json, Kept, Picture, Scene, Solver, Word, write};
use crate::error::Error;
use crate::file::kind::kind_of;
use crate::file::parts::Parts;
use crate::frames::FramePair;
use crate::interpretation::Interpretation;
use crate::view;

/// Which parts of a truth are known.
#[derive(Serialize, Tsify)]
struct KnownParts {
    labels: bool,
    depth: bool,
    flow: bool,
    occlusion: bool,
}

/// The truth of a pair of frames, as far as it is known.
#[wasm_bindgen]
pub struct Truth {
    pair: Rc<FramePair>,
    parts: Parts,
    /// The same to be drawn.
    filled: Rc<Interpretation>,
    /// Frames and truth shrunk, as they were drawn last.
    shrunk: RefCell<Option<Shrunk>>,
}

/// The name under which `SavedResult` and `Truth` take a file; `undefined` where it is something else, such as a frame.
/// Of a file that is `said` to be of a result or a truth only the format is asked.
#[wasm_bindgen(js_name = fileKind)]
pub fn file_kind(name: &Word, bytes: &[u8], said: bool) -> Result<Option<String>, Error> {
    Ok(kind_of(&name.text("name of the file")?, bytes, said).map(str::to_owned))
}

#[wasm_bindgen]
impl Truth {
    /// Reads what is true of two frames from files of any name: flow as `.flo` or KITTI's PNG, labels as 8-bit grey PNG,
    /// depth as PFM or 16-bit grey PNG (disparity where the name has `disp`), motion.json.
    #[wasm_bindgen(constructor)]
    pub fn new(first: &Frame, second: &Frame, files: &Files) -> Result<Truth, Error> {
        let mut named: Vec<(String, Vec<u8>)> = Vec::new();
        let mut given: Vec<(&'static str, String)> = Vec::new();
        let files = files_of(files)?;
        // A result has its depth twice, once to the last bit.
        let exact = files.iter().any(|(name, _)| name == "depth.pfm");
        for (name, bytes) in files
            .into_iter()
            .filter(|(name, _)| !exact || name != "depth16.png")
        {
            let Some(kind) = kind_of(&name, &bytes, true) else {
                return Err(Error::NoTruth { name });
            };
            let what = what_of(kind);
            if let Some((_, one)) = given.iter().find(|(other, _)| *other == what) {
                let one = one.clone();
                return Err(Error::TruthTwice {
                    one,
                    other: name,
                    what,
                });
            }
            given.push((what, name));
            named.push((kind.to_owned(), bytes));
        }
        let frames = (first.0.width(), first.0.height());
        // Each by itself first: one that is of other frames is told from those that are of these.
        for file in &named {
            if let Some(truth) = Parts::read(std::slice::from_ref(file))?.size()
                && truth != frames
            {
                return Err(Error::TruthSize { truth, frames });
            }
        }
        let parts = Parts::read(&named)?;
        let filled = parts.filled(frames.0, frames.1)?;
        Ok(Self {
            pair: Rc::new(FramePair::new(first.0.clone(), second.0.clone())?),
            parts,
            filled: Rc::new(filled),
            shrunk: RefCell::default(),
        })
    }

    /// The truth of a built-in sequence.
    #[wasm_bindgen(js_name = ofScene)]
    pub fn of_scene(scene: &Scene) -> Result<Truth, Error> {
        let sequence = scene.sequence();
        let [first, second] = sequence.frames.clone();
        Ok(Self {
            pair: Rc::new(FramePair::new(first, second)?),
            parts: Parts::from(&sequence.truth),
            filled: Rc::new(sequence.truth.clone()),
            shrunk: RefCell::default(),
        })
    }

    /// Which parts are known: `KnownParts` as JSON.
    pub fn known(&self) -> String {
        write(&KnownParts {
            labels: self.parts.labels.is_some(),
            depth: self.parts.depth.is_some(),
            flow: self.parts.flow.is_some(),
            occlusion: self.parts.occluded.is_some(),
        })
    }

    /// A picture of it: one of `viewCatalogue()`, with parameters of its own as JSON.
    pub fn view(&self, kind: &Word, params: &Json) -> Result<Picture, Error> {
        self.drawn(params)?.picture(&kind.view()?, &[])
    }

    /// What the colours of such a picture stand for: a `Legend` as JSON, `null` where they are no measure.
    pub fn legend(&self, kind: &Word, params: &Json) -> Result<String, Error> {
        self.drawn(params)?.legend(&kind.view()?)
    }

    /// `params` with the ends of the colours set as the truth would have them, where they are left open: what is drawn
    /// with them can be compared with the truth by eye.
    #[wasm_bindgen(js_name = sameColours)]
    pub fn same_colours(&self, params: &Json) -> Result<String, Error> {
        let params = params.view_params()?;
        Ok(write(&view::same_colours(&self.filled, &params)))
    }
}

impl Truth {
    pub(super) fn parts(&self) -> &Parts {
        &self.parts
    }

    fn drawn(&self, params: &Json) -> Result<Drawn, Error> {
        let params = params.view_params()?;
        Ok(drawn_of(&self.pair, &self.filled, &params, &self.shrunk))
    }
}

/// What a file tells.
fn what_of(kind: &str) -> &'static str {
    match kind.split('.').next() {
        Some("flow") => "flow",
        Some("labels") => "labels",
        Some("occlusion") => "occlusion",
        Some("motion") => "motions",
        _ => "depth",
    }
}

macro_rules! compared_with_truth {
    ($($of:ty),*) => {$(
        #[wasm_bindgen]
        impl $of {
            /// A picture, each region's depth in the unit of the truth: two frames do not tell it.
            #[wasm_bindgen(js_name = viewAligned)]
            pub fn view_aligned(&self, kind: &Word, params: &Json, truth: &Truth) -> Result<Picture, Error> {
                self.shown().aligned(kind, params, truth.parts())
            }

            /// How far from the truth each pixel is in `what`: labels, depth (percent) or flow (pixels).
            #[wasm_bindgen(js_name = viewErrors)]
            pub fn view_errors(&self, what: &Word, params: &Json, truth: &Truth) -> Result<Picture, Error> {
                Ok(Picture(self.shown().errors(what, params, truth.parts())?.0))
            }

            /// What the colours of that picture stand for: a `Legend` as JSON.
            #[wasm_bindgen(js_name = errorLegend)]
            pub fn error_legend(&self, what: &Word, params: &Json, truth: &Truth) -> Result<String, Error> {
                Ok(write(&self.shown().errors(what, params, truth.parts())?.1))
            }

            /// How far it is from the truth, and `baseline` from its image motion: a `ScoreTable` as JSON.
            pub fn scores(&self, truth: &Truth, baseline: &Baseline) -> Result<String, Error> {
                self.shown().scores(truth.parts(), baseline.found())
            }
        }
    )*};
}

compared_with_truth!(Solver, Kept, Baseline);
