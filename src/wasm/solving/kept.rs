//! What a solver has found, put away as bytes and shown again without it.

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::{Array, Uint8Array};
use serde::Deserialize;
use wasm_bindgen::prelude::wasm_bindgen;

use super::files::{self, listed};
use super::found::PICTURES;
use super::shown::{Drawn, Shown, Shrunk, drawn_of};
use super::{Frame, Json, Mesh, Picture, Solver, Word, write};
use crate::curves::{Contour, differing};
use crate::error::Error;
use crate::file::kept::{self, Precision};
use crate::file::motion::{MotionFile, RegionMotion, Seconds};
use crate::file::{png, result};
use crate::frames::FramePair;
use crate::interpretation::Interpretation;
use crate::motion_model::MotionModel;
use crate::probe::probe;
use crate::view::ViewParams;

/// What is taken from a `Contour`.
#[derive(Deserialize)]
struct Outline {
    label: u8,
    closed: bool,
    points: Vec<f32>,
}

/// What is taken from a `Report`.
#[derive(Deserialize)]
struct Account {
    status: String,
    iterations: usize,
    history: Vec<Option<f64>>,
    seconds: Seconds,
    regions: Vec<Model>,
}

/// What is taken from a `RegionReport`.
#[derive(Deserialize)]
struct Model {
    model: MotionModel,
}

#[wasm_bindgen]
impl Solver {
    /// What it has found so far, as bytes for [`Kept`]: all of it, or, if `visible`, as much as an eye sees, which
    /// takes less once it is compressed.
    pub fn keep(&self, visible: bool) -> Uint8Array {
        let precision = if visible {
            Precision::Visible
        } else {
            Precision::Exact
        };
        Uint8Array::from(kept::write(self.found(), precision).as_slice())
    }

    /// Where it stands, as bytes for `setState`: a few kilobytes under `best`. Meant for the end of a pass.
    pub fn state(&self) -> Uint8Array {
        Uint8Array::from(self.solver().state().as_slice())
    }

    /// Goes to where a solver of the same frames, camera, preset, detail and number of curves stood; on an error nothing is
    /// changed. With `setOptions` it goes on from there under others.
    #[wasm_bindgen(js_name = setState)]
    pub fn set_state(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.change().set_state(bytes)
    }

    /// The share of pixels, 0–1, that have another label than in `labels`, which a solver of the same frames gave.
    #[wasm_bindgen(js_name = labelsApart)]
    pub fn labels_apart(&self, labels: &[u8]) -> Result<f64, Error> {
        let own = &self.found().labels;
        if labels.len() != own.len() {
            return Err(Error::Length {
                what: "labels",
                width: own.width(),
                height: own.height(),
                expected: own.len(),
                found: labels.len(),
            });
        }
        Ok(differing(own.data(), labels) as f64 / own.len() as f64)
    }
}

/// What a solver had found when it was asked to `keep` it.
#[wasm_bindgen]
pub struct Kept {
    pair: Rc<FramePair>,
    found: Rc<Interpretation>,
    /// Both shrunk, as they were drawn last.
    shrunk: RefCell<Option<Shrunk>>,
    contours: Vec<Contour>,
    motion: MotionFile,
}

#[wasm_bindgen]
impl Kept {
    /// Reads the bytes. The frames are those that the solver had; `contours` and `report` are what it gave.
    #[wasm_bindgen(constructor)]
    pub fn new(
        first: &Frame,
        second: &Frame,
        bytes: &[u8],
        contours: &Json,
        report: &Json,
    ) -> Result<Kept, Error> {
        let pair = FramePair::new(first.0.clone(), second.0.clone())?;
        let found = kept::read(bytes, "the kept result")?;
        if !found.labels.same_size(&pair.first().rgb) {
            return Err(Error::FilesDiffer {
                name: "the frame",
                size: (pair.width(), pair.height()),
                than: "the kept result",
                expected: (found.labels.width(), found.labels.height()),
            });
        }
        let outlines: Vec<Outline> = contours.list("curves")?;
        let account: Account = report.read("report")?;
        let models: Vec<_> = account.regions.iter().map(|region| region.model).collect();
        let motion = MotionFile {
            regions: RegionMotion::list(&found.motions, &models),
            status: account.status,
            iterations: account.iterations,
            energy: (account.history.iter())
                .map(|e| e.unwrap_or(f64::NAN))
                .collect(),
            seconds: account.seconds,
            depth_scale: None,
        };
        let contours = outlines.into_iter().map(Outline::contour).collect();
        Ok(Self {
            pair: Rc::new(pair),
            found: Rc::new(found),
            shrunk: RefCell::default(),
            contours,
            motion,
        })
    }

