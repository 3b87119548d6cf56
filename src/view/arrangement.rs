//! How near each region is drawn, and which of it is known.
//!
//! Two frames do not tell how deep one region lies against another; that it hides the background they do. A region is
//! brought forward, by the least factor g ≥ 1 on its 1/Z, until [`BEFORE`] of its outline lies before the background
//! beside it; what a user says of depths ([`ViewParams::scales`](super::ViewParams::scales)) comes on top. A region whose
//! depth is nowhere observable is flat, and if it is the background, as far as the farthest that is known. 1/Z is held
//! within the region's own span and a little beyond, so that a few wild ones do not stretch the scene.

use super::ViewParams;
use super::span::{OBSERVABLE, Span, percentile};
use super::steady::steadied;
use crate::grid::Grid;
use crate::interpretation::Interpretation;

/// Share of a region's pixels that must have observable depth for it to have a relief.
const LEAST_KNOWN: f32 = 0.02;
/// Share of an outline that lies before the background; the rest may be wrong.
const BEFORE: f32 = 0.85;
/// The furthest that a region is brought forward.
const MOST: f32 = 4.0;
/// How far beyond its span a region reaches, as a share of it.
const BEYOND: f32 = 0.3;

/// 1/Z as drawn at each pixel, and whether it is known.
pub(super) fn arranged(found: &Interpretation, params: &ViewParams) -> (Grid<f32>, Grid<bool>) {
    let labels = found.labels.data();
    let count = usize::from(labels.iter().copied().max().unwrap_or(0)) + 1;
    let mut regions: Vec<Shown> = (0..=u8::MAX)
        .take(count)
        .map(|k| Shown::of(found, k))
        .collect();
    let known = regions.iter().filter(|r| r.known).map(|r| r.span.far);
    let farthest = known.fold(f32::INFINITY, f32::min);
    if !regions[0].known && farthest.is_finite() {
        regions[0].span = Span {
            far: farthest,
            near: farthest,
        };
    }
    let mut rho = found.depth.clone();
    for (value, &label) in rho.data_mut().iter_mut().zip(labels) {
        *value = regions[usize::from(label)].rho(*value);
    }
    let known: Vec<bool> = regions.iter().map(|r| r.known).collect();
    let told = steadied(&mut rho, found, &known);
    let forward = forward(&rho, found, &regions);
    let scale = |k: usize| params.scales.get(k).map_or(1.0, |&s| s as f32);
    for (value, &label) in rho.data_mut().iter_mut().zip(labels) {
        let k = usize::from(label);
        *value *= forward[k] / scale(k);
    }
    (rho, told)
}

/// How a region is drawn.
struct Shown {
    known: bool,
    span: Span,
}

impl Shown {
    fn of(found: &Interpretation, label: u8) -> Self {
        let inside = |i: usize| found.labels.data()[i] == label;
        let pixels = (0..found.labels.len()).filter(|&i| inside(i)).count();
        let known = (0..found.labels.len())
            .filter(|&i| inside(i) && found.confidence.data()[i] >= OBSERVABLE)
            .count();
        let span = Span::of(found, true, inside).unwrap_or(Span {
            far: 1.0,
            near: 1.0,
        });
        Self {
            known: known as f32 >= LEAST_KNOWN * pixels as f32 && known > 0,
            span,
        }
    }

    /// 1/Z within the span and a little beyond; the middle of it where nothing is known.
    fn rho(&self, depth: f32) -> f32 {
        let Span { far, near } = self.span;
        let rho = 1.0 / depth;
        if !self.known || !rho.is_finite() {
            return (near + far) / 2.0;
        }
        let beyond = BEYOND * (near - far);
        rho.clamp((far - beyond).max(0.2 * far), near + beyond)
    }
}

/// The factor on each region's 1/Z that brings it before the background.
fn forward(rho: &Grid<f32>, found: &Interpretation, regions: &[Shown]) -> Vec<f32> {
    let labels = &found.labels;
    let mut ratios = vec![Vec::new(); regions.len()];
    let mut beside = |p: (usize, usize), q: (usize, usize)| {
        for (p, q) in [(p, q), (q, p)] {
            if labels[p] > 0 && labels[q] == 0 {
                ratios[usize::from(labels[p])].push(rho[q] / rho[p]);
            }
        }
    };
    for y in 0..rho.height() {
        for x in 0..rho.width() {
            if x + 1 < rho.width() {
                beside((x, y), (x + 1, y));
            }
            if y + 1 < rho.height() {
                beside((x, y), (x, y + 1));
            }
        }
    }
    let factor = |mut ratios: Vec<f32>| percentile(&mut ratios, BEFORE).unwrap_or(1.0);
    let factors = ratios.into_iter().map(|r| factor(r).clamp(1.0, MOST));
    factors
        .map(|g| if regions[0].known { g } else { 1.0 })
        .collect()
}
