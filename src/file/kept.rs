//! An interpretation as bytes, to be put away and shown again.
//!
//! `RLV1`, how precise (one byte: 0 or 1), width and height (u32), the camera (f, cx, cy as f64), the number of regions
//! (one byte) and T and ω of each (six f64); then, row by row, labels and occlusion (a byte a pixel), and confidence, depth,
//! u and v. All is little-endian. A grid of floats is turned into whole numbers, each is replaced by its difference from its
//! left neighbour, and of these come all lowest bytes first, then the next: smooth grids so become mostly zeros, for
//! whoever compresses the whole.

use glam::DVec3;

use super::packed::{from_planes, planes};
use super::{bounded, unreadable};
use crate::camera::{Camera, RigidMotion};
use crate::error::Error;
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};
use crate::options::MAX_CURVES;

const FORMAT: &str = "kept result";
const MAGIC: &[u8; 4] = b"RLV1";

/// How much of a number is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Every bit.
    Exact,
    /// Depth to 0.1 %, flow to 1/64 of a pixel, confidence to 1/30: as much as an eye sees.
    Visible,
}

/// What one grid of floats holds.
#[derive(Clone, Copy)]
enum Quantity {
    Confidence,
    Depth,
    Flow,
}

/// Stands for what is not a number.
const NOTHING: i32 = i32::MIN;

impl Precision {
    fn whole(self, of: Quantity, value: f32) -> i32 {
        let rounded = |value: f32| {
            if value.is_nan() {
                NOTHING
            } else {
                value.round() as i32
            }
        };
        match (self, of) {
            (Self::Exact, _) => value.to_bits().cast_signed(),
            (Self::Visible, Quantity::Confidence) => rounded(value * CONFIDENCE_STEPS),
            (Self::Visible, Quantity::Depth) => rounded(value.ln() * DEPTH_STEPS),
            (Self::Visible, Quantity::Flow) => rounded(value * FLOW_STEPS),
        }
    }

    fn float(self, of: Quantity, whole: i32) -> f32 {
        match (self, of) {
            (Self::Exact, _) => f32::from_bits(whole.cast_unsigned()),
            (Self::Visible, _) if whole == NOTHING => f32::NAN,
            (Self::Visible, Quantity::Confidence) => whole as f32 / CONFIDENCE_STEPS,
            (Self::Visible, Quantity::Depth) => (whole as f32 / DEPTH_STEPS).exp(),
            (Self::Visible, Quantity::Flow) => whole as f32 / FLOW_STEPS,
        }
    }
}

const CONFIDENCE_STEPS: f32 = 15.0;
const DEPTH_STEPS: f32 = 512.0;
const FLOW_STEPS: f32 = 32.0;

/// The bytes that [`read`] takes.
pub fn write(found: &Interpretation, precision: Precision) -> Vec<u8> {
    let (width, height) = (found.labels.width(), found.labels.height());
    let mut bytes = MAGIC.to_vec();
    bytes.push(u8::from(precision == Precision::Visible));
    bytes.extend((width as u32).to_le_bytes());
    bytes.extend((height as u32).to_le_bytes());
    let Camera { focal, cx, cy } = found.camera;
    bytes.extend([focal, cx, cy].iter().flat_map(|x| x.to_le_bytes()));
    bytes.push(found.motions.len() as u8);
    for RigidMotion {
        translation: t,
        rotation: w,
    } in &found.motions
    {
        bytes.extend(
            [t.x, t.y, t.z, w.x, w.y, w.z]
                .iter()
                .flat_map(|x| x.to_le_bytes()),
        );
    }
    bytes.extend(found.labels.data());
    bytes.extend(found.occluded.data());
    for (of, grid) in [
        (Quantity::Confidence, &found.confidence),
        (Quantity::Depth, &found.depth),
        (Quantity::Flow, &found.flow.u),
        (Quantity::Flow, &found.flow.v),
    ] {
        let wholes = grid.data().iter().map(|&value| precision.whole(of, value));
        planes(wholes, &mut bytes);
    }
    bytes
}

