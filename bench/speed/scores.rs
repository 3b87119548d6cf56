//! How far a picture is from the truth.

use relievo::Interpretation;
use relievo::score::compare_flow;
use serde::Serialize;

use crate::Failure;
use crate::sequence::Truth;

/// The distance between a picture and the truth.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Score {
    /// Mean end-point error in pixels.
    pub aee: f64,
    /// Share of wrong labels, 0–1.
    pub wrong: f64,
}

impl Score {
    /// Of `found`.
    pub fn of(found: &Interpretation, truth: &Truth) -> Result<Self, Failure> {
        let flow = compare_flow(&found.flow, &truth.flow, None)?;
        let pairs = found.labels.data().iter().zip(truth.labels.data());
        let wrong = pairs.filter(|(a, b)| a != b).count();
        Ok(Self {
            aee: flow.map_or(f64::NAN, |(aee, _)| aee),
            wrong: wrong as f64 / truth.labels.len() as f64,
        })
    }
}
