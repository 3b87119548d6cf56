//! Sequences that others recorded or rendered and that are not part of the project: where each one's
//! files are, what camera took it, and what is known of it.

use std::fs;
use std::path::{Path, PathBuf};

use relievo::file::{flo, pfm, png};
use relievo::init::focal_length;
use relievo::{Camera, Flow, Frame, FramePair, Grid, Interpretation, RigidMotion, Shape};

use crate::Failure;

/// Where the files of a sequence are and what they do not say themselves.
pub struct Recorded {
    /// What it is called.
    pub name: &'static str,
    folder: &'static str,
    frames: [&'static str; 2],
    focal: f64,
    /// Whether f is looked for, `focal` being a guess.
    find: bool,
    /// The frame's middle where none is given.
    centre: Option<[f64; 2]>,
    curve: Curve,
    /// How many things move by themselves.
    pub bodies: usize,
    flow: Option<&'static str>,
    depth: Option<&'static str>,
    labels: Option<&'static str>,
    /// T and, in degrees per frame, ω of each region, where they are known.
    motions: &'static [[[f64; 3]; 2]],
}

/// Where its curve comes from.
enum Curve {
    None,
    Circle([f64; 3]),
    /// Left, top, right and bottom.
    Box([f64; 4]),
    /// A circle in the middle of what is labelled 1, with a third of its area.
    Labelled,
}

/// A sequence, read.
pub struct Reading {
    /// The two frames.
    pub frames: [Frame; 2],
    /// Where to start.
    pub curves: Vec<Shape>,
    /// What is known of the first frame; flow and depth are not a number where they are not.
    pub truth: Interpretation,
    /// Whether labels are known; otherwise all are 0.
    pub labelled: bool,
    /// Whether motions are known; otherwise all are none.
    pub moved: bool,
}

/// All of them.
pub static RECORDED: [Recorded; 12] = [
    // The clouds are not rigid, and their flow not known; a curve around them leaves the ground to itself.
    Recorded {
        frames: ["frame09.png", "frame10.png"],
        curve: Curve::Box([4.0, 4.0, 312.0, 50.0]),
        flow: Some("flow09.flo"),
        ..plain("yosemite", 337.0)
    },
    // A ball rolls before a carpet that turns about the optical axis.
    Recorded {
        centre: Some([225.0, 225.0]),
        curve: Curve::Labelled,
        bodies: 1,
        flow: Some("flow0.flo"),
        depth: Some("depth0.pfm"),
        labels: Some("labels0.png"),
        motions: &[
            [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0]],
            [[13.08, -0.34, 0.11], [0.0, -1.5, -3.0]],
        ],
        ..plain("carpetball", 389.71)
    },
    Recorded {
        frames: ["frame10.png", "frame11.png"],
        flow: Some("flow10.flo"),
        ..plain("venus", 420.0)
    },
    // Its focal length is not known. The frames are cut from a rectified pair, so that far points move to the
    // left: through f = 420 no rigid motion with all depth before the camera comes closer than 0.31 px.
    Recorded {
        name: "venus, f found",
        frames: ["frame10.png", "frame11.png"],
        find: true,
        flow: Some("flow10.flo"),
        ..plain("venus", 420.0)
    },
    // A cube on a turntable, one body.
    Recorded {
        frames: ["frame00.png", "frame01.png"],
        curve: Curve::Circle([126.0, 150.0, 48.0]),
        bodies: 1,
        ..plain("rubic", 300.0)
    },
    Recorded {
        frames: ["frame10.png", "frame11.png"],
        ..plain("translation_sphere", 256.0)
    },
    // From here on f is not known but for two; the frame's longer side is taken. Static scenes first.
    Recorded {
        frames: ["frame10.png", "frame11.png"],
        flow: Some("flow10.flo"),
        ..plain("motorcycle", 397.0)
    },
    Recorded {
        frames: ["frame10.png", "frame11.png"],
        flow: Some("flow10.flo"),
        ..plain("urban3", 640.0)
    },
    Recorded {
        frames: ["frame10.png", "frame11.png"],
        centre: Some([304.0, 86.0]),
        flow: Some("flow10.flo"),
        ..plain("kitti74", 359.4)
    },
    Recorded {
        frames: ["frame09.png", "frame13.png"],
        ..plain("cokecan", 300.0)
    },
    // Things that move by themselves: six; a girl whose camera follows her.
    Recorded {
        frames: ["frame10.png", "frame11.png"],
        bodies: 6,
        flow: Some("flow10.flo"),
        ..plain("rubberwhale", 584.0)
    },
    Recorded {
        frames: ["frame02.png", "frame03.png"],
        bodies: 1,
        flow: Some("flow02.flo"),
        ..plain("alley", 410.0)
    },
];