/// What was written. `name` is what errors call it.
///
/// # Errors
/// [`Error::File`] for anything else.
pub fn read(bytes: &[u8], name: &str) -> Result<Interpretation, Error> {
    let wrong = |reason: &str| unreadable(name, FORMAT, reason);
    let short = || wrong("it ends too early");
    let mut rest = Rest(bytes);
    if rest.take(4).ok_or_else(short)? != MAGIC {
        return Err(wrong("it does not begin like one"));
    }
    let precision = match rest.byte().ok_or_else(short)? {
        0 => Precision::Exact,
        1 => Precision::Visible,
        _ => return Err(wrong("its precision is none that is known")),
    };
    let (width, height) = rest.side().zip(rest.side()).ok_or_else(short)?;
    let (width, height) = bounded(name, FORMAT, width, height)?;
    let camera = rest.floats(3).ok_or_else(short)?;
    let camera = Camera::new(camera[0], camera[1], camera[2])?;
    let regions = usize::from(rest.byte().ok_or_else(short)?);
    if !(1..=MAX_CURVES + 1).contains(&regions) {
        return Err(wrong("it has no regions, or too many"));
    }
    let motions = rest.floats(6 * regions).ok_or_else(short)?;
    let motions = (motions.chunks_exact(6))
        .map(|m| RigidMotion {
            translation: DVec3::new(m[0], m[1], m[2]),
            rotation: DVec3::new(m[3], m[4], m[5]),
        })
        .collect();
    let pixels = width * height;
    let labels = rest.take(pixels).ok_or_else(short)?.to_vec();
    if labels.iter().any(|&k| usize::from(k) >= regions) {
        return Err(wrong("it has a label without a motion"));
    }
    let occluded = rest.take(pixels).ok_or_else(short)?.to_vec();
    let mut grid = |of: Quantity| {
        let planes = rest.take(4 * pixels).ok_or_else(short)?;
        let values = from_planes(planes).map(|whole| precision.float(of, whole));
        Grid::from_vec(width, height, values.collect())
    };
    let confidence = grid(Quantity::Confidence)?;
    let depth = grid(Quantity::Depth)?;
    let (u, v) = (grid(Quantity::Flow)?, grid(Quantity::Flow)?);
    Ok(Interpretation {
        camera,
        labels: Grid::from_vec(width, height, labels)?,
        depth,
        flow: Flow { u, v },
        confidence,
        occluded: Grid::from_vec(width, height, occluded)?,
        motions,
    })
}

/// What has not been read yet; `None` where there is too little of it.
struct Rest<'a>(&'a [u8]);

impl<'a> Rest<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, left) = self.0.split_at_checked(count)?;
        self.0 = left;
        Some(taken)
    }

    fn byte(&mut self) -> Option<u8> {
        self.take(1).map(|one| one[0])
    }

    fn side(&mut self) -> Option<i64> {
        Some(u32::from_le_bytes(self.take(4)?.try_into().ok()?).into())
    }

    fn floats(&mut self, count: usize) -> Option<Vec<f64>> {
        let (eights, _) = self.take(8 * count)?.as_chunks::<8>();
        Some(
            eights
                .iter()
                .map(|&eight| f64::from_le_bytes(eight))
                .collect(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    fn truth() -> Interpretation {
        scene::render("blocks", 48, 36).unwrap().truth
    }

    #[test]
    fn exact_is_what_it_was() {
        let truth = truth();
        let back = read(&write(&truth, Precision::Exact), "it").unwrap();
        assert_eq!(back, truth);
    }

    #[test]
    fn what_is_not_known_stays_so() {
        let mut truth = truth();
        truth.flow.u[(3, 4)] = f32::NAN;
        for precision in [Precision::Exact, Precision::Visible] {
            let back = read(&write(&truth, precision), "it").unwrap();
            assert!(back.flow.u[(3, 4)].is_nan());
        }
    }

    #[test]
    fn visible_is_what_an_eye_sees() {
        let truth = truth();
        let back = read(&write(&truth, Precision::Visible), "it").unwrap();
        assert_eq!(back.labels, truth.labels);
        for (z, true_z) in back.depth.data().iter().zip(truth.depth.data()) {
            assert!((z / true_z - 1.0).abs() < 1.1e-3);
        }
        for (u, true_u) in back.flow.u.data().iter().zip(truth.flow.u.data()) {
            assert!((u - true_u).abs() <= 1.01 / 64.0);
        }
    }

    #[test]
    fn what_is_cut_or_altered_is_refused() {
        let whole = write(&truth(), Precision::Exact);
        for end in [0, 3, 4, 9, 30, 60, 400, whole.len() - 1] {
            assert!(read(&whole[..end], "it").is_err(), "{end}");
        }
        for (at, byte) in [(0, 0), (4, 7), (8, 255), (37, 0), (37, 200)] {
            let mut other = whole.clone();
            other[at] = byte;
            assert!(read(&other, "it").is_err(), "{at}");
        }
    }
}
