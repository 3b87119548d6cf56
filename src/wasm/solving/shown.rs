//! What is asked of an interpretation, whether a solver has it or it was put away.

use serde::Serialize;
use tsify::Tsify;

use super::{Json, Picture, Scene, Word, draw, write};
use crate::error::Error;
use crate::frames::FramePair;
use crate::interpretation::Interpretation;
use crate::probe::probe;
use crate::score::{self, Scores};
use crate::view;

/// How far what is found and the baseline are from the truth.
#[derive(Serialize, Tsify)]
struct ScoreTable {
    found: Scores,
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
    /// A picture, each region's depth in the unit of `scene`'s truth.
    pub fn aligned(&self, kind: &Word, params: &Json, scene: &Scene) -> Result<Picture, Error> {
        let aligned = view::aligned(self.found, &scene.sequence().truth)?;
        let frames = [self.pair.first(), self.pair.second()];
        draw(&kind.view()?, frames, &aligned, &[], &params.view_params()?)
    }

    /// A `Probe` as JSON.
    pub fn probe(&self, at: (usize, usize), params: &Json) -> Result<String, Error> {
        let params = params.view_params()?;
        Ok(write(&probe(self.pair, self.found, &params.scales, at)))
    }

    /// A `Legend` as JSON.
    pub fn legend(&self, kind: &Word, params: &Json) -> Result<String, Error> {
        let params = params.view_params()?;
        Ok(write(&view::legend(&kind.view()?, self.found, &params)?))
    }

    /// A `ScoreTable` as JSON.
    pub fn scores(&self, scene: &Scene) -> Result<String, Error> {
        let truth = &scene.sequence().truth;
        let found = score::compare(self.found, truth)?;
        let baseline = score::compare_flow(&scene.baseline()?.flow, &truth.flow, None)?;
        let (aee, aae) = baseline.unzip();
        Ok(write(&ScoreTable {
            found,
            baseline: FlowScores { aee, aae },
        }))
    }
}