const fn plain(name: &'static str, focal: f64) -> Recorded {
    Recorded {
        name,
        folder: name,
        frames: ["frame0.png", "frame1.png"],
        focal,
        find: false,
        centre: None,
        curve: Curve::None,
        bodies: 0,
        flow: None,
        depth: None,
        labels: None,
        motions: &[],
    }
}

impl Recorded {
    /// The files of both frames and of the true flow, where that is known.
    pub fn files(&self, data: &Path) -> Option<[PathBuf; 3]> {
        let [first, second] = self.frames;
        let file = |name: &str| data.join(self.folder).join(name);
        self.flow.map(|flow| [first, second, flow].map(file))
    }

    /// Reads it from its folder inside `data`.
    pub fn read(&self, data: &Path) -> Result<Reading, Failure> {
        let file = |name: &str| {
            let path = data.join(self.folder).join(name);
            fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))
        };
        let frame = |name| Ok::<_, Failure>(Frame::decode(&file(name)?, name)?);
        let [first, second] = self.frames;
        let frames = [frame(first)?, frame(second)?];
        let (width, height) = (frames[0].width(), frames[0].height());
        let unknown = Grid::new(width, height, f32::NAN);
        let labels = match self.labels {
            Some(name) => png::read_labels(&file(name)?, name)?,
            None => Grid::new(width, height, 0),
        };
        let flow = match self.flow {
            Some(name) => flo::read(&file(name)?, name)?,
            None => Flow {
                u: unknown.clone(),
                v: unknown.clone(),
            },
        };
        let depth = match self.depth {
            Some(name) => pfm::read(&file(name)?, name)?,
            None => unknown,
        };
        let curves: Vec<Shape> = self.curve.shape(&labels).into_iter().collect();
        let motions = match self.motions {
            [] => vec![RigidMotion::default(); curves.len() + 1],
            known => known.iter().copied().map(motion).collect(),
        };
        let translates = |label: u8| {
            let motion: Option<&RigidMotion> = motions.get(usize::from(label));
            motion.is_some_and(|m| m.translation.length() > 0.0)
        };
        let mut camera = match self.centre {
            Some([cx, cy]) => Camera::new(self.focal, cx, cy)?,
            None => Camera::centred(self.focal, width, height)?,
        };
        if self.find {
            let [first, second] = frames.clone();
            let found = focal_length(&FramePair::new(first, second)?, &camera);
            camera.focal = found.map_or(self.focal, |found| found.focal);
        }
        let truth = Interpretation {
            camera,
            confidence: labels.map(|label| f32::from(u8::from(translates(label)))),
            occluded: Grid::new(width, height, 0),
            labels,
            depth,
            flow,
            motions,
        };
        Ok(Reading {
            frames,
            curves,
            truth,
            labelled: self.labels.is_some(),
            moved: !self.motions.is_empty(),
        })
    }
}

impl Curve {
    fn shape(&self, labels: &Grid<u8>) -> Option<Shape> {
        match *self {
            Self::None => None,
            Self::Circle([x, y, r]) => Some(Shape::Circle { x, y, r }),
            Self::Box([left, top, right, bottom]) => Some(Shape::Polygon {
                points: vec![[left, top], [right, top], [right, bottom], [left, bottom]],
            }),
            Self::Labelled => Some(middle(labels)),
        }
    }
}

fn middle(labels: &Grid<u8>) -> Shape {
    let (mut n, mut x, mut y) = (0.0_f64, 0.0, 0.0);
    for (i, _) in labels.data().iter().enumerate().filter(|(_, l)| **l == 1) {
        n += 1.0;
        x += (i % labels.width()) as f64;
        y += (i / labels.width()) as f64;
    }
    Shape::Circle {
        x: x / n,
        y: y / n,
        r: (n / (3.0 * std::f64::consts::PI)).sqrt(),
    }
}

fn motion([translation, degrees]: [[f64; 3]; 2]) -> RigidMotion {
    RigidMotion {
        translation: translation.into(),
        rotation: degrees.map(f64::to_radians).into(),
    }
}
