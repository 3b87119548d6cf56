//! motion.json: what moves how, and how the solver came to it.
//!
//! T is in units in which the region's mean 1/Z is 1, per frame; ω in radians per frame.

use serde::{Deserialize, Deserializer, Serialize};

use crate::camera::RigidMotion;
use crate::error::Error;
use crate::json;
use crate::motion_model::MotionModel;

/// The contents of motion.json.
///
/// ```
/// use relievo::file::motion::{MotionFile, RegionMotion};
/// use relievo::{MotionModel, RigidMotion};
///
/// let models = [MotionModel::Still, MotionModel::Translation];
/// let moves = RigidMotion { translation: [0.1, 0.0, 0.0].into(), ..Default::default() };
/// let file = MotionFile {
///     regions: RegionMotion::list(&[RigidMotion::default(), moves], &models),
///     status: "converged".to_owned(),
///     ..Default::default()
/// };
/// let read = MotionFile::read(&file.write())?;
/// assert_eq!(read.regions[1].motion(), moves);
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MotionFile {
    /// Every region, the background first.
    pub regions: Vec<RegionMotion>,
    /// running, converged, exhausted or diverged.
    pub status: String,
    /// Passes made.
    pub iterations: usize,
    /// Total energy after each pass; null, and read as not a number, where it was not finite.
    #[serde(deserialize_with = "or_nan")]
    pub energy: Vec<f64>,
    /// Where the time went.
    pub seconds: Seconds,
    /// Levels of depth16.png per unit of Z, where there is such a file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth_scale: Option<f64>,
}

/// The motion of one region.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RegionMotion {
    /// 0 for the background, k for the k-th curve.
    pub label: u8,
    /// T = (t1, t2, t3).
    pub translation: [f64; 3],
    /// ω = (w1, w2, w3).
    pub rotation: [f64; 3],
    /// The motion model; files of others may not say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<MotionModel>,
    /// False where no rigid motion fits the region, and T and ω mean nothing; not written otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rigid: Option<bool>,
}

/// Seconds spent, in all and in each of the three steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// All passes.
    pub total: f64,
    /// Step 1.
    pub motion: f64,
    /// Step 2.
    pub depth: f64,
    /// Step 3.
    pub curves: f64,
}

impl RegionMotion {
    /// The motions of regions 0, 1, … and their models as entries.
    pub fn list(motions: &[RigidMotion], models: &[MotionModel]) -> Vec<Self> {
        let regions = (0..).zip(motions.iter().zip(models));
        let entry = |(label, (motion, model)): (u8, (&RigidMotion, &MotionModel))| Self {
            label,
            translation: motion.translation.to_array(),
            rotation: motion.rotation.to_array(),
            model: Some(*model),
            rigid: None,
        };
        regions.map(entry).collect()
    }

    /// The motion itself.
    pub fn motion(&self) -> RigidMotion {
        RigidMotion {
            translation: self.translation.into(),
            rotation: self.rotation.into(),
        }
    }
}

impl MotionFile {
    /// The text of the file. Numbers that are not finite become null, as JSON has no others.
    pub fn write(&self) -> String {
        serde_json::to_string_pretty(self).expect("plain numbers and text always serialise") + "\n"
    }

    /// Reads the text of such a file.
    ///
    /// # Errors
    /// [`Error::Json`] for anything else.
    pub fn read(text: &str) -> Result<Self, Error> {
        json::read(text, "motion.json")
    }
}

fn or_nan<'de, D: Deserializer<'de>>(numbers: D) -> Result<Vec<f64>, D::Error> {
    let read = Vec::<Option<f64>>::deserialize(numbers)?;
    Ok(read.into_iter().map(|n| n.unwrap_or(f64::NAN)).collect())
}
