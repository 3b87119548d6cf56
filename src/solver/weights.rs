//! μ and λ chosen from the data, for the user.
//!
//! Both weigh a prior against ψ², whose unit is grey levels². With Gaussian residuals of standard
//! deviation σ the functional is 2σ² times a negative log-likelihood, so that weights proportional to
//! σ² keep the balance when brightness is scaled or noise grows. σ is 1.4826 times the median |ψ|: at
//! first after the first motion step, when every region still holds pixels of others and depth must not
//! explain them away; for μ again whenever all stands still, when residuals are those of depth alone.

use serde::Serialize;

use crate::options::Options;

/// μ/σ²: what the smoothness of depth counts.
const MU_OVER_VARIANCE: f64 = 20.0;
/// λ/σ²: what a pixel of curve counts.
const LAMBDA_OVER_VARIANCE: f64 = 1.5;
/// μ/σ² of the coarse-to-fine approach, whose depth is inverse: while regions still hold pixels
/// of others, which depth must not explain away, and once they have settled.
const MU_OF_LAYERS: [f64; 2] = [1.0, 0.1];
/// λ/σ² of the coarse-to-fine approach, whose ξ counts a pixel once and whose outlines cost half where they lie
/// on edges.
const LAMBDA_OF_LAYERS: f64 = 2.5;
/// Least σ in grey levels: frames of 8 bits are not known better, derivatives included.
const LEAST_SIGMA: f64 = 0.4;
/// The same where frames are warped, and derivatives only tell directions.
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
    /// σ that λ was chosen from.
    #[serde(skip)]
    first_sigma: f64,
}

impl Weights {
    /// Weights for a first residual of standard deviation `sigma`.
    pub(super) fn choose(sigma: f64, options: &Options) -> Self {
        let sigma = sigma.max(LEAST_SIGMA);
        let first = Self {
            first_sigma: sigma,
            ..Self::default()
        };
        first.tightened(sigma, options)
    }

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
            first_sigma: sigma,
        }
    }

    /// Whether they have been chosen yet.
    pub(super) fn chosen(&self) -> bool {
        self.sigma > 0.0
    }

    /// The same with μ for a residual that has fallen to `sigma`, and whatever `options` set themselves.
    pub(super) fn tightened(self, sigma: f64, options: &Options) -> Self {
        let sigma = sigma.max(LEAST_SIGMA);
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

/// σ of residuals: 1.4826 times their median size, as for a Gaussian, whatever a minority does.
pub(super) fn spread(mut residuals: Vec<f32>) -> f64 {
    if residuals.is_empty() {
        return 0.0;
    }
    let middle = residuals.len() / 2;
    let (_, median, _) =
        residuals.select_nth_unstable_by(middle, |a, b| a.abs().total_cmp(&b.abs()));
    1.4826 * f64::from(median.abs())
}
