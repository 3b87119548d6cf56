//! A result as the files that measure, as opposed to the pictures that one looks at; and back again.
//!
//! labels.png, depth.pfm, the same in 16 bits as depth16.png, flow.flo, occlusion.png (255 where hidden, so that it can be
//! seen) and motion.json. They do not say what the camera was, nor how far depth can be told: read back, it counts wherever
//! something travels.

use super::motion::MotionFile;
use super::{depth16, flo, pfm, png};
use crate::camera::{Camera, RigidMotion};
use crate::error::Error;
use crate::grid::Grid;
use crate::interpretation::Interpretation;
use crate::ordered::ordered;

/// The contents of the files of a result.
///
/// ```
/// use relievo::file::motion::{MotionFile, RegionMotion};
/// use relievo::file::result::{self, ResultFiles};
/// use relievo::scene;
///
/// let truth = scene::render("squares", 64, 48)?.truth;
/// let regions = RegionMotion::list(&truth.motions, &truth.models());
/// let motion = MotionFile { regions, ..Default::default() };
/// let files = result::write(&truth, &motion)?;
/// let bytes = |name| &files.iter().find(|(n, _)| *n == name).unwrap().1[..];
/// let read = ResultFiles {
///     labels: bytes("labels.png"),
///     depth: bytes("depth.pfm"),
///     flow: bytes("flow.flo"),
///     motion: std::str::from_utf8(bytes("motion.json")).unwrap(),
///     occlusion: Some(bytes("occlusion.png")),
/// }.read()?;
/// assert_eq!(read.labels, truth.labels);
/// assert_eq!(read.depth, truth.depth);
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ResultFiles<'a> {
    /// labels.png.
    pub labels: &'a [u8],
    /// depth.pfm.
    pub depth: &'a [u8],
    /// flow.flo.
    pub flow: &'a [u8],
    /// motion.json.
    pub motion: &'a str,
    /// occlusion.png; without it nothing counts as hidden.
    pub occlusion: Option<&'a [u8]>,
}

/// The names of the files of a result.
pub const NAMES: [&str; 6] = [
    "labels.png",
    "depth.pfm",
    "depth16.png",
    "flow.flo",
    "occlusion.png",
    "motion.json",
];

/// Names and contents of the files of `found`, which moves as `motion` says.
///
/// # Errors
/// What [`file()`] finds.
pub fn write(
    found: &Interpretation,
    motion: &MotionFile,
) -> Result<Vec<(&'static str, Vec<u8>)>, Error> {
    let named = NAMES.map(|name| Ok((name, file(name, found, motion)?)));
    named.into_iter().collect()
}

/// The contents of one of them, by its name of [`NAMES`].
///
/// # Errors
/// [`Error::Choice`] for another name, [`Error::File`] for an interpretation without pixels.
pub fn file(name: &str, found: &Interpretation, motion: &MotionFile) -> Result<Vec<u8>, Error> {
    match name {
        "labels.png" => png::write_labels(&found.labels),
        "depth.pfm" => Ok(pfm::write(&found.depth)),
        "depth16.png" => depth16::write(&found.depth, depth16::scale(&found.depth)),
        "flow.flo" => Ok(flo::write(&found.flow)),
        "occlusion.png" => {
            png::write_labels(&found.occluded.map(|hidden| 255 * u8::from(hidden != 0)))
        }
        "motion.json" => {
            let depth_scale = Some(depth16::scale(&found.depth));
            let told = MotionFile {
                depth_scale,
                ..motion.clone()
            };
            Ok(told.write().into_bytes())
        }
        _ => Err(Error::Choice {
            what: "file".to_owned(),
            value: name.to_owned(),
            choices: NAMES.join(", "),
        }),
    }
}

impl ResultFiles<'_> {
    /// The interpretation that was written. Its camera is one with the focal length of the frame's width.
    ///
    /// # Errors
    /// [`Error::File`] and [`Error::Json`] for a file that is none of its kind, [`Error::FilesDiffer`] for one of another
    /// size than labels.png, [`Error::Regions`] unless motion.json describes regions 0, 1, … once each, and all that
    /// labels.png has.
    pub fn read(&self) -> Result<Interpretation, Error> {
        let labels = png::read_labels(self.labels, "labels.png")?;
        let (width, height) = (labels.width(), labels.height());
        let motions = motions_of(&MotionFile::read(self.motion)?, Some(&labels))?;
        let occluded = match self.occlusion {
            Some(bytes) => png::read_labels(bytes, "occlusion.png")?,
            None => Grid::new(width, height, 0),
        };
        let depth = pfm::read(self.depth, "depth.pfm")?;
        let flow = flo::read(self.flow, "flow.flo")?;
        alike(&labels, &depth, "depth.pfm")?;
        alike(&labels, &flow.u, "flow.flo")?;
        alike(&labels, &occluded, "occlusion.png")?;
        let travels = |k: u8| motions[usize::from(k)].translation.length() > 0.0;
        Ok(Interpretation {
            camera: Camera::centred(width as f64, width, height)?,
            confidence: labels.map(|k| f32::from(travels(k))),
            labels,
            depth,
            flow,
            occluded,
            motions,
        })
    }
}

/// The motions of the regions in the order of their labels.
pub(super) fn motions_of(
    file: &MotionFile,
    labels: Option<&Grid<u8>>,
) -> Result<Vec<RigidMotion>, Error> {
    let regions = ordered(file.regions.clone(), |region| f64::from(region.label));
    let numbered = regions
        .iter()
        .enumerate()
        .all(|(k, region)| usize::from(region.label) == k);
    let last = labels
        .and_then(|labels| labels.data().iter().copied().max())
        .unwrap_or(0);
    if !numbered || regions.len() <= usize::from(last) {
        return Err(Error::Regions {
            described: file.regions.iter().map(|region| region.label).collect(),
            last,
        });
    }
    Ok(regions.iter().map(|region| region.motion()).collect())
}

fn alike<T: Copy>(labels: &Grid<u8>, it: &Grid<T>, name: &'static str) -> Result<(), Error> {
    if it.same_size(labels) {
        return Ok(());
    }
    Err(Error::FilesDiffer {
        name,
        size: (it.width(), it.height()),
        than: "labels.png",
        expected: (labels.width(), labels.height()),
    })
}
