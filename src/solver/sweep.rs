//! A sweep of depths: what explains pixels whose depth the frames refute.
//!
//! Steps of depth begin at the depth of what lies around. Where one thing stands before another, that may be off by more
//! than half a period of the texture, and they end in a false minimum. There all depths are tried (Collins 1996):
//!
//! ```text
//! ρ(x) ← ρj(x),  j = argmin mj(x),   where m(x) > E ≥ mj(x)         m = Σ G χ² / Σ G
//! ρj = ρ̄j − Σ G a r/v / Σ G a²/v     ρ̄j = 1/Z of planes at equal steps of image motion
//! ```
//!
//! χ² is the robust misfit of a pixel in units of its variance v, that of a hidden one where it leaves the frame, r its
//! residual, a = ∂r/∂ρ, and G a Gaussian over the region's own pixels. One sweep; what it finds is where steps of depth
//! go on from.

use super::evidence::Evidence;
use super::region::{RHO_RANGE, Region};
use crate::frames::blur;
use crate::grid::Grid;
use crate::occlusion::HIDDEN;
use crate::warp::{Linearisation, RESIDUAL};

/// Standard deviation of G, in pixels.
const WINDOW: f64 = 2.0;
/// E: noise alone is 1.
const EXPLAINED: f32 = 2.0;
/// Image motion between planes, in pixels: half of it is as far as a linearisation holds in fine texture. More where
/// [`MOST`] planes would not reach the nearest.
const SPACING: f32 = 0.7;
/// Planes at most, and the ρ of the nearest: five times as near as the region is in the mean.
const MOST: (usize, f32) = (64, 5.0);
/// Residuals count up to so many standard deviations where ρj is found.
const CLAMP: f32 = 6.0;
/// Added to sums of weights, so that nothing is divided by nothing.
const LITTLE: f32 = 1e-3;

/// `region`'s ρ, replaced where its pixels refute it and another ρ explains them.
pub(super) fn swept(region: &Region, evidence: &Evidence) -> Grid<f32> {
    let mut rho = region.rho.clone();
    let around = Around::of(evidence);
    let mut least = around.misfit(&evidence.linearise(region));
    let refuted = least.map(|m| m > EXPLAINED);
    if !refuted.data().contains(&true) {
        return rho;
    }
    let Some(step) = spacing(region, evidence) else {
        return rho;
    };
    let planes = (0..MOST.0).map(|j| RHO_RANGE[0] + j as f32 * step);
    for plane in planes.take_while(|rho| *rho <= MOST.1 + 0.5 * step) {
        let fitted = around.fitted(region, plane, step);
        let misfit = around.misfit(&evidence.linearise(&fitted));
        for (i, &m) in misfit.data().iter().enumerate() {
            if refuted.data()[i] && m <= EXPLAINED && m < least.data()[i] {
                least.data_mut()[i] = m;
                rho.data_mut()[i] = fitted.rho.data()[i];
            }
        }
    }
    rho
}

/// The difference in ρ from plane to plane, which moves the image by [`SPACING`]; `None` where depths up to the mean
/// move it by less, as those of a background that stands still: nothing is a period of texture away there.
fn spacing(region: &Region, evidence: &Evidence) -> Option<f32> {
    let [far, near] = [RHO_RANGE[0], 1.0].map(|rho| evidence.linearise(&level(region, rho)));
    let inside = (0..far.flow.len()).filter(|&i| far.inside.data()[i] && near.inside.data()[i]);
    let moves = inside.map(|i| {
        let (far, near) = (far.flow.data()[i], near.flow.data()[i]);
        (near[0] - far[0]).hypot(near[1] - far[1])
    });
    let most = moves.fold(0.0, f32::max);
    let widest = (MOST.1 - RHO_RANGE[0]) / (MOST.0 - 1) as f32;
    (most > SPACING).then(|| widest.max(SPACING * (1.0 - RHO_RANGE[0]) / most))
}

/// The region as a frontal plane.
fn level(region: &Region, rho: f32) -> Region {
    Region {
        rho: region.rho.map(|_| rho),
        ..region.clone()
    }
}

/// Sums over G.
struct Around<'a> {
    evidence: &'a Evidence<'a>,
    /// Σ G.
    count: Grid<f32>,
}

impl<'a> Around<'a> {
    fn of(evidence: &'a Evidence<'a>) -> Self {
        Self {
            evidence,
            count: blur(&evidence.owned, WINDOW),
        }
    }

    /// Σ G of a pixel's value.
    fn sum(&self, value: impl Fn(usize) -> f32) -> Grid<f32> {
        let mut values = self.evidence.owned.clone();
        for (i, v) in values.data_mut().iter_mut().enumerate() {
            if *v > 0.0 {
                *v *= value(i);
            }
        }
        blur(&values, WINDOW)
    }

    /// m; 0 far from the region.
    fn misfit(&self, line: &Linearisation) -> Grid<f32> {
        let mut mean = self.sum(|i| {
            if line.inside.data()[i] {
                self.evidence.misfit(line, i) as f32
            } else {
                HIDDEN
            }
        });
        for (m, count) in mean.data_mut().iter_mut().zip(self.count.data()) {
            *m /= count + LITTLE;
        }
        mean
    }

    /// `region` at ρj, no more than `step` from the plane `rho`.
    fn fitted(&self, region: &Region, rho: f32, step: f32) -> Region {
        let mut fitted = level(region, rho);
        let line = self.evidence.linearise(&fitted);
        let variance = |i: usize| {
            let [ix, iy] = line.gradient.data()[i];
            self.evidence.variance(ix, iy) as f32
        };
        // Both are 0 where the point leaves the frame.
        let force = self.sum(|i| {
            let (row, variance) = (&line.rows.data()[i], variance(i));
            let most = CLAMP * variance.sqrt();
            row[0] * row[RESIDUAL].clamp(-most, most) / variance
        });
        let data = self.sum(|i| line.rows.data()[i][0].powi(2) / variance(i));
        for (i, rho) in fitted.rho.data_mut().iter_mut().enumerate() {
            let change = -force.data()[i] / (data.data()[i] + LITTLE);
            *rho = (*rho + change.clamp(-step, step)).clamp(RHO_RANGE[0], RHO_RANGE[1]);
        }
        fitted
    }
}
