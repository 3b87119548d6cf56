//! μ and λ chosen from the data, for the user.
//!
//! Both weigh a prior against ψ², whose unit is grey levels². With Gaussian residuals of standard
//! deviation σ the functional is 2σ² times a negative log-likelihood, so that weights proportional to
//! σ² keep the balance when brightness is scaled or noise grows. σ is 1.4826 times the median |ψ|: at
//! first after the first motion step, when every region still holds pixels of others and depth must not
//! explain them away; for μ again whenever all stands still, when residuals are those of depth alone.

use serde::Serialize;

use super::state::State;
use crate::camera::Camera;
use crate::frames::Derivatives;
use crate::options::Options;

/// μ/σ²: what the smoothness of depth counts.
const MU_OVER_VARIANCE: f64 = 20.0;
/// λ/σ²: what a pixel of curve counts.
const LAMBDA_OVER_VARIANCE: f64 = 1.5;
/// Least σ in grey levels: frames of 8 bits are not known better, derivatives included.
const LEAST_SIGMA: f64 = 0.4;

/// The weights in force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Weights {
    /// μ of (7), grey levels².
    pub mu: f64,
    /// λ of (7), grey levels²·px.
    pub lambda: f64,
    /// σ of the residual that μ was chosen from, grey levels; 0 before the first motion step.
    pub sigma: f64,
    /// σ that λ was chosen from.
    #[serde(skip)]
    first_sigma: f64,
}

impl Weights {
    /// Weights for a first residual of standard deviation `sigma`.
    pub(super) fn choose(sigma: f64, options: &Options) -> Self {
        let first = Self {
            first_sigma: sigma,
            ..Self::default()
        };
        first.tightened(sigma, options)
    }

    /// Whether they have been chosen yet.
    pub(super) fn chosen(&self) -> bool {
        self.sigma > 0.0
    }

    /// The same with μ for a residual that has fallen to `sigma`, and whatever `options` set themselves.
    pub(super) fn tightened(self, sigma: f64, options: &Options) -> Self {
        let (now, first) = (sigma * sigma, self.first_sigma * self.first_sigma);
        Self {
            mu: options.mu.unwrap_or(MU_OVER_VARIANCE * now),
            lambda: options.lambda.unwrap_or(LAMBDA_OVER_VARIANCE * first),
            sigma,
            ..self
        }
    }

    /// The same σ under other `options`.
    pub(super) fn with(self, options: &Options) -> Self {
        self.tightened(self.sigma, options)
    }
}

/// σ of the residual as it is, grey levels.
pub(super) fn sigma(state: &State, camera: &Camera, derivatives: &Derivatives) -> f64 {
    let residual = state.residual(camera, derivatives);
    let mut size: Vec<f32> = residual.data().iter().map(|psi| psi.abs()).collect();
    let middle = size.len() / 2;
    let (_, median, _) = size.select_nth_unstable_by(middle, f32::total_cmp);
    (1.4826 * f64::from(*median)).max(LEAST_SIGMA)
}
