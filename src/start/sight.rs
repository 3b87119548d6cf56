//! What patches say about a motion: how much each speaks for the image motion that it would have.
//!
//! A patch's displacement w is either that of the surface it shows, m, or anything:
//!
//! ```text
//! p(w; m) = (1−ε) N(w; m, C) + ε N(w; w̄, C + R² I)        cost(w; m) = −2 s log( p(w; m) / N(w; w̄, C + R² I) )
//! ```
//!
//! C is the covariance that comes with the patch, w̄ and R the middle and the spread of all patches, and
//! s the share of an independent patch that one is which overlaps with its neighbours. Pixels of the
//! scale at work throughout; rays are (x, y) / f from the principal point.

use super::patches::Patch;
use crate::camera::Camera;

/// ε, the share of patches that follow no surface: those that show two, or were matched wrongly.
const OUTLIERS: f64 = 0.1;
/// s: patches overlap by half with their neighbours.
const SHARE: f64 = 0.25;
/// No patch is known better than this, in pixels, and none worse.
const KNOWN: [f64; 2] = [0.05, 100.0];
/// R is the distance from w̄ that this share of patches keeps, and at least a pixel.
const SPREAD: f64 = 0.95;

/// One patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    /// Where its centre is seen, as a ray.
    pub ray: [f64; 2],
    /// Its displacement.
    pub motion: [f64; 2],
    /// xx, xy and yy of the covariance of its displacement, pixels².
    pub covariance: [f64; 3],
    /// 2 log of N(w; w̄, C + R² I) but for constants.
    anything: f64,
}

/// All patches of a pair.
pub(super) struct Sights {
    /// The patches.
    pub all: Vec<Sight>,
    /// f, pixels.
    pub focal: f64,
    /// R, pixels.
    pub spread: f64,
    middle: [f64; 2],
}

impl Sights {
    /// Takes over patches that `camera` sees.
    pub fn new(camera: &Camera, patches: &[Patch]) -> Self {
        let rank = |mut values: Vec<f64>, share: f64| {
            values.sort_by(f64::total_cmp);
            let at = (share * values.len() as f64) as usize;
            values.get(at).copied().unwrap_or(0.0)
        };
        let motions = || patches.iter().map(|p| p.motion.map(f64::from));
        let middle = [0, 1].map(|i| rank(motions().map(|m| m[i]).collect(), 0.5));
        let apart = motions().map(|[u, v]| (u - middle[0]).hypot(v - middle[1]));
        let spread = rank(apart.collect(), SPREAD).max(1.0);
        let all = patches.iter().map(|patch| Sight {
            ray: [
                (f64::from(patch.x) - camera.cx) / camera.focal,
                (f64::from(patch.y) - camera.cy) / camera.focal,
            ],
            motion: patch.motion.map(f64::from),
            covariance: covariance(patch),
            anything: 0.0,
        });
        let mut sights = Self {
            all: all.collect(),
            focal: camera.focal,
            spread,
            middle,
        };
        sights.distrust(1.0);
        sights
    }

    /// The same patches, of a camera whose focal length is `focal`.
    pub fn through(&self, focal: f64) -> Self {
        let longer = self.focal / focal;
        let all = self.all.iter().map(|sight| Sight {
            ray: sight.ray.map(|r| longer * r),
            ..*sight
        });
        Self {
            all: all.collect(),
            focal,
            ..*self
        }
    }

    /// Multiplies every covariance by `factor`.
    pub fn distrust(&mut self, factor: f64) {
        let (middle, spread) = (self.middle, self.spread);
        for sight in &mut self.all {
            sight.covariance = sight.covariance.map(|c| factor * c);
            sight.anything = -sight.misfit(middle, spread * spread);
        }
    }

    /// What another number costs that is fitted to `patches` of them (Schwarz 1978).
    pub fn price(patches: usize) -> f64 {
        (SHARE * patches as f64).max(2.0).ln()
    }

    /// cost(w; m) of patch `i`.
    pub fn cost(&self, i: usize, flow: [f64; 2]) -> f64 {
        let sight = &self.all[i];
        let odds = odds(-sight.misfit(flow, 0.0) - sight.anything);
        -2.0 * SHARE * (OUTLIERS.ln() + odds.ln_1p())
    }

    /// The probability that patch `i` follows a surface that moves it by `flow`, known to `slack` pixels.
    pub fn follows(&self, i: usize, flow: [f64; 2], slack: f64) -> f64 {
        let sight = &self.all[i];
        let slack2 = slack * slack;
        let anything = if slack > 0.0 {
            -sight.misfit(self.middle, self.spread * self.spread + slack2)
        } else {
            sight.anything
        };
        let odds = odds(-sight.misfit(flow, slack2) - anything);
        odds / (1.0 + odds)
    }
}

impl Sight {
    /// (w−m)ᵀ (C+v I)⁻¹ (w−m) + log det (C+v I).
    fn misfit(&self, flow: [f64; 2], variance: f64) -> f64 {
        let (det, [a, b, c]) = self.precision(variance);
        let (u, v) = (self.motion[0] - flow[0], self.motion[1] - flow[1]);
        a * u * u + 2.0 * b * u * v + c * v * v + det.ln()
    }

    /// det (C+v I) and (C+v I)⁻¹.
    pub fn precision(&self, variance: f64) -> (f64, [f64; 3]) {
        let [a, b, c] = self.covariance;
        let (a, c) = (a + variance, c + variance);
        let det = a * c - b * b;
        (det, [c / det, -b / det, a / det])
    }

    /// (w−m)ᵀ C⁻¹ (w−m).
    pub fn distance2(&self, flow: [f64; 2]) -> f64 {
        let (det, _) = self.precision(0.0);
        self.misfit(flow, 0.0) - det.ln()
    }
}

/// (1−ε)/ε times the ratio of two densities whose logarithms differ by half of `difference`.
fn odds(difference: f64) -> f64 {
    (0.5 * difference).min(60.0).exp() * (1.0 - OUTLIERS) / OUTLIERS
}

/// The inverse of a patch's precision, within what can be known.
fn covariance(patch: &Patch) -> [f64; 3] {
    let [a, b, c] = patch.precision.map(f64::from);
    let [best, worst] = KNOWN.map(|k| k * k);
    let (a, c) = (a + 1.0 / worst, c + 1.0 / worst);
    let det = a * c - b * b;
    [c / det + best, -b / det, a / det + best]
}
