//! Whatever there is of a result: flow alone, labels alone, or all of it.

use super::motion::MotionFile;
use super::result::motions_of;
use super::{depth16, flo, kitti, pfm, png};
use crate::camera::{Camera, RigidMotion};
use crate::error::Error;
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};

/// The parts of a result that are known; all grids have one size.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parts {
    /// 0 where the background is seen, k inside the k-th curve.
    pub labels: Option<Grid<u8>>,
    /// Z, not above 0 where unknown.
    pub depth: Option<Grid<f32>>,
    /// Where each pixel goes.
    pub flow: Option<Flow>,
    /// 1 where a pixel's point is hidden in the second frame.
    pub occluded: Option<Grid<u8>>,
    /// How far depth is observable, 0–1.
    pub confidence: Option<Grid<f32>>,
    /// The motion of each region, in the order of labels.
    pub motions: Option<Vec<RigidMotion>>,
}

impl From<&Interpretation> for Parts {
    fn from(all: &Interpretation) -> Self {
        Self {
            labels: Some(all.labels.clone()),
            depth: Some(all.depth.clone()),
            flow: Some(all.flow.clone()),
            occluded: Some(all.occluded.clone()),
            confidence: Some(all.confidence.clone()),
            motions: Some(all.motions.clone()),
        }
    }
}

impl Parts {
    /// Reads what there is among `files`, names and contents: labels.png, depth.pfm or a 16-bit depth.png, disparity.pfm or
    /// disparity.png (1/Z), flow.flo or KITTI's flow.png, occlusion.png and motion.json. Others are left alone;
    /// [`kind_of`](super::kind::kind_of) tells what a file of another name is.
    ///
    /// # Errors
    /// [`Error::File`] and [`Error::Json`] for a file that is none of its kind, [`Error::FilesDiffer`] for two of different
    /// sizes, [`Error::Regions`] as [`super::result::ResultFiles::read`] has it, [`Error::NothingToScore`] when there is
    /// none.
    pub fn read(files: &[(String, Vec<u8>)]) -> Result<Self, Error> {
        let file = |name: &str| {
            let found = files.iter().find(|(own, _)| own == name);
            found.map(|(_, bytes)| bytes.as_slice())
        };
        let labels = file("labels.png").map(|bytes| png::read_labels(bytes, "labels.png"));
        let labels = labels.transpose()?;
        let motions = file("motion.json").map(|bytes| {
            let text = String::from_utf8_lossy(bytes);
            motions_of(&MotionFile::read(&text)?, labels.as_ref())
        });
        let flow = match (file("flow.flo"), file("flow.png")) {
            (Some(bytes), _) => Some(flo::read(bytes, "flow.flo")?),
            (None, Some(bytes)) => Some(kitti::read(bytes, "flow.png")?),
            (None, None) => None,
        };
        let occluded = file("occlusion.png").map(|bytes| png::read_labels(bytes, "occlusion.png"));
        let pfm = |name| file(name).map(|bytes| pfm::read(bytes, name)).transpose();
        let png = |name| {
            file(name)
                .map(|bytes| depth16::read(bytes, name))
                .transpose()
        };
        let depth = pfm("depth.pfm")?
            .or(png("depth16.png")?)
            .or(png("depth.png")?);
        let disparity = pfm("disparity.pfm")?.or(png("disparity.png")?);
        let mut parts = Self {
            depth: depth.or(disparity.map(|grid| grid.map(f32::recip))),
            occluded: occluded.transpose()?,
            motions: motions.transpose()?,
            confidence: None,
            labels,
            flow,
        };
        parts.check()?;
        // Depth shows only where something travels; files do not say how far.
        if let (Some(labels), Some(motions)) = (&parts.labels, &parts.motions) {
            let travels = |k: u8| motions[usize::from(k)].translation.length() > 0.0;
            parts.confidence = Some(labels.map(|k| f32::from(travels(k))));
        }
        Ok(parts)
    }

    /// All of it as an interpretation of a frame of `width`×`height`, to be drawn: what is not known has confidence 0 or is
    /// not a number, and all is background where there are no labels.
    ///
    /// # Errors
    /// [`Error::TruthSize`] when it is of another size.
    pub fn filled(&self, width: usize, height: usize) -> Result<Interpretation, Error> {
        if let Some(truth) = self.size().filter(|&size| size != (width, height)) {
            let frames = (width, height);
            return Err(Error::TruthSize { truth, frames });
        }
        let grid = |value: f32| Grid::new(width, height, value);
        let labels = self.labels.clone();
        let labels = labels.unwrap_or_else(|| Grid::new(width, height, 0));
        let regions = 1 + usize::from(labels.data().iter().copied().max().unwrap_or(0));
        let depth = self.depth.clone().unwrap_or_else(|| grid(f32::NAN));
        let shows = |z: f32, c: f32| if z.is_finite() && z > 0.0 { c } else { 0.0 };
        let confidence = Grid::from_fn(width, height, |x, y| {
            let c = self.confidence.as_ref().map_or(1.0, |c| c[(x, y)]);
            shows(depth[(x, y)], c)
        });
        let flow = self.flow.clone();
        Ok(Interpretation {
            camera: Camera::centred(width as f64, width, height)?,
            flow: flow.unwrap_or_else(|| Flow {
                u: grid(f32::NAN),
                v: grid(f32::NAN),
            }),
            occluded: (self.occluded.clone()).unwrap_or_else(|| Grid::new(width, height, 0)),
            motions: (self.motions.clone())
                .unwrap_or_else(|| vec![RigidMotion::default(); regions]),
            labels,
            depth,
            confidence,
        })
    }

    /// Width and height of all that there is, `None` where that is motions alone.
    pub fn size(&self) -> Option<(usize, usize)> {
        self.sizes().next().map(|(_, size)| size)
    }

    fn sizes(&self) -> impl Iterator<Item = (&'static str, (usize, usize))> {
        let bytes = |grid: &Option<Grid<u8>>| grid.as_ref().map(|g| (g.width(), g.height()));
        let depth = self.depth.as_ref().map(|g| (g.width(), g.height()));
        let flow = self.flow.as_ref().map(|f| (f.u.width(), f.u.height()));
        let all = [
            ("labels.png", bytes(&self.labels)),
            ("flow", flow),
            ("depth", depth),
            ("occlusion.png", bytes(&self.occluded)),
        ];
        all.into_iter()
            .filter_map(|(name, size)| Some((name, size?)))
    }

    fn check(&self) -> Result<(), Error> {
        let mut sizes = self.sizes();
        let Some((first, size)) = sizes.next() else {
            return match self.motions {
                Some(_) => Ok(()),
                None => Err(Error::NothingToScore),
            };
        };
        match sizes.find(|(_, other)| *other != size) {
            None => Ok(()),
            Some((name, other)) => Err(Error::FilesDiffer {
                name,
                size: other,
                than: first,
                expected: size,
            }),
        }
    }
}
