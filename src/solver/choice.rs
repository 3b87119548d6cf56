//! Which kind of motion a region has: the simplest of still, rotation, translation and full that explains
//! its pixels nearly as well as the best.
//!
//! Each kind is fitted, and the least of
//!
//! ```text
//! C = ( Σ ρ(r²/v) + smoothness/σ² + 2 p ) / n0 + d ln(n/n0)
//! ```
//!
//! wins: ρ the robust χ², d the kind's parameters (still 0, rotation 3, translation 2, full 5; T's length
//! is not observable), n the region's pixels, [`CORRELATED`] = n0 the pixels that one independent sample
//! of noise spreads over, and p = Σ h/(h + Σc) the parameters' worth of freedom that depth takes (h its
//! data weight, c its smoothing at a pixel), which kinds that translate pay for: with depth to adjust,
//! noise alone can be explained. The second term is Schwarz's (1978), the 2p Akaike's.

use crate::depth::FieldPrior;
use crate::motion::Kind;

use super::evidence::Evidence;
use super::region::Region;

/// n0, in pixels.
const CORRELATED: f64 = 6.0;
/// Joint steps that each kind is fitted with.
const STEPS: usize = 3;

/// The region refitted as the kind of motion that suits it, and nothing else changed.
pub(super) fn chosen(
    region: &Region,
    evidence: &Evidence,
    prior: &FieldPrior,
    block: usize,
) -> Region {
    let mut best: Option<(f64, Region)> = None;
    for kind in [Kind::Still, Kind::Rotation, Kind::Translation, Kind::Full] {
        let mut tried = region.clone();
        tried.become_kind(kind, evidence, prior, block);
        for _ in 0..STEPS {
            tried.fit_jointly(evidence, prior);
            tried.normalise(evidence.owned);
        }
        let cost = criterion(&tried, evidence, prior);
        if best.as_ref().is_none_or(|(least, _)| cost < *least) {
            best = Some((cost, tried));
        }
    }
    best.map_or_else(|| region.clone(), |(_, region)| region)
}

fn criterion(region: &Region, evidence: &Evidence, prior: &FieldPrior) -> f64 {
    let linearisation = evidence.scale.linearise(&region.motion, &region.rho);
    let weight = evidence.weights(&linearisation);
    let variance = evidence.sigma * evidence.sigma;
    let (mut misfit, mut pixels, mut freedom) = (0.0, 0.0, 0.0);
    let departure = region.departure(&linearisation, &weight);
    let edges = prior.edges(&departure);
    for i in 0..weight.len() {
        if evidence.owned.data()[i] <= 0.0 {
            continue;
        }
        pixels += 1.0;
        misfit += evidence.misfit(&linearisation, i);
        if region.kind.translates() {
            let row = &linearisation.rows.data()[i];
            let h = f64::from(weight.data()[i] * row[0] * row[0]);
            freedom += h / (h + edges.around(i, weight.width()) + 1e-12);
        }
    }
    let parameters = match region.kind {
        Kind::Still => 0.0,
        Kind::Rotation => 3.0,
        Kind::Translation => 2.0,
        Kind::Full => 5.0,
    };
    let smoothness = if region.kind.translates() {
        edges.energy(&departure) / variance
    } else {
        0.0
    };
    (misfit + smoothness + 2.0 * freedom) / CORRELATED
        + parameters * (pixels / CORRELATED).max(2.0).ln()
}
