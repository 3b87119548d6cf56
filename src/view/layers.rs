//! What is seen at each pixel, and what goes on behind it: two surfaces, of which relief and second eye are made.

use super::ViewParams;
use super::arrangement::arranged;
use super::behind::{Cut, behind};
use super::foreshortening::foreshorten;
use super::leaps::{Leap, sharpen};
use super::span::percentile;
use super::steady::{mean, median};
use crate::frames::Frame;
use crate::grid::Grid;
use crate::interpretation::Interpretation;

/// The label where there is no surface.
pub(super) const NOTHING: u8 = u8::MAX;
/// How far beyond the middle nine tenths of 1/Z a scene reaches on the far side, as a share of them: what is farther is
/// drawn there.
const BEYOND: f32 = 0.25;

/// One surface, a pixel at a time.
pub(super) struct Layer {
    /// The region that it is of, or [`NOTHING`].
    pub labels: Grid<u8>,
    /// Its 1/Z, foreshortened.
    pub rho: Grid<f32>,
    /// Its colour, sRGB.
    pub colours: Grid<[u8; 3]>,
    /// Whether its depth is known.
    pub known: Grid<bool>,
}

/// Both surfaces.
pub(super) struct Layers {
    /// What is seen.
    pub seen: Layer,
    /// What goes on behind it, across borders of regions and across leaps.
    pub hidden: [Layer; 2],
    /// Where depth leaps in what is seen: positive on the nearer side, zero on the outline, not a number elsewhere.
    pub psi: Grid<f32>,
    /// What is a leap.
    pub leap: Leap,
    /// The farthest, the middle and the nearest 1/Z, without the wildest.
    pub range: [f32; 3],
}

impl Layers {
    /// Both surfaces; the hidden one up to `reach` of the longer side from where it comes into sight.
    pub fn of(frame: &Frame, found: &Interpretation, params: &ViewParams, reach: f32) -> Self {
        let (mut rho, known) = arranged(found, params);
        let labels = &found.labels;
        let mut values: Vec<f32> = rho
            .data()
            .iter()
            .zip(known.data())
            .filter(|(_, known)| **known)
            .map(|(rho, _)| *rho)
            .collect();
        let at = |values: &mut [f32], q| percentile(values, q).unwrap_or(1.0);
        let range = [0.02, 0.5, 0.98].map(|q| at(&mut values, q));
        let [far, _, near] = range;
        let [farther, nearer] = [far - BEYOND * (near - far), near + (near - far)];
        for value in rho.data_mut() {
            *value = value.clamp(farther.max(0.5 * far), nearer.max(2.0 * far));
        }
        let side = frame.width().max(frame.height()) as f32 / found.camera.focal as f32;
        let range = match params.relief {
            None => foreshorten(rho.data_mut(), range, side),
            Some(_) => range,
        };
        let leap = Leap::of(range[0], range[2]);
        median(&mut rho, labels, leap);
        sharpen(&mut rho, labels, leap);
        let psi = sharpen(&mut rho, labels, leap);
        mean(&mut rho, labels, leap);
        let seen = Layer {
            labels: labels.clone(),
            rho,
            colours: (*frame.rgb).clone(),
            known,
        };
        let hidden = [Cut::Border, Cut::Leap].map(|cut| behind(&seen, leap, cut, reach));
        Self {
            seen,
            hidden,
            psi,
            leap,
            range,
        }
    }
}
