//! What two frames are interpreted as: outlines, rigid motions, depth and the image motion they give.
//!
//! The solver produces one, a built-in sequence carries one as its truth, views and files are made
//! from one, and scores compare two.

use crate::camera::{Camera, RigidMotion};
use crate::frames::shrunk_camera;
use crate::grid::Grid;
use crate::motion_model::MotionModel;
use crate::working::downsampled;

/// Least and greatest depth that is told, in units in which a region's mean 1/Z is 1.
pub const NEAREST_FARTHEST: [f32; 2] = [0.02, 50.0];

/// Image motion in pixels per frame.
///
/// ```
/// use relievo::file::flo;
/// use relievo::{Flow, Grid};
///
/// let flow = Flow {
///     u: Grid::new(8, 6, 1.5),
///     v: Grid::new(8, 6, -0.25),
/// };
/// let bytes = flo::write(&flow);
/// assert_eq!(flo::read(&bytes, "flow.flo")?, flow);
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Flow {
    /// Rightwards. Not a number where unknown.
    pub u: Grid<f32>,
    /// Downwards. Not a number where unknown.
    pub v: Grid<f32>,
}

/// Labels, depth, motion and flow of the first of two frames; all grids have the frame's size.
///
/// ```
/// use relievo::scene;
///
/// let truth = scene::render("squares", 64, 48)?.truth;
/// assert_eq!(truth.regions(), 3);
/// // The first square twice as far away, and twice as fast: the same image motion.
/// let scaled = truth.scaled(&[1.0, 2.0]);
/// assert_eq!(scaled.motions[1].translation, 2.0 * truth.motions[1].translation);
/// assert_eq!(scaled.flow, truth.flow);
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Interpretation {
    /// The camera that it is meant for.
    pub camera: Camera,
    /// 0 where the background is seen, k inside the k-th curve.
    pub labels: Grid<u8>,
    /// Z > 0, in units of its own for each region: two frames do not tell the scale between them.
    pub depth: Grid<f32>,
    /// Where each pixel goes.
    pub flow: Flow,
    /// How far depth is observable at each pixel: 0 not at all, 1 fully.
    pub confidence: Grid<f32>,
    /// 1 where a pixel's point is hidden in the second frame, 0 elsewhere.
    pub occluded: Grid<u8>,
    /// The motion of each region; `motions[k]` belongs to label k.
    pub motions: Vec<RigidMotion>,
}

/// What an [`Interpretation`] has at one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// Whose it is.
    pub label: u8,
    /// Z.
    pub depth: f32,
    /// Motion to the right, pixels per frame.
    pub u: f32,
    /// Motion downwards, pixels per frame.
    pub v: f32,
    /// How far depth is observable, 0–1.
    pub confidence: f32,
    /// Whether it is hidden in the second frame.
    pub occluded: bool,
}

impl Interpretation {
    /// What it has at a pixel of the frame.
    pub fn pixel(&self, at: (usize, usize)) -> Pixel {
        Pixel {
            label: self.labels[at],
            depth: self.depth[at],
            u: self.flow.u[at],
            v: self.flow.v[at],
            confidence: self.confidence[at],
            occluded: self.occluded[at] != 0,
        }
    }

    /// Number of regions, the background included.
    pub fn regions(&self) -> usize {
        self.motions.len()
    }

    /// The model of each region's motion as far as it shows, T being taken in units in which the region's mean 1/Z is 1.
    pub fn models(&self) -> Vec<MotionModel> {
        let mut sums = vec![(0.0, 0usize); self.regions()];
        for (&k, &z) in self.labels.data().iter().zip(self.depth.data()) {
            if let Some((sum, count)) = sums.get_mut(usize::from(k))
                && z.is_finite()
                && z > 0.0
            {
                *sum += f64::from(z).recip();
                *count += 1;
            }
        }
        let each = self.motions.iter().zip(sums);
        each.map(|(motion, (sum, count))| {
            let scaled = RigidMotion {
                translation: motion.translation * (sum / count.max(1) as f64),
                ..*motion
            };
            MotionModel::seen(&self.camera, &scaled)
        })
        .collect()
    }

    /// The same of the frames shrunk `factor` times.
    pub fn shrunk(&self, factor: usize) -> Self {
        let size = (self.labels.width() / factor, self.labels.height() / factor);
        let camera = shrunk_camera(&self.camera, factor);
        downsampled(self, size, factor as f32, camera)
    }

    /// The same with region k's depth multiplied by `factors[k]` (1 where `factors` is too short) and
    /// its translation with it, which changes no image motion.
    pub fn scaled(&self, factors: &[f64]) -> Self {
        let factor = |k: usize| factors.get(k).copied().unwrap_or(1.0);
        let mut scaled = self.clone();
        for (z, &k) in scaled.depth.data_mut().iter_mut().zip(self.labels.data()) {
            *z *= factor(usize::from(k)) as f32;
        }
        for (k, motion) in scaled.motions.iter_mut().enumerate() {
            motion.translation *= factor(k);
        }
        scaled
    }
}
