//! What a region is fitted to: its pixels at one scale, and how much each of them counts.
//!
//! A residual r has the variance v = σk² + (δ‖∇I‖)², σk that of the region's own residuals, large as long as its
//! motion is wrong, and δ the error of position that a fit is granted. It counts with the weight
//! σ²/v · (1 + r²/(c² v))⁻², Geman and McClure's: what does not fit at all does not count at all. Pixels that
//! their owner does not explain are offered to the regions around, at half weight.
//!
//! A shadow that passes over the background changes many pixels by less than noise changes one. There the mean
//! residual over some pixels around counts as well, in the same way and in units of its own spread.

use crate::depth::Polynomials;
use crate::frames::blur;
use crate::grid::Grid;
use crate::paper::spread;
use crate::warp::{Linearisation, RESIDUAL, Scale};
use crate::window::Window;

use super::region::Region;

/// Error of position granted when motion and depth are fitted, in pixels.
const POSITION_ERROR: f32 = 0.06;
/// c: residuals of this many standard deviations count a quarter as much as in least squares.
const ROBUST: f32 = 3.0;
/// Standard deviation of the window over which residuals are averaged to find shadows, in pixels.
const SHADOW: f64 = 4.0;
/// The same as c for that mean: depth that is not found yet leaves means of a few standard deviations.
const SHADOWED: f32 = 6.0;
/// Standard deviation of f·ω known beforehand, in pixels at the finest scale's width of 320: a body that turns in
/// place has a large ω, and a T that brings it back.
const ROTATION_SPREAD: f64 = 32.0;
/// Smoothness of a change of brightness, in pixels, and the weight below which it is not known.
const SHADE: f64 = 6.0;
const UNSHADED: f32 = 0.05;
/// Relief expected, as a share of a region's extent over the focal length, and what it counts, in variances.
const RELIEF: (f64, f64) = (1.5, 10.0);
/// Longest step of f T and of f ω, in pixels.
const LONGEST_STEP: f64 = 8.0;

/// What a region is among the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// All there is.
    Whole,
    /// What curves leave over: many things, each of which may stand before another.
    Background,
    /// What a curve encloses: one thing, seen from outside.
    Body,
}

/// What a region is fitted to.
#[derive(Clone)]
pub(super) struct Evidence<'a> {
    pub scale: &'a Scale,
    /// Where the region's field is computed; grids have its size.
    pub window: Window,
    /// 1 where the region owns the pixel, less where it is offered to it, else 0.
    pub owned: Grid<f32>,
    /// Standard deviation of the residual, grey levels.
    pub sigma: f64,
    /// The same of the region's own residual as it is, not less: large as long as its motion is wrong.
    pub spread: f64,
    pub robust: bool,
    /// Whether shadows of other regions may pass over the region.
    pub shadowed: bool,
    /// Pixels that motion and depth are not fitted to, though the region owns them.
    pub withheld: Option<Grid<bool>>,
    /// The surfaces that a joint step takes at once.
    pub surface: Option<Polynomials>,
    /// Whether smoothness acts only on what departs from them, rather than on how depth bends about its own slope.
    pub departing: bool,
    /// Whether depth may leap and reach far, as a background's, so that T keeps how much of ρ shows (`motion/joint.rs`) and
    /// is found with depth all but free.
    pub leaps: bool,
    /// What the region is among the others.
    pub role: Role,
}

