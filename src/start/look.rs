//! A first look at two frames: small patches matched all over, how far to trust them, and the surfaces
//! that they show.
//!
//! Large frames are halved first, to about [`PIXELS`], and blurred by [`SMOOTHING`]. Patches say how well
//! they know their displacements as if noise were white; it is not, once smoothed, and what they say is
//! corrected by how far they are off what those around them agree on. Frames whose patches match nothing
//! do not show the same things: there is nothing to be looked at then.

use super::lattice::Lattice;
use super::likeness::likeness;
use super::patches::patches;
use super::scale::{SMALLEST, Scale};
use super::sight::Sights;
use super::surface::Surface;
use super::surfaces::{Surfaces, windows};
use crate::camera::Camera;
use crate::frames::{FramePair, blur, halved, halved_camera};

/// Frames of more pixels are halved before anything else.
const PIXELS: usize = 352 * 288;
/// Smoothing of the frames, in pixels.
const SMOOTHING: f64 = 1.0;
/// With fewer patches than this there is nothing to be told.
const FEWEST: usize = 24;
/// Frames less alike than this do not show the same things.
const ALIKE: f64 = 0.5;
/// Where patches disagree with what their neighbours do by more than they should: the median of a
/// squared error in two dimensions, over its variance, and which window's errors count, of windows
/// from the quietest to the least quiet.
const MEDIAN: f64 = 1.386;
const QUIET: f64 = 0.4;
/// Those windows, in places of the lattice to each side.
const WINDOW: f64 = 4.0;
/// Patches know their displacements worse than they say by no more than this factor in variance.
const WORST: f64 = 16.0;

/// What is seen.
pub struct Look {
    /// Where the patches are.
    pub(super) lattice: Lattice,
    /// What they say.
    pub(super) sights: Sights,
    /// Planes in motion that explain them, each in one piece.
    pub(super) surfaces: Surfaces,
    /// Columns and rows of the frames that they were matched in.
    pub(super) size: (usize, usize),
    /// Columns and rows of the frames as they came.
    pub(super) frame: (usize, usize),
}

impl Look {
    /// Looks at `pair`, which `camera` took; `None` when nothing can be told from it.
    pub fn at(pair: &FramePair, camera: &Camera) -> Option<Self> {
        let scales = scales(pair, *camera);
        let found = patches(&scales, 0);
        if found.len() < FEWEST || likeness(&scales[0], &found) < ALIKE {
            return None;
        }
        let lattice = Lattice::new(&found);
        let mut sights = Sights::new(&scales[0].camera, &found);
        sights.distrust(doubt(&sights, &lattice));
        Some(Self {
            surfaces: Surfaces::find(&sights, &lattice).torn_apart(&sights, &lattice),
            lattice,
            sights,
            size: (scales[0].width(), scales[0].height()),
            frame: (pair.width(), pair.height()),
        })
    }

    /// The same patches and surfaces, taken for what a camera of focal length `focal` sees; pixels of
    /// the frames that they were matched in.
    pub(super) fn through(&self, focal: f64) -> Self {
        Self {
            lattice: self.lattice.clone(),
            sights: self.sights.through(focal),
            surfaces: self.surfaces.stretched(self.sights.focal / focal),
            ..*self
        }
    }
}

/// The frames at the scale to work on, and coarser ones.
fn scales(pair: &FramePair, mut camera: Camera) -> Vec<Scale> {
    let mut frames = [pair.first(), pair.second()].map(|f| blur(&f.grey, SMOOTHING));
    while frames[0].len() > PIXELS {
        frames = frames.map(|f| halved(&f));
        camera = halved_camera(&camera);
    }
    let mut scales = Vec::new();
    loop {
        let smaller = frames[0].width().min(frames[0].height()) / 2;
        let next = (smaller >= SMALLEST).then(|| [halved(&frames[0]), halved(&frames[1])]);
        let [first, second] = frames;
        scales.push(Scale::new(camera, first, second));
        let Some(halves) = next else {
            return scales;
        };
        frames = halves;
        camera = halved_camera(&camera);
    }
}

/// By which factor patches' variances are larger than they say: noise has been smoothed with the
/// frames, which no single patch can know. Read from how far patches are off what those around them
/// agree on.
fn doubt(sights: &Sights, lattice: &Lattice) -> f64 {
    let mut seen: Vec<f64> = windows(lattice, WINDOW)
        .map(|within| {
            let agreed = Surface::agreed(sights, &within, 6);
            let mut errors: Vec<f64> = within
                .iter()
                .map(|&i| sights.all[i].distance2(agreed.flow(sights.all[i].ray)))
                .collect();
            errors.sort_by(f64::total_cmp);
            errors[errors.len() / 2] / MEDIAN
        })
        .collect();
    seen.sort_by(f64::total_cmp);
    let quiet = seen.get((QUIET * seen.len() as f64) as usize);
    quiet.copied().unwrap_or(1.0).clamp(1.0, WORST)
}
