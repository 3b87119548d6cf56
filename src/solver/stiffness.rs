//! How stiff a region's depth is: the share of μ under which it best foretells pixels that it has not seen.
//!
//! A landscape bends everywhere, a wall nowhere, and what is faint needs more around it to be averaged with
//! than what is clear. So depth is fitted under several shares of μ with a quarter of the region's pixels
//! withheld, in blocks of [`SIDE`] pixels, the motion being held; every block is withheld once, and
//!
//! ```text
//! CV(share) = Σ ω ρ(r²/v)  over the inner pixels of all blocks, each foretold from its neighbours
//! ```
//!
//! with ρ the robust χ² (cross-validation, Stone 1974). ω are the weights of the fit at full μ: a shadow, which it
//! does not follow, shall not speak for depth that does. Noise reaches over a pixel where frames are
//! smoothed and interpolated, so that a rim of [`RIM`] pixels is not judged. Of shares whose CV differs from
//! the least by no more than one standard error, blocks counting as independent, the stiffest is taken
//! (Breiman et al. 1984).

use super::evidence::Evidence;
use super::region::Region;
use crate::depth::FieldPrior;
use crate::grid::Grid;

/// Shares of μ that are tried, the stiffest first.
const SHARES: [f64; 5] = [1.0, 0.5, 0.25, 0.125, 0.0625];
/// Side of a block, in pixels: what lies deep in a large one is foretold by averages of what surrounds it, and the softest
/// depth, which follows noise where it sees it, would look best.
const SIDE: usize = 4;
/// Pixels inside a block's border that are not judged.
const RIM: usize = 1;
/// Steps of depth from one share to the next: the slope that is expected is a step behind.
const STEPS: usize = 3;

/// The share of μ that suits `region`, which has been fitted under `prior`, all of it; 1 for one that does not
/// translate.
pub(super) fn foretelling(region: &Region, evidence: &Evidence, prior: &FieldPrior) -> f64 {
    if !region.kind.translates() {
        return SHARES[0];
    }
    let trials = trials(region, evidence, prior);
    let total = |trial: &Vec<f64>| trial.iter().sum::<f64>();
    let least = trials.iter().min_by(|a, b| total(a).total_cmp(&total(b)));
    let suits = |trial: &Vec<f64>| {
        let (mut sum, mut square) = (0.0, 0.0);
        for (a, b) in trial.iter().zip(least.into_iter().flatten()) {
            sum += a - b;
            square += (a - b) * (a - b);
        }
        sum <= square.sqrt()
    };
    let stiffest = SHARES.iter().zip(&trials).find(|(_, trial)| suits(trial));
    stiffest.map_or(SHARES[0], |(share, _)| *share)
}

/// ω of the pixels that are judged, 0 for all others.
fn judged(region: &Region, evidence: &Evidence) -> Grid<f32> {
    let weight = evidence.fitting_weights(&evidence.linearise(region));
    let inner = |v: usize| (RIM..SIDE - RIM).contains(&(v % SIDE));
    Grid::from_fn(weight.width(), weight.height(), |x, y| {
        if inner(x) && inner(y) && evidence.owned[(x, y)] >= 1.0 {
            weight[(x, y)]
        } else {
            0.0
        }
    })
}

/// For each of [`SHARES`] what each block adds to CV.
fn trials(region: &Region, evidence: &Evidence, prior: &FieldPrior) -> Vec<Vec<f64>> {
    let judged = judged(region, evidence);
    let (width, height) = (judged.width(), judged.height());
    let across = width.div_ceil(SIDE);
    let mut trials = vec![vec![0.0; across * height.div_ceil(SIDE)]; SHARES.len()];
    for fold in 0..4 {
        let withheld = |x: usize, y: usize| (x / SIDE) % 2 + 2 * ((y / SIDE) % 2) == fold;
        let known = evidence.without(withheld);
        let mut part = region.clone();
        for (share, blocks) in SHARES.iter().zip(&mut trials) {
            let prior = prior.softened(*share);
            for _ in 0..STEPS {
                part.fit_depth(&known, &prior);
            }
            let line = evidence.linearise(&part);
            for (i, &weight) in judged.data().iter().enumerate() {
                let (x, y) = (i % width, i / width);
                if weight > 0.0 && line.inside.data()[i] && withheld(x, y) {
                    let misfit = f64::from(weight) * evidence.misfit(&line, i);
                    blocks[y / SIDE * across + x / SIDE] += misfit;
                }
            }
        }
    }
    trials
}
