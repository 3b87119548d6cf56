//! μ and λ chosen from the data, for the user.
//!
//! Both weigh a prior against ψ², whose unit is grey levels². With Gaussian residuals of standard
//! deviation σ the functional is 2σ² times a negative log-likelihood, so that weights proportional to
//! σ² keep the balance when brightness is scaled or noise grows. σ is 1.4826 times the median |ψ|: at
//! first after the first motion step, when every region still holds pixels of others and depth must not
//! explain them away; for μ again whenever all stands still, when residuals are those of depth alone.

use crate::options::Options;
use crate::solver::Weights;
use crate::spread::LEAST_SIGMA;

/// μ/σ²: what the smoothness of depth counts.
const MU_OVER_VARIANCE: f64 = 20.0;
/// λ/σ²: what a pixel of curve counts.
const LAMBDA_OVER_VARIANCE: f64 = 1.5;
/// σ must fall at least to this share before μ is chosen again.
const TIGHTER: f64 = 0.8;

/// What weights are chosen from: σ of the residual, in grey levels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Noise {
    /// After the first motion step.
    pub first: f64,
    /// When all stood still last.
    pub now: f64,
}

impl Noise {
    /// After the first motion step, with residuals of standard deviation `sigma`.
    pub fn new(sigma: f64) -> Self {
        let sigma = sigma.max(LEAST_SIGMA);
        Self {
            first: sigma,
            now: sigma,
        }
    }

    /// All stands still, with residuals of standard deviation `sigma`; whether that is enough less to count.
    pub fn tighten(&mut self, sigma: f64) -> bool {
        let sigma = sigma.max(LEAST_SIGMA);
        let tighter = sigma < TIGHTER * self.now;
        if tighter {
            self.now = sigma;
        }
        tighter
    }

    /// The weights, but for those that `options` set themselves.
    pub fn weights(&self, options: &Options) -> Weights {
        Weights {
            mu: options.mu.unwrap_or(MU_OVER_VARIANCE * self.now.powi(2)),
            lambda: options
                .lambda
                .unwrap_or(LAMBDA_OVER_VARIANCE * self.first.powi(2)),
            sigma: self.now,
        }
    }
}
