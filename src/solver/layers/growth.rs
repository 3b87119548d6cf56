//! Growth: what a region would own, had it been fitted there.
//!
//! A region knows its depth from the pixels that it owns. What it lacks of its body it judges by depth carried on
//! from there, while whoever holds it has bent a depth of his own after it: curves creep or stand still, though with
//! the part where it belongs (7) would be far less. So the depth of each curve's region is fitted, on trial, as if
//! all pixels within [`REACH`] of its curve were its own; robust weights leave out what is not. What is missing often
//! lies beyond a fold, a lid or a side face, which stiff depth would carry on level: the trial is softer. It stands if
//!
//! ```text
//! min (7), the region fitted to what lies around too  <  min (7), fitted to its own, as softly − c σ²    c = CLEARLY
//! ```
//!
//! each over all outlines within that reach (`relaxation.rs`), the smoothness of depth, hundreds of times less,
//! left out; the region then takes what it gains. Fitted anew to nothing in particular it gains a little as well,
//! hence c. A body's shadow moves with it, and would be gained for fitting it better than ground that has become
//! darker: in both minima the background's brightness may have changed by a factor of its own around each pixel, over
//! [`SHADOW`] pixels, since a shadow carries no texture along. What its owner says is hidden in the second frame suits
//! anyone by chance: no region is fitted to it or gains it.

use super::Layers;
use crate::curves;
use crate::frames::blur;
use crate::grid::Grid;
use crate::options::Options;
use crate::solver::region::{Region, certainty};
use crate::solver::rivalry;
use crate::warp::{Linearisation, RESIDUAL};
use crate::window::Window;

/// Pixels beyond its curve that a region is tried with.
const REACH: f32 = 8.0;
/// Share of μ that it is tried with.
const SOFT: f64 = 0.1;
/// Steps of depth of a trial: a surface that is carried on level has a way to go to a lid's.
const STEPS: usize = 8;
/// Standard deviation of the window over which the background may become darker or brighter, in pixels.
const SHADOW: f64 = 1.5;
/// c: where nothing is missing some sixty variances are gained in the median, seldom two hundred; where a piece of the
/// body is, nearly three hundred. What was gained in vain is lost again in the passes that follow.
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
        self.excuse_shadows(&mut lines[0]);
        let mut least = |region: &Region| {
            lines[k] = region.cropped(&window).linearise(self.here(), window);
            self.least(k, &lines, &window, options)
        };
        let own = |at| usize::from(self.labels[at]) == k;
        let around = |at| own(at) || self.distance(k, at) < REACH && !hidden[at];
        let before = least(&self.softly(k, own, options));
        let grown = self.softly(k, around, options);
        let after = least(&grown);
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

    /// Takes from the residuals r of the background, at `line`, what a change of brightness there explains, I Σ I r / Σ I²
    /// over its own pixels around; nothing where these are darker than noise.
    fn excuse_shadows(&self, line: &mut Linearisation) {
        let first = &self.here().first;
        let noise = self.weights.sigma.powi(2) as f32;
        let around = |value: &dyn Fn((usize, usize)) -> f32| {
            let own = Grid::from_fn(first.width(), first.height(), |x, y| {
                if self.labels[(x, y)] == 0 {
                    value((x, y))
                } else {
                    0.0
                }
            });
            blur(&own, SHADOW)
        };
        let square = around(&|at| first[at] * first[at]);
        let product = around(&|at| first[at] * line.rows[at][RESIDUAL]);
        for (i, row) in line.rows.data_mut().iter_mut().enumerate() {
            let change = product.data()[i] / (square.data()[i] + noise);
            row[RESIDUAL] -= change * first.data()[i];
        }
    }

    /// Region k fitted, softly, to the pixels for which `owns` says so.
    fn softly(&self, k: usize, owns: impl Fn((usize, usize)) -> bool, options: &Options) -> Region {
        let window = self.window(k);
        let owned = Grid::from_fn(window.width, window.height, |x, y| {
            f32::from(owns((window.left + x, window.top + y)))
        });
        let mut evidence = self.evidence_of(k, window, owned, options);
        // A rim that is spared in the one fit and is inside in the other would be gained by every trial.
        evidence.withheld = None;
        let mut prior = self.prior(k, &evidence, options);
        prior.strength *= SOFT;
        let mut part = self.regions[k].cropped(&window);
        for _ in 0..STEPS {
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
