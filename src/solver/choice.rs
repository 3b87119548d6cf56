//! Which kind of motion a region has: the simplest of still, rotation, translation and full that explains
//! its pixels nearly as well as the best.
//!
//! Each kind is fitted, and judged by
//!
//! ```text
//! C = ( Σ ρ(r²/v) + (smoothness + relief)/σ² + 2 p ) / n0 + d ln(n/n0) + b
//! ```
//!
//! ρ the robust χ², nothing where a pixel leaves the frame, d the kind's parameters (still 0, rotation 3,
//! translation 2, full 5; T's length is not observable), n the region's pixels, [`CORRELATED`] = n0 the pixels that one
//! independent sample of noise spreads over, and p = Σ h/(h + Σc) the parameters' worth of freedom that depth takes (h its
//! data weight, c its smoothing at a pixel), which kinds that translate pay for: with depth to adjust, noise alone can
//! be explained. The d ln n is Schwarz's (1978), the 2p Akaike's. b = [`HOLLOW`] for a body whose surface is
//! hollow (`depth/hollow.rs`), else 0: bodies are seen from outside. A simpler kind is taken when its C is
//! within `max( Σ (δ‖∇I‖)²/v, ν n ) / 2 n0` of the least: what image motion off by δ = [`INTERPOLATION`]
//! everywhere costs, or, beside other regions, a variance off by the share ν = [`UNSURE`], since interpolated frames do
//! not tell motions apart that differ by less, nor is a region without shadows and strangers then, however many pixels
//! there are.
//!
//! A narrow view hardly tells a deep relief that turns little from a shallow one that turns much, nor from
//! its mirror image, whose surface bends the other way. Full motion is therefore fitted from several depths of relief,
//! and from the translation that was found, which is one without ω; the best counts.

use crate::depth::{FieldPrior, hollow};
use crate::motion::Kind;

use super::evidence::{Evidence, Role};
use super::region::{Region, certainty};

/// n0, in pixels.
const CORRELATED: f64 = 6.0;
/// δ, in pixels.
const INTERPOLATION: f64 = 0.02;
/// ν, a share of the noise's variance.
const UNSURE: f64 = 0.07;
/// b: in noise a body's mirror image has been seen to explain it better by 20, where folds are smoothed over; with little
/// noise the image costs hundreds.
const HOLLOW: f64 = 30.0;
/// Steps of motion and depth that each kind is fitted with, those that each depth of relief is, whose fit has farther to
/// go, and those with which the best of each kind goes on.
const STEPS: [usize; 3] = [3, 12, 5];

/// A fit and its C.
struct Fit {
    region: Region,
    cost: f64,
}

/// The region refitted as the kind of motion that suits it, and nothing else changed. `reliefs` are
/// what the depth of a full motion's relief is multiplied with to begin with, besides 1.
pub(super) fn chosen(
    region: &Region,
    evidence: &Evidence,
    prior: &FieldPrior,
    reliefs: &[f64],
) -> Region {
    let fitted = |region: Region, steps| fitted(region, evidence, prior, steps);
    let of_kind = |kind: Kind| {
        let mut start = region.clone();
        start.become_kind(kind, evidence, prior);
        start
    };
    let goes_on = |fit: Fit| fitted(fit.region, STEPS[2]);
    let [still, rotation, translation] = [Kind::Still, Kind::Rotation, Kind::Translation]
        .map(|kind| goes_on(fitted(of_kind(kind), STEPS[0])));
    let freed = Region {
        kind: Kind::Full,
        ..translation.region.clone()
    };
    let full = best_full(&of_kind(Kind::Full), evidence, prior, reliefs, Some(freed));
    let mut fits = vec![still, rotation, translation, goes_on(full)];
    let least = fits.iter().map(|f| f.cost).fold(f64::INFINITY, f64::min);
    let enough = least + untold(region, evidence);
    // Rotation and translation are as simple as each other.
    let rank = |fit: &Fit| match fit.region.kind {
        Kind::Still => 0,
        Kind::Rotation | Kind::Translation => 1,
        Kind::Full => 2,
    };
    fits.retain(|fit| fit.cost <= enough);
    let simplest = fits
        .into_iter()
        .min_by(|a, b| rank(a).cmp(&rank(b)).then(a.cost.total_cmp(&b.cost)));
    simplest.map_or_else(|| region.clone(), |fit| fit.region)
}

