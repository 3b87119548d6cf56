//! Growth: what a region would own, had it been fitted there.
//!
//! A region knows its depth from the pixels that it owns. What it lacks of its body it judges by depth carried on
//! from there, while whoever holds it has bent a depth of his own after it: curves creep or stand still, though with
//! the part where it belongs (7) would be far less. So the depth of each curve's region is fitted, on trial, as if
//! all pixels within [`REACH`] of its curve were its own; robust weights leave out what is not. The trial stands if
//!
//! ```text
//! min (7) with the region as tried  <  min (7) with the region as it was − c σ²        c = CLEARLY
//! ```
//!
//! each over all outlines within that reach (`relaxation.rs`), the smoothness of depth, hundreds of times less,
//! left out; the region then takes what it gains. Fitted anew to a shadow, or to nothing in particular, it gains a
//! little as well, hence c. What its owner says is hidden in the second frame suits anyone by chance: no region
//! is fitted to it or gains it.

use super::Layers;
use super::steps::DEPTH_STEPS;
use crate::curves;
use crate::grid::Grid;
use crate::options::Options;
use crate::solver::region::{Region, certainty};
use crate::solver::rivalry;
use crate::warp::Linearisation;
use crate::window::Window;

/// Pixels beyond its curve that a region is tried with.
const REACH: f32 = 8.0;
/// c: up to fifty variances are gained where nothing is missing, hundreds where a piece of the body is.
const CLEARLY: f64 = 100.0;

/// A partition of a window into a region and the others, and what it costs.
struct Partition {
    /// Whether a pixel is the region's.
    inside: Grid<bool>,
    /// Data and outlines of (7), grey levels².
    energy: f64,
}

impl Layers {
    /// Tries every region that has depth with what lies around it.
    pub(super) fn grow(&mut self, options: &Options) {
        for k in 1..self.regions.len() {
            let owns = self.labels.data().contains(&(k as u8));
            if owns && self.regions[k].kind.translates() {
                self.try_growth(k, options);
            }
        }
    }

    fn try_growth(&mut self, k: usize, options: &Options) {
        let window = self.window(k);
        let mut lines = self.linearisations();
        let hidden = self.cover.as_ref().map_or_else(
            || self.labels.map(|_| false),
            |cover| rivalry::hidden(&lines, &self.labels, cover),
        );
        let grown = self.grown(k, &hidden, options);
        let before = self.least(k, &lines, &window, options);
        lines[k] = grown.cropped(&window).linearise(self.here(), window);
        let after = self.least(k, &lines, &window, options);
        if after.energy >= before.energy - CLEARLY * self.weights.sigma.powi(2) {
            return;
        }
        for (i, &inside) in after.inside.data().iter().enumerate() {
            let at = window.place(i);
            if inside && usize::from(self.labels[at]) != k && !hidden[at] {
                for (j, phi) in self.phi.iter_mut().enumerate() {
                    phi[at] = if j + 1 == k { 0.5 } else { phi[at].min(-0.5) };
                }
            }
        }
        self.phi.iter_mut().for_each(curves::redistance);
        self.regions[k] = grown;
        self.relabel();
    }

    /// Region k fitted to the pixels around its curve as well.
    fn grown(&self, k: usize, hidden: &Grid<bool>, options: &Options) -> Region {
        let window = self.window(k);
        let owned = Grid::from_fn(window.width, window.height, |x, y| {
            let at = (window.left + x, window.top + y);
            let own = usize::from(self.labels[at]) == k;
            f32::from(own || self.distance(k, at) < REACH && !hidden[at])
        });
        let evidence = self.evidence_of(k, window, owned, options);
        let prior = self.prior(k, &evidence, options);
        let mut part = self.regions[k].cropped(&window);
        for _ in 0..DEPTH_STEPS {
            part.fit_depth(&evidence, &prior);
            part.normalise(&evidence.owned);
        }
        let line = evidence.linearise(&part);
        let mut region = self.regions[k].clone();
        region.take(&part, &window, &certainty(&line, &evidence.weights(&line)));
        region
    }

    /// The least partition of `window` into region k and whoever else owns its pixels, within [`REACH`] of k's curve.
    fn least(
        &self,
        k: usize,
        lines: &[Linearisation],
        window: &Window,
        options: &Options,
    ) -> Partition {
        let xi = self.competition(self.residuals(lines, options), lines, options);
        let xi: Vec<_> = xi.iter().map(|xi| window.crop(xi)).collect();
        let labels = window.crop(&self.labels);
        let others = Grid::from_fn(window.width, window.height, |x, y| {
            let owner = usize::from(labels[(x, y)]);
            if owner != k {
                return xi[owner][(x, y)];
            }
            let others = xi.iter().enumerate().filter(|(j, _)| *j != k);
            others.fold(f32::INFINITY, |least, (_, xi)| least.min(xi[(x, y)]))
        });
        let outline = window.crop(&self.outline(options));
        let now = [window.crop(&self.phi[k - 1])];
        let xi = [others, xi[k].clone()];
        let phi = curves::least_partition(&now, &xi, &outline, REACH);
        let labels = curves::labels(&phi, window.width, window.height);
        let owners = labels.data().iter().enumerate();
        let data = owners.map(|(i, &own)| f64::from(xi[usize::from(own)].data()[i]));
        Partition {
            energy: data.sum::<f64>() + curves::cost(&phi[0], &outline),
            inside: labels.map(|own| own == 1),
        }
    }
}