impl Evidence<'_> {
    /// The constraint around what `region` is at present.
    pub fn linearise(&self, region: &Region) -> Linearisation {
        region.linearise(self.scale, self.window)
    }

    /// The surfaces that are free of charge; none where depth is smooth about its own slope.
    pub fn uncharged(&self) -> Option<&Polynomials> {
        self.surface.as_ref().filter(|_| self.departing)
    }

    /// The same without the pixels (x, y) of the window for which `withheld` says so, either.
    pub fn without(&self, withheld: impl Fn(usize, usize) -> bool) -> Self {
        let (width, height) = (self.owned.width(), self.owned.height());
        let already = |at| self.withheld.as_ref().is_some_and(|grid| grid[at]);
        Self {
            withheld: Some(Grid::from_fn(width, height, |x, y| {
                already((x, y)) || withheld(x, y)
            })),
            ..self.clone()
        }
    }

    /// How much brighter the region's pixels become, from their residuals: smooth over [`SHADE`] pixels.
    pub fn shade(&self, region: &Region) -> Grid<f32> {
        let line = self.linearise(region);
        let weight = self.weights(&line);
        let mut sum = weight.clone();
        for (i, s) in sum.data_mut().iter_mut().enumerate() {
            *s *= line.rows.data()[i][RESIDUAL] + region.shade.data()[i];
        }
        let (mut shade, weight) = (blur(&sum, SHADE), blur(&weight, SHADE));
        for (s, w) in shade.data_mut().iter_mut().zip(weight.data()) {
            *s /= w + UNSHADED;
        }
        shade
    }

    /// ω_i, in units in which the residual's variance is σ².
    pub fn weights(&self, linearisation: &Linearisation) -> Grid<f32> {
        let variance = (self.sigma * self.sigma) as f32;
        let spread = (self.spread * self.spread) as f32;
        let mut weight = self.owned.clone();
        for (i, w) in weight.data_mut().iter_mut().enumerate() {
            if !linearisation.inside.data()[i] {
                *w = 0.0;
            } else if *w > 0.0 {
                let [ix, iy] = linearisation.gradient.data()[i];
                let position = POSITION_ERROR * POSITION_ERROR * (ix * ix + iy * iy);
                let own = spread + position;
                *w *= variance / own;
                if self.robust {
                    let r = linearisation.rows.data()[i][RESIDUAL];
                    *w /= (1.0 + r * r / (ROBUST * ROBUST * own)).powi(2);
                }
            }
        }
        weight
    }

    /// The weights that motion and depth are fitted with: ω, less where residuals are off together, and 0 where
    /// pixels are withheld.
    pub fn fitting_weights(&self, linearisation: &Linearisation) -> Grid<f32> {
        let mut weight = self.weights(linearisation);
        if let Some(withheld) = &self.withheld {
            let each = weight.data_mut().iter_mut().zip(withheld.data());
            each.filter(|(_, out)| **out).for_each(|(w, _)| *w = 0.0);
        }
        if !(self.robust && self.shadowed) {
            return weight;
        }
        let most = ROBUST * self.spread as f32;
        let mut count = self.owned.clone();
        let mut mean = self.owned.clone();
        for (i, (mean, count)) in mean.data_mut().iter_mut().zip(count.data_mut()).enumerate() {
            let seen = f32::from(linearisation.inside.data()[i]);
            *count *= seen;
            *mean *= seen * linearisation.rows.data()[i][RESIDUAL].clamp(-most, most);
        }
        let (mut mean, count) = (blur(&mean, SHADOW), blur(&count, SHADOW));
        for (mean, count) in mean.data_mut().iter_mut().zip(count.data()) {
            // The sum over so many pixels has their number for variance.
            *mean /= (count + 1e-3).sqrt();
        }
        let fitted = weight.data().iter().zip(mean.data());
        let usual = spread(fitted.filter(|(w, _)| **w > 0.0).map(|(_, m)| *m).collect());
        let usual = (SHADOWED * usual as f32).max(1e-3);
        for (w, mean) in weight.data_mut().iter_mut().zip(mean.data()) {
            *w /= (1.0 + (mean / usual).powi(2)).powi(2);
        }
        weight
    }

    /// Variance of the residual of a region that is fitted well, where ∇I = (`ix`, `iy`).
    pub fn variance(&self, ix: f32, iy: f32) -> f64 {
        let position = POSITION_ERROR * POSITION_ERROR * (ix * ix + iy * iy);
        self.sigma * self.sigma + f64::from(position)
    }

    /// Robust χ² of pixel `i`.
    pub fn misfit(&self, linearisation: &Linearisation, i: usize) -> f64 {
        let [ix, iy] = linearisation.gradient.data()[i];
        let r = f64::from(linearisation.rows.data()[i][RESIDUAL]);
        let q = r * r / self.variance(ix, iy);
        let scale = f64::from(ROBUST * ROBUST);
        scale * q / (scale + q)
    }

    /// Longest step of T and of ω.
    pub fn longest(&self) -> f64 {
        LONGEST_STEP / self.scale.camera.focal
    }

    /// Weight of (ρ − 1)² at a pixel: a surface is expected to be about as deep as it is wide. Its relief,
    /// as a share of its distance, counts as [`RELIEF`] says against its extent over f.
    pub fn relief_prior(&self) -> f64 {
        let (mut n, mut sum, mut square) = (0.0f64, [0.0f64; 2], 0.0f64);
        let owned = self.owned.data().iter().enumerate();
        for (i, _) in owned.filter(|(_, w)| **w > 0.0) {
            let (x, y) = self.window.place(i);
            let (x, y) = (x as f64, y as f64);
            n += 1.0;
            sum = [sum[0] + x, sum[1] + y];
            square += x * x + y * y;
        }
        let n = n.max(1.0);
        let extent2 = square / n - (sum[0] / n).powi(2) - (sum[1] / n).powi(2);
        let f = self.scale.camera.focal;
        let relief2 = RELIEF.0 * RELIEF.0 * extent2 / (f * f);
        RELIEF.1 * self.sigma * self.sigma / (n * relief2.max(1e-6))
    }

    /// Precision of ω, times the noise's variance.
    pub fn rotation_prior(&self) -> f64 {
        let f = self.scale.camera.focal;
        let spread = ROTATION_SPREAD * self.scale.width() as f64 / 320.0;
        (self.sigma * f / spread).powi(2)
    }
}
