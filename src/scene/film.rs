//! More than two frames of one scene: every body's rigid motion applied again from frame to frame.
//!
//! ```text
//! P_{n+1} = R(ω) P_n + T        in the camera's coordinates, the same T and ω each time
//! ```
//!
//! The first two frames of a film are those of the sequence of the same name.

use super::cast::{Caster, Moment};
use super::stage::Stage;
use super::variant::Drawn;
use super::{Draw, Entry, Sequence, camera, entry, truth};
use crate::camera::Camera;
use crate::curves::Shape;
use crate::error::Error;
use crate::frames::Frame;
use crate::interpretation::Interpretation;

/// Frames that a film can have.
const MOST_FRAMES: usize = 100;

/// Frames of one scene, the curves to start from, and the truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// The frames, 8 bits per channel; two at least.
    pub frames: Vec<Frame>,
    /// One circle per moving object of the first frame, as in [`Sequence::curves`].
    pub curves: Vec<Shape>,
    /// Entry i is the truth about frames i and i + 1, so there is one fewer than frames.
    pub truths: Vec<Interpretation>,
}

/// Renders `frames` frames (2–100) of the built-in sequence `name` at `width × height` pixels.
///
/// # Errors
/// Those of [`render`](super::render()), and [`Error::Count`] for another number of frames.
pub fn render_film(name: &str, width: usize, height: usize, frames: usize) -> Result<Film, Error> {
    let stage = (entry(name)?.stage)();
    let camera = camera(name, width, height)?;
    Film::of(&stage, camera, [width, height], frames, |_| {})
}

/// Renders `frames` frames (2–100) of what [`variant`](super::variant()) renders two frames of.
///
/// # Errors
/// Those of [`variant`](super::variant()), and [`Error::Count`] for another number of frames.
pub fn variant_film(draw: &Draw<'_>, frames: usize) -> Result<Film, Error> {
    Drawn::new(draw)?.film(frames)
}

impl Film {
    /// Films `stage`; `finish` changes each picture before it becomes a frame, in order.
    pub(super) fn of(
        stage: &Stage,
        camera: Camera,
        size: [usize; 2],
        frames: usize,
        mut finish: impl FnMut(&mut Vec<[f32; 3]>),
    ) -> Result<Self, Error> {
        if !(2..=MOST_FRAMES).contains(&frames) {
            return Err(Error::Count {
                key: "frames".to_owned(),
                value: frames.to_string(),
                min: 2.0,
                max: MOST_FRAMES as f64,
            });
        }
        let [width, height] = size;
        let shoot = |moment| {
            let mut picture = Caster::new(stage, camera, Moment(moment)).picture(width, height);
            finish(&mut picture);
            Frame::from_colours(width, height, &picture)
        };
        let shot: Vec<Frame> = (0..frames).map(shoot).collect();
        let known = |moment| truth::truth(stage, camera, Moment(moment), size);
        let truths: Vec<Interpretation> = (0..frames - 1).map(known).collect();
        Ok(Self {
            frames: shot,
            curves: truth::curves(&truths[0].labels, stage.motions.len()),
            truths,
        })
    }

    /// A film of two frames as the sequence that `entry` describes.
    pub(super) fn sequence(mut self, entry: &Entry) -> Sequence {
        Sequence {
            name: entry.name.to_owned(),
            title: entry.title.to_owned(),
            lesson: entry.lesson.to_owned(),
            frames: [self.frames.remove(0), self.frames.remove(0)],
            curves: self.curves,
            truth: self.truths.remove(0),
        }
    }
}
