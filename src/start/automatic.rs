//! Curves to start from, without anyone drawing: a polygon roughly on each thing that moves by itself.
//!
//! Small patches are matched all over the frame. Their displacements are explained by planes in motion,
//! as many as pay for their description; planes that one motion carries, whatever their depth, are
//! one body; the body that holds most of the frame's border is the background, and each place where
//! another explains the patches better gets an outline. Everything is decided by one criterion, the
//! description length of the patches, so there is nothing to set. The same frames give the same curves;
//! frames that do not show the same things give none.
//!
//! What moves as the background would at another depth cannot be told from scenery, and what covers less
//! than a hundredth of the frame cannot be told from the seam between two motions.

use super::bodies::bodies;
use super::lattice::Lattice;
use super::likeness::likeness;
use super::outline::{Outline, outlines};
use super::patches::patches;
use super::sight::Sights;
use super::surface::Surface;
use super::surfaces::{Surfaces, least_costs, windows};
use crate::camera::Camera;
use crate::curves::Shape;
use crate::frames::{FramePair, blur, halved, halved_camera};
use crate::warp::{SMALLEST, Scale};

/// Curves at most.
const MOST: usize = 4;
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

/// Polygons roughly on the things that move by themselves, the largest first, at most four; none when
/// one rigid motion explains both frames. Corners are in pixels of the frame, inside it, to a tenth of a
/// pixel. `camera` is the frames' own.
pub fn automatic(pair: &FramePair, camera: &Camera) -> Vec<Shape> {
    let scales = scales(pair, *camera);
    let found = patches(&scales, 0);
    if found.len() < FEWEST || likeness(&scales[0], &found) < ALIKE {
        return Vec::new();
    }
    let lattice = Lattice::new(&found);
    let mut sights = Sights::new(&scales[0].camera, &found);
    sights.distrust(doubt(&sights, &lattice));
    let surfaces = Surfaces::find(&sights, &lattice).torn_apart(&sights, &lattice);
    let costs: Vec<Vec<f64>> = bodies(&sights, &lattice, &surfaces)
        .iter()
        .map(|body| least_costs(&sights, &lattice, body.iter().map(|&k| &surfaces.all[k])))
        .collect();
    let mut curves: Vec<Outline> = (1..costs.len())
        .flat_map(|k| {
            let rivals = || costs.iter().enumerate().filter(move |(j, _)| *j != k);
            let margin: Vec<f64> = (0..found.len())
                .map(|i| {
                    let least = rivals().map(|(_, c)| c[i]).fold(f64::INFINITY, f64::min);
                    least - costs[k][i]
                })
                .collect();
            let small = (scales[0].width(), scales[0].height());
            outlines(&lattice, &margin, small, (pair.width(), pair.height()))
        })
        .collect();
    curves.sort_by(|a, b| b.share.total_cmp(&a.share));
    curves.truncate(MOST);
    let polygon = |outline: Outline| Shape::Polygon {
        points: outline.corners,
    };
    curves.into_iter().map(polygon).collect()
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
