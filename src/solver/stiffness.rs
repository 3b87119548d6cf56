//! How stiff a region's depth is: the share of μ that its own depth bears out.
//!
//! Taken as a prior with the precision μ/σ² per bend, smoothness has the greatest evidence (MacKay 1992) at
//!
//! ```text
//! μ = n0 σ² γ / S        S = Σ g(bend),   γ = Σ h/(h + Σc)
//! ```
//!
//! with γ the values of ρ that the data determine (`Edges::determined`) and n0 the pixels that one independent
//! sample of noise spreads over. A landscape that bends everywhere so gets less smoothing than a body, and
//! one of μ's that fits bodies does for both. It is found once, at full μ: weaker smoothing lets depth follow
//! noise, which would speak for weaker smoothing still.

use super::choice::CORRELATED;
use super::evidence::Evidence;
use super::region::{Region, certainty};
use crate::depth::FieldPrior;

/// Stiffness is kept between these.
const RANGE: [f64; 2] = [0.3, 1.0];

/// The share of μ that suits `region`, which has been fitted under `prior` at full μ.
pub(super) fn supported(region: &Region, evidence: &Evidence, prior: &FieldPrior) -> f64 {
    let line = evidence.linearise(region);
    let weight = evidence.weights(&line);
    let bends = region.bends(&line, evidence, &weight);
    let edges = prior.edges(&bends);
    let determined = edges.determined(&certainty(&line, &weight));
    let variance = evidence.sigma * evidence.sigma;
    // The bends' energy is μ S.
    let share = CORRELATED * variance * determined / edges.energy(&bends, &evidence.owned);
    if share.is_finite() {
        share.clamp(RANGE[0], RANGE[1])
    } else {
        RANGE[1]
    }
}
