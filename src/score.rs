//! How far an interpretation is from the truth.
//!
//! AEE is the mean length of the flow's error in pixels, AAE the mean angle in degrees between
//! (u, v, 1) and the true (u, v, 1). Labels are wrong by the share of pixels that have another than
//! the true one. Depth has a scale of its own in each region, so it is scored as mean |aẐ − Z|/Z with
//! a = median(Z/Ẑ) over the region; a translation, whose length has no scale either, by its angle.
//! Where no depth was found, it counts as off by all of it; where no flow was found, as no motion.

use glam::DVec3;
use serde::Serialize;

use crate::camera::RigidMotion;
use crate::error::Error;
use crate::file::parts::Parts;
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};
use crate::ordered::ordered;

/// Distances between an interpretation and the truth. Lists have an entry for each region of the
/// truth, the background first; an entry is null where there is nothing to compare.
///
/// ```
/// use relievo::{horn_schunck, FramePair, scene, score};
///
/// let sequence = scene::render("squares", 64, 48)?;
/// let [first, second] = sequence.frames.clone();
/// let baseline = horn_schunck::interpreted(&FramePair::new(first, second)?)?;
/// let scores = score::compare(&baseline, &sequence.truth)?;
/// // It knows of no regions, so both squares are labelled wrong.
/// assert!(scores.labels_wrong > 0.05);
/// assert!(scores.aee.unwrap() < 1.0); // pixels
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Scores {
    /// Mean end-point error of the flow in pixels; null when no true flow is known.
    pub aee: Option<f64>,
    /// Mean angular error of the flow in degrees.
    pub aae: Option<f64>,
    /// Share of pixels with a wrong label, 0–1.
    pub labels_wrong: f64,
    /// Pixels in both regions over pixels in either, 0–1.
    pub iou: Vec<Option<f64>>,
    /// Mean relative depth error where depth is observable and the point not hidden, 1 at a pixel whose depth is no
    /// number above 0.
    pub depth_error: Vec<Option<f64>>,
    /// What a constant depth would score in the same pixels.
    pub flat_depth_error: Vec<Option<f64>>,
    /// Angle between the translations in degrees; null if either is zero.
    pub translation_angle: Vec<Option<f64>>,
    /// Length of the difference of the rotations in radians per frame.
    pub rotation_error: Vec<Option<f64>>,
}

/// [`Scores`] of what there is of two results; null where one of the two lacks what is compared.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct PartScores {
    /// Mean end-point error of the flow in pixels.
    pub aee: Option<f64>,
    /// Mean angular error of the flow in degrees.
    pub aae: Option<f64>,
    /// Share of pixels with a wrong label, 0–1.
    pub labels_wrong: Option<f64>,
    /// As in [`Scores`]; regions are those found where the truth has no labels.
    pub iou: Vec<Option<f64>>,
    /// As in [`Scores`].
    pub depth_error: Vec<Option<f64>>,
    /// As in [`Scores`].
    pub flat_depth_error: Vec<Option<f64>>,
    /// As in [`Scores`].
    pub translation_angle: Vec<Option<f64>>,
    /// As in [`Scores`].
    pub rotation_error: Vec<Option<f64>>,
}

/// Scores what was found against the truth.
///
/// # Errors
/// [`Error::TruthDiffers`] when the two are of different sizes.
pub fn compare(found: &Interpretation, truth: &Interpretation) -> Result<Scores, Error> {
    let scores = compare_parts(&Compared::of(found), &Compared::of(truth))?;
    Ok(Scores {
        aee: scores.aee,
        aae: scores.aae,
        labels_wrong: scores.labels_wrong.unwrap_or(0.0),
        iou: scores.iou,
        depth_error: scores.depth_error,
        flat_depth_error: scores.flat_depth_error,
        translation_angle: scores.translation_angle,
        rotation_error: scores.rotation_error,
    })
}

/// Scores what there is of a result against what there is of a truth.
///
/// # Errors
/// [`Error::TruthDiffers`] when the two are of different sizes, [`Error::NothingShared`] when they have nothing in
/// common.
pub fn compare_known(found: &Parts, truth: &Parts) -> Result<PartScores, Error> {
    shared(compare_parts(
        &Compared::from(found),
        &Compared::from(truth),
    )?)
}

