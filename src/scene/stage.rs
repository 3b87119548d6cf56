//! A scene as data: solids in their places, made of something, each part of a rigid body; lights;
//! how each body moves.
//!
//! Everything is given in the camera's coordinates of the first frame: x right, y **down**, Z
//! forward. Body k is label k, body 0 the background. Between the frames a point P of body k goes to
//! R(ω) P + T, `motions[k]`.

use glam::{DMat3, DVec3};

use super::solid::Solid;
use super::texture::Texture;
use crate::camera::RigidMotion;

/// Where a frame of reference lies in another: P ↦ rotation · P + centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Its axes.
    pub rotation: DMat3,
    /// Its origin.
    pub centre: DVec3,
}

/// A solid in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its shape.
    pub solid: Solid,
    /// Where it is in the first frame.
    pub pose: Pose,
    /// What it is made of.
    pub material: Material,
    /// The rigid body it belongs to.
    pub body: usize,
}

impl Part {
    /// Brings it `times` nearer along its line of sight, so that it looks as before.
    pub fn bring_nearer(&mut self, times: f64) {
        let share = times.recip();
        self.pose.centre *= share;
        self.solid = self.solid.clone().scaled(share);
        self.material.texture.scale *= share;
    }
}

/// What a surface looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Its colour throughout.
    pub texture: Texture,
    /// Strength of the highlight, 0 for chalk.
    pub shine: f64,
    /// Blinn's exponent: larger is smoother.
    pub gloss: f64,
}

/// A distant lamp that casts shadows, light from the sky, and a weak second lamp that casts none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Direction towards the lamp, unit length.
    pub lamp: DVec3,
    /// Its light, per channel.
    pub lamp_colour: DVec3,
    /// Its radius as seen from the scene, in radians: how soft shadows are.
    pub softness: f64,
    /// Direction towards the second lamp, unit length.
    pub fill: DVec3,
    /// Its light.
    pub fill_colour: DVec3,
    /// Light from everywhere.
    pub ambient: DVec3,
    /// Direction from which most of it comes, unit length.
    pub up: DVec3,
}

/// What becomes of a shadow that one body casts on another when they move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shadows {
    /// It moves with the body that casts it, as real ones do.
    Cast,
    /// It stays as in the first frame, painted on the body that receives it, so that brightness is
    /// constant along the true motion.
    Painted,
}

/// A scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// All solids of all bodies.
    pub parts: Vec<Part>,
    /// How each body moves, the background first.
    pub motions: Vec<RigidMotion>,
    /// What lights it.
    pub light: Light,
    /// Its shadows.
    pub shadows: Shadows,
    /// Haze: how much light is lost per unit of distance, and the colour that replaces it.
    pub haze: (f64, DVec3),
}

// Stages are built once: what they are put together with is not compiled anew for each part.
impl Pose {
    /// Upright at `centre`.
    pub fn at(x: f64, y: f64, z: f64) -> Self {
        Self {
            rotation: DMat3::IDENTITY,
            centre: DVec3::new(x, y, z),
        }
    }

    /// The ground as a camera sees it that looks down on it by `pitch` radians, its axis meeting the
    /// ground at `distance`. Ground coordinates: x right, y into the ground, z away.
    #[inline(never)]
    pub fn ground(pitch: f64, distance: f64) -> Self {
        Self {
            rotation: DMat3::from_rotation_x(pitch),
            centre: DVec3::new(0.0, 0.0, distance),
        }
    }

    /// A wall that faces the camera at depth `distance`, turned by `yaw` about the vertical: the
    /// ground stood upright.
    #[inline(never)]
    pub fn wall(distance: f64, yaw: f64) -> Self {
        Self {
            rotation: DMat3::from_rotation_y(yaw)
                * DMat3::from_rotation_x(std::f64::consts::FRAC_PI_2),
            centre: DVec3::new(0.0, 0.0, distance),
        }
    }

    /// Turned about its own origin by `rotation`.
    #[inline(never)]
    pub fn turned(self, rotation: DMat3) -> Self {
        Self {
            rotation: self.rotation * rotation,
            ..self
        }
    }

    /// This pose, given in the frame of `outer`, seen from where `outer` is given.
    #[inline(never)]
    pub fn within(self, outer: Pose) -> Self {
        Self {
            rotation: outer.rotation * self.rotation,
            centre: outer.point(self.centre),
        }
    }

    /// A point of this frame, seen from outside.
    pub fn point(&self, local: DVec3) -> DVec3 {
        self.rotation * local + self.centre
    }

    /// A direction of this frame, seen from outside.
    pub fn direction(&self, local: DVec3) -> DVec3 {
        self.rotation * local
    }
}

impl Material {
    /// Without highlight.
    pub fn matt(texture: Texture) -> Self {
        Self {
            texture,
            shine: 0.0,
            gloss: 1.0,
        }
    }

    /// With a highlight of strength `shine` and exponent `gloss`.
    pub fn shiny(texture: Texture, shine: f64, gloss: f64) -> Self {
        Self {
            texture,
            shine,
            gloss,
        }
    }
}

impl Light {
    /// Warm lamp at `lamp`, cool sky from `up` and a weak lamp from the other side.
    #[inline(never)]
    pub fn daylight(lamp: DVec3, up: DVec3, softness: f64) -> Self {
        let lamp = lamp.normalize();
        let side = (lamp - 2.0 * lamp.dot(DVec3::X) * DVec3::X).normalize();
        Self {
            lamp,
            lamp_colour: DVec3::new(1.0, 0.94, 0.84) * 0.95,
            softness,
            fill: side,
            fill_colour: DVec3::new(0.75, 0.85, 1.0) * 0.16,
            ambient: DVec3::new(0.86, 0.93, 1.0) * 0.3,
            up: up.normalize(),
        }
    }
}

/// The motion of a body that turns by `rotation` about its point `centre` and moves by `shift`:
/// T = c − R c + shift.
#[inline(never)]
pub fn turn(centre: DVec3, rotation: DVec3, shift: DVec3) -> RigidMotion {
    let about_camera = RigidMotion {
        translation: DVec3::ZERO,
        rotation,
    };
    RigidMotion {
        translation: centre - about_camera.apply(centre) + shift,
        rotation,
    }
}

/// The motion of a body that moves by `shift` without turning.
pub fn slide(shift: DVec3) -> RigidMotion {
    RigidMotion {
        translation: shift,
        rotation: DVec3::ZERO,
    }
}
