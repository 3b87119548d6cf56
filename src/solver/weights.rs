//! μ and λ chosen from the data, for the user.
//!
//! Both weigh a prior against ψ², whose unit is grey levels². With Gaussian residuals of standard
//! deviation σ the functional is 2σ² times a negative log-likelihood, so that weights proportional to
//! σ² keep the balance when brightness is scaled or noise grows. σ is 1.4826 times the median |ψ| after
//! the first motion step, when every region has its own best motion at constant depth.

use serde::Serialize;

use super::state::State;
use crate::camera::Camera;
use crate::frames::Derivatives;
use crate::options::Options;

/// μ/σ²: what the smoothness of depth counts.
const MU_OVER_VARIANCE: f64 = 50.0;
/// λ/σ²: what a pixel of curve counts.
const LAMBDA_OVER_VARIANCE: f64 = 1.0;
/// Least σ in grey levels: frames of 8 bits are not known better.
const LEAST_SIGMA: f64 = 0.1;

/// The weights in force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Weights {
    /// μ of (7), grey levels².
    pub mu: f64,
    /// λ of (7), grey levels²·px.
    pub lambda: f64,
    /// σ of the residual that both were chosen from, grey levels; 0 before the first motion step.
    pub sigma: f64,
    #[serde(skip)]
    pub(super) chosen: bool,
}

impl Weights {
    pub(super) fn choose(
        state: &State,
        camera: &Camera,
        derivatives: &Derivatives,
        options: &Options,
    ) -> Self {
        let mut size: Vec<f32> = state
            .residual(camera, derivatives)
            .data()
            .iter()
            .map(|psi| psi.abs())
            .collect();
        let middle = size.len() / 2;
        let (_, median, _) = size.select_nth_unstable_by(middle, f32::total_cmp);
        let sigma = (1.4826 * f64::from(*median)).max(LEAST_SIGMA);
        Self {
            mu: 0.0,
            lambda: 0.0,
            sigma,
            chosen: true,
        }
        .with(options)
    }

    /// The same σ with the weights that `options` set or leave to it.
    pub(super) fn with(mut self, options: &Options) -> Self {
        let variance = self.sigma * self.sigma;
        self.mu = options.mu.unwrap_or(MU_OVER_VARIANCE * variance);
        self.lambda = options.lambda.unwrap_or(LAMBDA_OVER_VARIANCE * variance);
        self
    }
}