/// Scores all that was found against what there is of a truth.
///
/// # Errors
/// Those of [`compare_known`].
pub fn compare_found(found: &Interpretation, truth: &Parts) -> Result<PartScores, Error> {
    shared(compare_parts(&Compared::of(found), &Compared::from(truth))?)
}

fn shared(scores: PartScores) -> Result<PartScores, Error> {
    let lists = [
        &scores.depth_error,
        &scores.translation_angle,
        &scores.rotation_error,
    ];
    let nothing = scores.aee.is_none()
        && scores.labels_wrong.is_none()
        && lists.iter().all(|list| list.iter().all(Option::is_none));
    if nothing {
        return Err(Error::NothingShared);
    }
    Ok(scores)
}

/// What is compared of a result.
struct Compared<'a> {
    labels: Option<&'a Grid<u8>>,
    depth: Option<&'a Grid<f32>>,
    flow: Option<&'a Flow>,
    occluded: Option<&'a Grid<u8>>,
    confidence: Option<&'a Grid<f32>>,
    motions: Option<&'a [RigidMotion]>,
}

impl<'a> Compared<'a> {
    fn of(all: &'a Interpretation) -> Self {
        Self {
            labels: Some(&all.labels),
            depth: Some(&all.depth),
            flow: Some(&all.flow),
            occluded: Some(&all.occluded),
            confidence: Some(&all.confidence),
            motions: Some(&all.motions),
        }
    }

    fn from(parts: &'a Parts) -> Self {
        Self {
            labels: parts.labels.as_ref(),
            depth: parts.depth.as_ref(),
            flow: parts.flow.as_ref(),
            occluded: parts.occluded.as_ref(),
            confidence: parts.confidence.as_ref(),
            motions: parts.motions.as_deref(),
        }
    }

    fn regions(&self) -> usize {
        let last = |labels: &Grid<u8>| labels.data().iter().copied().max().map_or(0, usize::from);
        let labelled = self.labels.map_or(1, |labels| last(labels) + 1);
        self.motions
            .map_or(labelled, |motions| motions.len().max(labelled))
    }
}

fn compare_parts(found: &Compared, truth: &Compared) -> Result<PartScores, Error> {
    let flow = match (found.flow, truth.flow) {
        (Some(found), Some(truth)) => compare_flow(found, truth, None)?,
        _ => None,
    };
    let labels = both(found.labels, truth.labels)?;
    let depth = both(found.depth, truth.depth)?;
    let regions = 0..Partition { found, truth }.regions();
    let pairs = || {
        labels
            .into_iter()
            .flat_map(|(a, b)| a.data().iter().zip(b.data()))
    };
    let wrong = pairs().filter(|(a, b)| a != b).count();
    let iou = |k: usize| {
        let is = |label: &u8| usize::from(*label) == k;
        let shared = pairs().filter(|(a, b)| is(a) && is(b)).count();
        let either = pairs().filter(|(a, b)| is(a) || is(b)).count();
        (either > 0).then(|| shared as f64 / either as f64)
    };
    let part = Partition { found, truth };
    let depths = |k: usize| -> Vec<(f64, f64)> {
        let Some((a, b)) = depth else {
            return Vec::new();
        };
        part.pixels(k)
            .map(|i| (a.data()[i].into(), b.data()[i].into()))
            .collect()
    };
    let flat = |k: usize| depths(k).iter().map(|&(_, z)| (1.0, z)).collect::<Vec<_>>();
    let motions = |k: usize| Some((found.motions?.get(k)?, truth.motions?.get(k)?));
    Ok(PartScores {
        aee: flow.map(|f| f.0),
        aae: flow.map(|f| f.1),
        labels_wrong: labels.map(|(_, b)| wrong as f64 / b.len().max(1) as f64),
        iou: regions.clone().map(iou).collect(),
        depth_error: regions.clone().map(|k| depth_error(&depths(k))).collect(),
        flat_depth_error: regions.clone().map(|k| depth_error(&flat(k))).collect(),
        translation_angle: regions
            .clone()
            .map(|k| motions(k).and_then(|(a, b)| angle(a.translation, b.translation)))
            .collect(),
        rotation_error: regions
            .map(|k| motions(k).map(|(a, b)| (a.rotation - b.rotation).length()))
            .collect(),
    })
}

/// The regions over which depth is compared, each with a scale of its own: the truth's, or those found where it has none.
struct Partition<'a> {
    found: &'a Compared<'a>,
    truth: &'a Compared<'a>,
}

