//! A match with what it is worth, and how far it is from where a rigid motion may bring it.
//!
//! What ray p shows lies, after the motion (T, R) and at any inverse depth ρ ≥ 0, on a half line of the second frame,
//!
//! ```text
//! x(τ) = π(R p) + τ u,      u = (T_x, T_y) − T_z π(R p),      τ = ρ / ((R p)_z + ρ T_z)
//! ```
//!
//! and the misfit of the match that ends at q is its least squared distance from there in units of its uncertainty,
//!
//! ```text
//! χ² = min_τ (q − x)ᵀ (C + m² 1)⁻¹ (q − x)
//! ```
//!
//! C is the covariance of the match in px², m what models are off anyway. Without T the half line is a point.

use glam::{DMat3, DVec2, DVec3};

use super::epipolar::Pair;
use super::matches::{Match, matches};
use crate::camera::{Camera, RigidMotion};
use crate::frames::{FramePair, MIN_SIDE, halved, halved_camera, shrunk_camera};
use crate::grid::Grid;
use crate::options::Detail;
use crate::working::factor;

/// Frames of more pixels are halved.
const PIXELS: usize = 352 * 288;
/// m: what displacements are off beside noise, in pixels.
const MODEL_ERROR: f64 = 0.12;
/// χ² below which a motion explains a match.
pub const EXPLAINED: f64 = 9.0;
/// How far behind infinity, in pixels, a point may seem to be: R is never exact.
const BEHIND: f64 = 0.3;

/// A match, its rays and its weight.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// The match.
    pub matched: Match,
    p: DVec3,
    q: DVec2,
    /// xx, xy and yy of (C + m² 1)⁻¹, 1/px².
    pub weight: [f64; 3],
}

/// A rigid motion, as matches are compared with it.
#[derive(Clone, Copy, Debug)]
pub struct Carrier {
    rotation: DMat3,
    translation: DVec3,
    focal: f64,
}

/// The matches of two frames, halved where they are large.
pub struct Small {
    /// The matches.
    pub samples: Vec<Sample>,
    /// The camera of the halved frames.
    pub camera: Camera,
    /// Their width and height.
    pub size: [usize; 2],
    /// The frames, grey levels.
    pub frames: [Grid<f32>; 2],
}

/// The matches between the frames of `pair`.
pub fn small_samples(pair: &FramePair, camera: &Camera) -> Small {
    let n = factor(pair.width(), pair.height(), Detail::Fine);
    let mut camera = shrunk_camera(camera, n);
    let mut frames = [pair.first(), pair.second()].map(|frame| frame.grey_shrunk(n));
    while frames[0].len() > PIXELS && frames[0].width().min(frames[0].height()) >= 2 * MIN_SIDE {
        frames = frames.map(|frame| halved(&frame));
        camera = halved_camera(&camera);
    }
    let found = matches(&frames[0], &frames[1]).into_iter();
    let shown = |[x, y]: [f32; 2]| {
        pair.absent().is_none_or(|absent| {
            let place = |at: f32, to: usize, from: usize| {
                let at = (at.max(0.0) + 0.5) * to as f32 / from as f32;
                (at as usize).min(to - 1)
            };
            let (w, h) = (frames[0].width(), frames[0].height());
            absent[(place(x, absent.width(), w), place(y, absent.height(), h))] == 0
        })
    };
    let samples = found
        .filter(|m| shown(m.at) && shown(m.to))
        .map(|m| Sample::new(m, &camera));
    Small {
        samples: samples.filter(Sample::finite).collect(),
        camera,
        size: [frames[0].width(), frames[0].height()],
        frames,
    }
}

impl Sample {
    fn finite(&self) -> bool {
        self.p.is_finite() && self.q.is_finite() && self.weight.iter().all(|w| w.is_finite())
    }

    /// A match as `camera` sees it.
    pub fn new(matched: Match, camera: &Camera) -> Self {
        let ray = |[x, y]: [f32; 2]| camera.ray(x.into(), y.into());
        let [xx, xy, yy] = matched.tensor.map(f64::from);
        let variance = f64::from(matched.residual).powi(2).max(1e-6);
        let determinant = (xx * yy - xy * xy).max(f64::MIN_POSITIVE);
        let least = MODEL_ERROR * MODEL_ERROR;
        let c = [yy, -xy, xx].map(|v| v * variance / determinant);
        let (cxx, cxy, cyy) = (c[0] + least, c[1], c[2] + least);
        let determinant = cxx * cyy - cxy * cxy;
        Self {
            matched,
            p: ray(matched.at),
            q: ray(matched.to).truncate(),
            weight: [cyy, -cxy, cxx].map(|v| v / determinant),
        }
    }

    /// Where it is in the first frame, in pixels.
    pub fn at(&self) -> DVec2 {
        let [x, y] = self.matched.at;
        DVec2::new(x.into(), y.into())
    }

    /// Displacement in pixels.
    pub fn displacement(&self) -> DVec2 {
        let [dx, dy] = self.matched.displacement();
        DVec2::new(dx.into(), dy.into())
    }

    /// Its rays.
    pub fn pair(&self) -> Pair {
        Pair {
            p: self.p,
            q: self.q.extend(1.0),
        }
    }

    /// vᵀ W w.
    pub fn product(&self, v: DVec2, w: DVec2) -> f64 {
        let [xx, xy, yy] = self.weight;
        v.x * (xx * w.x + xy * w.y) + v.y * (xy * w.x + yy * w.y)
    }
}

impl Carrier {
    /// Of a motion seen by `camera`; only the direction of T counts.
    pub fn new(motion: &RigidMotion, camera: &Camera) -> Self {
        Self {
            rotation: motion.matrix(),
            translation: motion.translation.normalize_or_zero(),
            focal: camera.focal,
        }
    }

    /// Share of `samples` with χ² below [`EXPLAINED`].
    pub fn share_explained(&self, samples: &[Sample]) -> f64 {
        let near = samples.iter().filter(|s| self.explains(s));
        near.count() as f64 / samples.len().max(1) as f64
    }

    /// Whether χ² of a match is below [`EXPLAINED`].
    pub fn explains(&self, sample: &Sample) -> bool {
        self.misfit(sample) < EXPLAINED
    }

    /// χ² of a match.
    pub fn misfit(&self, sample: &Sample) -> f64 {
        let p = self.rotation * sample.p;
        let start = p.truncate() / p.z;
        let r = (sample.q - start) * self.focal;
        let t = self.translation;
        let u = (t.truncate() - t.z * start) * self.focal;
        let length = sample.product(u, u);
        if length < 1e-12 {
            return sample.product(r, r);
        }
        let least = -BEHIND / u.length();
        let greatest = if t.z > 1e-6 {
            t.z.recip()
        } else {
            f64::INFINITY
        };
        let tau = (sample.product(u, r) / length).max(least).min(greatest);
        let off = r - u * tau;
        sample.product(off, off)
    }
}