/// The full motion of the region with the depth of relief that explains it best.
pub(super) fn in_relief(
    region: &Region,
    evidence: &Evidence,
    prior: &FieldPrior,
    reliefs: &[f64],
) -> Region {
    best_full(region, evidence, prior, reliefs, None).region
}

/// The best of the full motions that are fitted from `region`, from it with other `reliefs`, and from what is `freed`.
fn best_full(
    region: &Region,
    evidence: &Evidence,
    prior: &FieldPrior,
    reliefs: &[f64],
    freed: Option<Region>,
) -> Fit {
    let mut best = fitted(region.clone(), evidence, prior, STEPS[0]);
    let in_relief = reliefs.iter().map(|&depth| {
        let mut start = region.clone();
        start.scale_relief(depth, evidence, prior);
        start
    });
    for start in in_relief.chain(freed) {
        let fit = fitted(start, evidence, prior, STEPS[1]);
        if fit.cost < best.cost {
            best = fit;
        }
    }
    best
}

fn fitted(mut region: Region, evidence: &Evidence, prior: &FieldPrior, steps: usize) -> Fit {
    region.fit(evidence, prior, [steps; 2]);
    let cost = criterion(&region, evidence, prior);
    Fit { region, cost }
}

/// What image motion off by δ or, beside other regions, noise off by ν costs, whichever is more.
fn untold(region: &Region, evidence: &Evidence) -> f64 {
    let line = evidence.linearise(region);
    let gradients = line.gradient.data().iter().zip(evidence.owned.data());
    let (mut position, mut pixels) = (0.0, 0.0);
    for (&[ix, iy], &own) in gradients {
        let steep = f64::from(ix * ix + iy * iy);
        position += f64::from(own) * steep / evidence.variance(ix, iy);
        pixels += f64::from(own);
    }
    let unsure = if evidence.role == Role::Whole {
        0.0
    } else {
        UNSURE
    };
    let most = (INTERPOLATION * INTERPOLATION * position).max(unsure * pixels);
    most / (2.0 * CORRELATED)
}

fn criterion(region: &Region, evidence: &Evidence, prior: &FieldPrior) -> f64 {
    let linearisation = evidence.linearise(region);
    let weight = evidence.weights(&linearisation);
    let variance = evidence.sigma * evidence.sigma;
    let (mut misfit, mut pixels) = (0.0, 0.0);
    let bends = region.bends(&linearisation, evidence, &weight);
    let edges = prior.edges(&bends);
    for i in 0..weight.len() {
        if evidence.owned.data()[i] <= 0.0 {
            continue;
        }
        pixels += 1.0;
        misfit += evidence.misfit(&linearisation, i);
    }
    let freedom = if region.kind.translates() {
        edges.determined(&certainty(&linearisation, &weight))
    } else {
        0.0
    };
    let parameters = match region.kind {
        Kind::Still => 0.0,
        Kind::Rotation => 3.0,
        Kind::Translation => 2.0,
        Kind::Full => 5.0,
    };
    let smoothness = if region.kind.translates() {
        (edges.energy(&bends, &evidence.owned) + region.relief_energy(prior, evidence)) / variance
    } else {
        0.0
    };
    let seen_hollow = evidence.role == Role::Body
        && region.kind.translates()
        && hollow(&region.rho, &evidence.owned);
    (misfit + smoothness + 2.0 * freedom) / CORRELATED
        + parameters * (pixels / CORRELATED).max(2.0).ln()
        + if seen_hollow { HOLLOW } else { 0.0 }
}