impl<'a> Partition<'a> {
    fn labels(&self) -> Option<&'a Grid<u8>> {
        self.truth.labels.or(self.found.labels)
    }

    fn regions(&self) -> usize {
        match self.truth.labels {
            Some(_) => self.truth.regions(),
            None => self.truth.regions().max(self.found.regions()),
        }
    }

    /// Where the true depth of region `k` is known, observable and not hidden.
    fn pixels(&self, k: usize) -> impl Iterator<Item = usize> {
        let Compared {
            depth,
            confidence,
            occluded,
            ..
        } = *self.truth;
        let labels = self.labels();
        (0..depth.map_or(0, Grid::len)).filter(move |&i| {
            labels.is_none_or(|l| usize::from(l.data()[i]) == k)
                && confidence.is_none_or(|c| c.data()[i] > 0.0)
                && occluded.is_none_or(|o| o.data()[i] == 0)
                && depth.is_some_and(|z| is_depth(z.data()[i].into()))
        })
    }
}

/// 1 where the label is not the true one, 0 where it is; `None` where the truth has none.
pub(crate) fn label_errors(
    found: &Interpretation,
    truth: &Parts,
) -> Result<Option<Grid<f32>>, Error> {
    let labels = both(Some(&found.labels), truth.labels.as_ref())?;
    Ok(labels.map(|(a, b)| {
        let (width, height) = (a.width(), a.height());
        Grid::from_fn(width, height, |x, y| f32::from(a[(x, y)] != b[(x, y)]))
    }))
}

/// |aẐ − Z|/Z where depth is scored, and as it is scored; elsewhere not a number. `None` where the truth has no depth.
pub(crate) fn depth_errors(
    found: &Interpretation,
    truth: &Parts,
) -> Result<Option<Grid<f32>>, Error> {
    let Some((a, b)) = both(Some(&found.depth), truth.depth.as_ref())? else {
        return Ok(None);
    };
    let (found, truth) = (&Compared::of(found), &Compared::from(truth));
    let part = Partition { found, truth };
    let mut errors = Grid::new(b.width(), b.height(), f32::NAN);
    for k in 0..part.regions() {
        let pixels: Vec<usize> = part.pixels(k).collect();
        let pair = |&i: &usize| (f64::from(a.data()[i]), f64::from(b.data()[i]));
        let pairs: Vec<_> = pixels.iter().map(pair).collect();
        let scale = factor(&pairs).unwrap_or(0.0);
        for (i, pair) in pixels.into_iter().zip(pairs) {
            errors.data_mut()[i] = share_off(scale, pair) as f32;
        }
    }
    Ok(Some(errors))
}

/// Length of the flow's error in pixels; not a number where the truth is not known. `None` where it has no flow.
pub(crate) fn flow_errors(
    found: &Interpretation,
    truth: &Parts,
) -> Result<Option<Grid<f32>>, Error> {
    let Some(flow) = &truth.flow else {
        return Ok(None);
    };
    same_size(&found.flow.u, &flow.u)?;
    let known = |w: f32| if w.is_nan() { 0.0 } else { w };
    let (width, height) = (flow.u.width(), flow.u.height());
    Ok(Some(Grid::from_fn(width, height, |x, y| {
        let [u, v] = [&found.flow.u, &found.flow.v].map(|w| known(w[(x, y)]));
        (u - flow.u[(x, y)]).hypot(v - flow.v[(x, y)])
    })))
}

/// Two grids if there are both.
#[allow(clippy::type_complexity)]
fn both<'a, T: Copy>(
    found: Option<&'a Grid<T>>,
    truth: Option<&'a Grid<T>>,
) -> Result<Option<(&'a Grid<T>, &'a Grid<T>)>, Error> {
    match (found, truth) {
        (Some(found), Some(truth)) => {
            same_size(found, truth)?;
            Ok(Some((found, truth)))
        }
        _ => Ok(None),
    }
}

