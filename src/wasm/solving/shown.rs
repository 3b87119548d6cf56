//! What is asked of an interpretation, whether a solver has it or it was put away.

use serde::Serialize;
use tsify::Tsify;

use super::{Json, Picture, Word, draw, write};
use crate::error::Error;
use crate::file::parts::Parts;
use crate::frames::FramePair;
use crate::interpretation::Interpretation;
use crate::probe::probe;
use crate::score::{self, PartScores};
use crate::view::{self, Legend};

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
pub(super) struct Shown<'a> {
    pub pair: &'a FramePair,
    pub found: &'a Interpretation,
}

impl Shown<'_> {
    /// A picture, each region's depth in the unit of the truth.
    pub fn aligned(&self, kind: &Word, params: &Json, truth: &Parts) -> Result<Picture, Error> {
        let aligned = view::aligned(self.found, truth)?;
        let frames = [self.pair.first(), self.pair.second()];
        draw(&kind.view()?, frames, &aligned, &[], &params.view_params()?)
    }

    /// A map of errors and its legend.
    pub fn errors(
        &self,
        what: &Word,
        params: &Json,
        truth: &Parts,
    ) -> Result<(view::Picture, Legend), Error> {
        let what = what.text("map of errors")?;
        view::errors(&what, self.found, truth, &params.view_params()?)
    }

    /// A `Probe` as JSON.
    pub fn probe(&self, at: (usize, usize), params: &Json) -> Result<String, Error> {
        let params = params.view_params()?;
        Ok(write(&probe(self.pair, self.found, &params.scales, at)))
    }

    /// A `Legend` as JSON.
    pub fn legend(&self, kind: &Word, params: &Json) -> Result<String, Error> {
        let params = params.view_params()?;
        let kind = kind.view()?;
        if kind == RESIDUAL {
            return Ok(write(&view::residuals(self.pair, self.found, &params)?.1));
        }
        Ok(write(&view::legend(&kind, self.found, &params)?))
    }

    /// A `ScoreTable` as JSON, `null` where the truth has nothing of what is found.
    pub fn scores(&self, truth: &Parts, baseline: &Interpretation) -> Result<String, Error> {
        let found = match score::compare_found(self.found, truth) {
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
