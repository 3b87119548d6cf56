//! The ray caster: which surface a pixel of a frame shows.
//!
//! Rays start at the camera, the origin of every frame; bodies are where the moment has them. What is seen is coloured in
//! `shade.rs` and made a picture of in `picture.rs`.

use glam::{DMat3, DVec3};

use super::shade::lamp_directions;
use super::stage::{Part, Stage};
use crate::camera::Camera;

/// Depth of what no ray meets.
const FAR: f64 = 1000.0;

/// The moment of a frame: 0 for the first. Body k is where `motions[k]`, applied so many times, takes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moment(pub usize);

impl Moment {
    /// That of the first frame, in which a stage is described.
    pub const FIRST: Self = Self(0);
}

/// What a ray meets.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Depth Z at that moment.
    pub depth: f64,
    /// The body, which is also the label.
    pub body: usize,
    /// Which part of the stage; the largest number where no ray meets any.
    pub(super) part: usize,
    /// The outward normal in that part's frame.
    pub(super) normal: DVec3,
}

/// A stage at one moment, ready for rays.
pub struct Caster<'a> {
    pub(super) stage: &'a Stage,
    pub(super) camera: Camera,
    pub(super) bodies: Vec<Place>,
    /// Bounding spheres at that moment.
    pub(super) bounds: Vec<(DVec3, f64)>,
    /// Directions towards the lamp's disc.
    pub(super) lamps: Vec<DVec3>,
}

/// A body's place at a moment: P ↦ rotation · P + shift takes it there from the first frame.
pub(super) struct Place {
    rotation: DMat3,
    pub(super) back: DMat3,
    shift: DVec3,
}

impl Place {
    pub(super) fn to_first(&self, p: DVec3) -> DVec3 {
        self.back * (p - self.shift)
    }
}

impl<'a> Caster<'a> {
    /// Sets `stage` to `moment`.
    pub fn new(stage: &'a Stage, camera: Camera, moment: Moment) -> Self {
        let bodies: Vec<Place> = stage
            .motions
            .iter()
            .map(|motion| {
                let (mut rotation, mut shift) = (DMat3::IDENTITY, DVec3::ZERO);
                for _ in 0..moment.0 {
                    rotation = motion.matrix() * rotation;
                    shift = motion.matrix() * shift + motion.translation;
                }
                Place {
                    rotation,
                    back: rotation.transpose(),
                    shift,
                }
            })
            .collect();
        let bounds = stage
            .parts
            .iter()
            .map(|part| {
                let body = &bodies[part.body];
                (
                    body.rotation * part.pose.centre + body.shift,
                    part.solid.bound(),
                )
            })
            .collect();
        Self {
            stage,
            camera,
            bodies,
            bounds,
            lamps: lamp_directions(stage),
        }
    }

    /// The nearest surface that the ray through pixel `(px, py)` meets; the far background when none.
    pub fn look(&self, px: f64, py: f64) -> Seen {
        self.look_beyond(px, py, 0.0)
    }

    /// The same, told that terrain is no nearer than depth `from`.
    pub(super) fn look_beyond(&self, px: f64, py: f64, from: f64) -> Seen {
        let d = self.camera.ray(px, py);
        let d2 = d.length_squared();
        let mut seen = Seen {
            depth: FAR,
            body: 0,
            part: usize::MAX,
            normal: -d,
        };
        for (i, part) in self.stage.parts.iter().enumerate() {
            let (c, r) = self.bounds[i];
            let along = c.dot(d);
            if r.is_finite() && (c.length_squared() - r * r) * d2 > along * along {
                continue;
            }
            let body = &self.bodies[part.body];
            let (o, d) = (body.to_first(DVec3::ZERO), body.back * d);
            let (o, d) = to_part(part, o, d);
            if let Some(hit) = part.solid.hit(o, d, from)
                && hit.t < seen.depth
            {
                seen = Seen {
                    depth: hit.t,
                    body: part.body,
                    part: i,
                    normal: hit.normal,
                };
            }
        }
        seen
    }
}

/// A ray of the first frame in the frame of `part`.
pub(super) fn to_part(part: &Part, o: DVec3, d: DVec3) -> (DVec3, DVec3) {
    let back = part.pose.rotation.transpose();
    (back * (o - part.pose.centre), back * d)
}
