//! What is asked of an interpretation, whether a solver has it or it was put away.

use std::cell::RefCell;
use std::rc::Rc;

use serde::Serialize;
use tsify::Tsify;

use super::{Json, Picture, Word, write};
use crate::curves::Contour;
use crate::error::Error;
use crate::file::parts::Parts;
use crate::frames::{Frame, FramePair};
use crate::interpretation::Interpretation;
use crate::score::{self, PartScores};
use crate::view::{self, Legend, Mesh, ViewParams};
use crate::working::factor_to_draw;

/// The view that takes both frames.
pub(super) const RESIDUAL: &str = "residual";

/// How far what is found and the baseline are from the truth.
#[derive(Serialize, Tsify)]
struct ScoreTable {
    found: PartScores,
    baseline: FlowScores,
}

/// How far a flow is from the true one; null where no true flow is known.
#[derive(Serialize, Tsify)]
struct FlowScores {
    /// Mean end-point error, pixels.
    aee: Option<f64>,
    /// Mean angular error, degrees.
    aae: Option<f64>,
}

/// Two frames and what is found of them.
pub(super) struct Shown {
    pub pair: Rc<FramePair>,
    pub found: Rc<Interpretation>,
}

impl Shown {
    /// A picture, each region's depth in the unit of the truth.
    pub fn aligned(&self, kind: &Word, params: &Json, truth: &Parts) -> Result<Picture, Error> {
        let aligned = Rc::new(view::aligned(&self.found, truth)?);
        let params = params.view_params()?;
        drawn_of(&self.pair, &aligned, &params, &RefCell::default()).picture(&kind.view()?, &[])
    }

    /// A map of errors and its legend.
    pub fn errors(
        &self,
        what: &Word,
        params: &Json,
        truth: &Parts,
    ) -> Result<(view::Picture, Legend), Error> {
        let what = what.text("map of errors")?;
        view::errors(&what, &self.found, truth, &params.view_params()?)
    }

    /// A `ScoreTable` as JSON, `null` where the truth has nothing of what is found.
    pub fn scores(&self, truth: &Parts, baseline: &Interpretation) -> Result<String, Error> {
        let found = match score::compare_found(&self.found, truth) {
            Err(Error::NothingShared) => return Ok("null".to_owned()),
            scores => scores?,
        };
        let flow = truth.flow.as_ref();
        let flow = flow.map(|flow| score::compare_flow(&baseline.flow, flow, None));
        let (aee, aae) = flow.transpose()?.flatten().unzip();
        Ok(write(&ScoreTable {
            found,
            baseline: FlowScores { aee, aae },
        }))
    }
}

/// Two frames and what is found of them, as large as a picture is to be drawn.
pub(super) struct Drawn {
    factor: usize,
    pair: Rc<FramePair>,
    found: Rc<Interpretation>,
    params: ViewParams,
}

impl Drawn {
    /// All of it shrunk `factor` times. `params` are those of the frames at their size.
    pub fn of(
        factor: usize,
        pair: Rc<FramePair>,
        found: Rc<Interpretation>,
        params: ViewParams,
    ) -> Self {
        let speed = params.speed.map(|speed| speed / factor as f64);
        Self {
            factor,
            pair,
            found,
            params: ViewParams { speed, ..params },
        }
    }

    /// A picture; `contours` are those of the frames at their size.
    pub fn picture(&self, kind: &str, contours: &[Contour]) -> Result<Picture, Error> {
        if kind == RESIDUAL {
            return Ok(Picture(self.residuals()?.0));
        }
        let frame = if kind == "second" {
            self.pair.second()
        } else {
            self.pair.first()
        };
        let contours: Vec<Contour> = (contours.iter())
            .map(|c| c.clone().shrunk(self.factor))
            .collect();
        view::draw(kind, frame, &self.found, &contours, &self.params).map(Picture)
    }

    /// The relief, and the frame that lies on it.
    pub fn mesh(&self) -> (Mesh, Frame) {
        let frame = self.pair.first();
        (view::mesh(frame, &self.found, &self.params), frame.clone())
    }

    /// What the colours of a picture stand for, motion in pixels of the frames at their size: a `Legend` as JSON.
    pub fn legend(&self, kind: &str) -> Result<String, Error> {
        if kind == RESIDUAL {
            return Ok(write(&self.residuals()?.1));
        }
        let legend = view::legend(kind, &self.found, &self.params)?;
        Ok(write(&legend.map(|legend| legend.enlarged(self.factor))))
    }

    fn residuals(&self) -> Result<(view::Picture, Legend), Error> {
        view::residuals(&self.pair, &self.found, &self.params)
    }
}

/// The same of frames and what is found at their size. What was shrunk last is kept in `last`.
pub(super) fn drawn_of(
    pair: &Rc<FramePair>,
    found: &Rc<Interpretation>,
    params: &ViewParams,
    last: &RefCell<Option<Shrunk>>,
) -> Drawn {
    let n = params
        .pixels
        .map_or(1, |most| factor_to_draw(pair.first(), 1, most));
    if n == 1 {
        return Drawn::of(1, pair.clone(), found.clone(), params.clone());
    }
    let mut last = last.borrow_mut();
    if last.as_ref().is_none_or(|last| last.factor != n) {
        *last = Some(Shrunk::of(pair, found, n));
    }
    let Shrunk { pair, found, .. } = last.as_ref().expect("it has just been made");
    Drawn::of(n, pair.clone(), found.clone(), params.clone())
}

/// Two frames and what was found of them, shrunk alike, to be drawn.
pub(super) struct Shrunk {
    /// How many times.
    pub factor: usize,
    /// The frames.
    pub pair: Rc<FramePair>,
    /// What was found, as if of them.
    pub found: Rc<Interpretation>,
}

impl Shrunk {
    /// `pair` and what was `found` of it shrunk `factor` times, which [`factor_to_draw`] gives.
    pub fn of(pair: &FramePair, found: &Interpretation, factor: usize) -> Self {
        Self {
            factor,
            pair: Rc::new(pair.shrunk(factor)),
            found: Rc::new(found.shrunk(factor)),
        }
    }
}
