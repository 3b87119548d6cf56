//! What `render.rs` wrote, read again.

use std::fs;
use std::path::Path;

use relievo::file::flo;
use relievo::{Camera, Error, Flow, Frame, FramePair, Grid, Shape};
use serde::Deserialize;

use crate::Failure;

/// Three frames, and what to start from.
pub struct Sequence {
    /// The frames.
    pub frames: [Frame; 3],
    /// What they were seen with.
    pub camera: Camera,
    /// Circles in the first frame.
    pub curves: Vec<Shape>,
}

/// The truth about two frames.
pub struct Truth {
    /// Labels.
    pub labels: Grid<u8>,
    /// Image motion.
    pub flow: Flow,
}

/// `scene.json`.
#[derive(Deserialize)]
struct About {
    width: usize,
    height: usize,
    camera: CameraJson,
    curves: Vec<Shape>,
}

#[derive(Deserialize)]
struct CameraJson {
    focal: f64,
    cx: f64,
    cy: f64,
}

impl Sequence {
    /// Reads the frames in `folder`.
    pub fn read(folder: &Path) -> Result<Self, Failure> {
        let about = About::read(folder)?;
        let frame = |i: usize| -> Result<Frame, Failure> {
            let bytes = fs::read(folder.join(format!("frame{i}.rgba")))?;
            Ok(Frame::from_rgba8(about.width, about.height, &bytes)?)
        };
        let CameraJson { focal, cx, cy } = about.camera;
        Ok(Self {
            frames: [frame(0)?, frame(1)?, frame(2)?],
            camera: Camera::new(focal, cx, cy)?,
            curves: about.curves,
        })
    }

    /// The first two frames.
    pub fn pair(&self) -> Result<FramePair, Error> {
        FramePair::new(self.frames[0].clone(), self.frames[1].clone())
    }
}

impl Truth {
    /// Reads the truth about frames `i` and `i` + 1 in `folder`.
    pub fn read(folder: &Path, i: usize) -> Result<Self, Failure> {
        let About { width, height, .. } = About::read(folder)?;
        let labels = fs::read(folder.join(format!("labels{i}.u8")))?;
        let name = format!("flow{i}.flo");
        Ok(Self {
            labels: Grid::from_vec(width, height, labels)?,
            flow: flo::read(&fs::read(folder.join(&name))?, &name)?,
        })
    }
}

impl About {
    fn read(folder: &Path) -> Result<Self, Failure> {
        Ok(serde_json::from_slice(&fs::read(
            folder.join("scene.json"),
        )?)?)
    }
}
