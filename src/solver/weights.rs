//! The weights of (7), as they are reported, and those of the coarse-to-fine approach.

use serde::Serialize;

use crate::options::Options;

/// μ/σ² of the coarse-to-fine approach, whose depth is inverse: while regions still hold pixels
/// of others, which depth must not explain away, and once they have settled.
const MU_OF_LAYERS: [f64; 2] = [1.0, 0.1];
/// λ/σ² of the coarse-to-fine approach, whose ξ counts a pixel once and whose outlines cost half where they lie
/// on edges.
const LAMBDA_OF_LAYERS: f64 = 2.5;
/// Least σ in grey levels where frames are warped, and derivatives only tell directions.
const LEAST_SIGMA_OF_LAYERS: f64 = 0.25;

/// The weights in force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Weights {
    /// μ of (7), grey levels².
    pub mu: f64,
    /// λ of (7), grey levels²·px.
    pub lambda: f64,
    /// σ of the residual that μ was chosen from, grey levels; before the first motion step 0, or infinite where regions
    /// have fields of their own.
    pub sigma: f64,
}

impl Weights {
    /// Weights of the coarse-to-fine approach.
    pub(super) fn of_layers(sigma: f64, settled: bool, options: &Options) -> Self {
        let sigma = sigma.max(LEAST_SIGMA_OF_LAYERS);
        let variance = sigma * sigma;
        Self {
            mu: options
                .mu
                .unwrap_or(MU_OF_LAYERS[usize::from(settled)] * variance),
            lambda: options.lambda.unwrap_or(LAMBDA_OF_LAYERS * variance),
            sigma,
        }
    }
}