/// (AEE in pixels, AAE in degrees) over the pixels whose true flow is known and, if a mask is given,
/// where that is not 0; `None` when there are none.
///
/// # Errors
/// [`Error::TruthDiffers`] when sizes differ.
pub fn compare_flow(
    found: &Flow,
    truth: &Flow,
    mask: Option<&Grid<u8>>,
) -> Result<Option<(f64, f64)>, Error> {
    same_size(&found.u, &truth.u)?;
    if let Some(mask) = mask {
        same_size(mask, &truth.u)?;
    }
    let known = |w: f32| if w.is_nan() { 0.0 } else { f64::from(w) };
    let (mut lengths, mut angles, mut count) = (0.0, 0.0, 0_usize);
    for i in 0..truth.u.len() {
        let (u, v) = (truth.u.data()[i], truth.v.data()[i]);
        if !(u.is_finite() && v.is_finite()) || mask.is_some_and(|m| m.data()[i] == 0) {
            continue;
        }
        let a = DVec3::new(known(found.u.data()[i]), known(found.v.data()[i]), 1.0);
        let b = DVec3::new(u.into(), v.into(), 1.0);
        lengths += (a - b).length();
        angles += angle(a, b).unwrap_or(0.0);
        count += 1;
    }
    let n = count as f64;
    Ok((count > 0).then(|| (lengths / n, angles / n)))
}

/// Mean |aẐ − Z|/Z over pairs (Ẑ, Z), a = median(Z/Ẑ) where Ẑ was found; 1 where it was not.
fn depth_error(pairs: &[(f64, f64)]) -> Option<f64> {
    if pairs.is_empty() {
        return None;
    }
    let a = factor(pairs).unwrap_or(0.0);
    let sum: f64 = pairs.iter().map(|&pair| share_off(a, pair)).sum();
    Some(sum / pairs.len() as f64)
}

/// |aẐ − Z|/Z, 1 where no Ẑ was found.
fn share_off(a: f64, (depth, z): (f64, f64)) -> f64 {
    if is_depth(depth) {
        (a * depth - z).abs() / z
    } else {
        1.0
    }
}

fn is_depth(depth: f64) -> bool {
    depth.is_finite() && depth > 0.0
}

/// a = median(Z/Ẑ) over the pairs (Ẑ, Z) of which Ẑ was found; `None` where there are none.
fn factor(pairs: &[(f64, f64)]) -> Option<f64> {
    let known = pairs.iter().filter(|(depth, _)| is_depth(*depth));
    let ratios = ordered(known.map(|(depth, z)| z / depth).collect(), |&ratio| ratio);
    let middle = ratios.len() / 2;
    match ratios.len() {
        0 => None,
        odd if odd % 2 == 1 => Some(ratios[middle]),
        _ => Some((ratios[middle - 1] + ratios[middle]) / 2.0),
    }
}

/// For each region of `found` the factor that brings its depth to the true one, a = median(Z/Ẑ) over the pixels that
/// both give to it, over all that were found to be of it where the truth has no labels; 1 where there are none.
///
/// # Errors
/// [`Error::TruthDiffers`] when the two are of different sizes.
pub fn depth_factors(found: &Interpretation, truth: &Parts) -> Result<Vec<f64>, Error> {
    let regions = 0..found.regions();
    let Some((depth, true_depth)) = both(Some(&found.depth), truth.depth.as_ref())? else {
        return Ok(regions.map(|_| 1.0).collect());
    };
    let shared = |k: usize| -> Vec<(f64, f64)> {
        let own = |labels: &Grid<u8>, i: usize| usize::from(labels.data()[i]) == k;
        (0..depth.len())
            .filter(|&i| own(&found.labels, i) && truth.labels.as_ref().is_none_or(|l| own(l, i)))
            .map(|i| (depth.data()[i].into(), true_depth.data()[i].into()))
            .filter(|&(_, z): &(f64, f64)| is_depth(z))
            .collect()
    };
    Ok(regions.map(|k| factor(&shared(k)).unwrap_or(1.0)).collect())
}

/// Angle between two vectors in degrees, `None` if either is zero. By both sine and cosine: the
/// arc cosine alone loses small angles.
fn angle(a: DVec3, b: DVec3) -> Option<f64> {
    let defined = a.length() > 0.0 && b.length() > 0.0;
    defined.then(|| a.cross(b).length().atan2(a.dot(b)).to_degrees())
}

fn same_size<T: Copy, U: Copy>(found: &Grid<T>, truth: &Grid<U>) -> Result<(), Error> {
    if found.same_size(truth) {
        return Ok(());
    }
    Err(Error::TruthDiffers {
        found: (found.width(), found.height()),
        truth: (truth.width(), truth.height()),
    })
}