    /// A picture of it: one of `viewCatalogue()`, with parameters of its own.
    pub fn view(&self, kind: &Word, params: &Json) -> Result<Picture, Error> {
        self.picture(&kind.view()?, &params.view_params()?)
    }

    /// What is found at a pixel: a `Probe` as JSON, `null` outside the frame. `params` are those of a view.
    pub fn probe(&self, x: usize, y: usize, params: &Json) -> Result<String, Error> {
        let params = params.view_params()?;
        let found = probe(&self.pair, &self.found, &params.scales, (x, y));
        Ok(write(&found))
    }

    /// What the colours of a picture stand for: a `Legend` as JSON, `null` where they are no measure.
    pub fn legend(&self, kind: &Word, params: &Json) -> Result<String, Error> {
        self.drawn(&params.view_params()?).legend(&kind.view()?)
    }

    /// The relief, with the parameters of a view as JSON.
    pub fn mesh(&self, params: &Json) -> Result<Mesh, Error> {
        Ok(Mesh(self.drawn(&params.view_params()?).mesh().0))
    }

    /// All of it, as an array of files `{name, bytes}`. `params` are those of [`Kept::view`].
    #[wasm_bindgen(unchecked_return_type = "{ name: string; bytes: Uint8Array<ArrayBuffer> }[]")]
    pub fn files(&self, params: &Json) -> Result<Array, Error> {
        let params = params.view_params()?;
        let (found, motion) = self.scaled(&params);
        let mut files = result::write(&found, &motion)?;
        for (kind, name) in PICTURES {
            files.push((name, png::write_rgba(&self.picture(kind, &params)?.0)?));
        }
        Ok(listed(files))
    }

    /// One of those that measure, or of the relief: as [`Solver::file`] has it.
    #[wasm_bindgen(unchecked_return_type = "Uint8Array<ArrayBuffer>")]
    pub fn file(&self, name: &Word, params: &Json) -> Result<Uint8Array, Error> {
        let params = params.view_params()?;
        let (found, motion) = self.scaled(&params);
        files::one(&name.text("name of the file")?, &found, &motion, || {
            self.drawn(&params).mesh()
        })
    }
}

impl Kept {
    pub(super) fn shown(&self) -> Shown {
        Shown {
            pair: self.pair.clone(),
            found: self.found.clone(),
        }
    }

    /// All of it with each region's depth in the unit that `params` says.
    fn scaled(&self, params: &ViewParams) -> (Interpretation, MotionFile) {
        let found = self.found.scaled(&params.scales);
        let models: Vec<_> = (self.motion.regions.iter())
            .filter_map(|region| region.model)
            .collect();
        let motion = MotionFile {
            regions: RegionMotion::list(&found.motions, &models),
            ..self.motion.clone()
        };
        (found, motion)
    }

    fn drawn(&self, params: &ViewParams) -> Drawn {
        drawn_of(&self.pair, &self.found, params, &self.shrunk)
    }

    fn picture(&self, kind: &str, params: &ViewParams) -> Result<Picture, Error> {
        self.drawn(params).picture(kind, &self.contours)
    }
}

impl Outline {
    fn contour(self) -> Contour {
        Contour {
            label: self.label,
            closed: self.closed,
            points: self.points.as_chunks::<2>().0.to_vec(),
        }
    }
}
