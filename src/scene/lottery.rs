//! A scene drawn at random: shapes, places, textures, lamp, and which way everything moves.

use glam::{DMat3, DVec3};

use super::dice::Dice;
use super::solid::Solid;
use super::stage::{Light, Material, Part, Pose, Shadows, Stage, turn};
use super::texture::{Pattern, Texture};
use crate::camera::RigidMotion;

/// A motion whose size is still open: a turn about `centre` with a shift.
#[derive(Clone, Copy, Default)]
pub struct Course {
    /// A point on the axis.
    pub centre: DVec3,
    /// The turn.
    pub rotation: DVec3,
    /// The shift.
    pub shift: DVec3,
    /// Share of the largest displacement that its fastest pixel covers.
    pub pace: f64,
}

impl Course {
    /// The motion of that size.
    pub fn motion(&self, size: f64) -> RigidMotion {
        turn(self.centre, self.rotation * size, self.shift * size)
    }
}

/// A scene whose bodies do not move yet, and how they shall: two blocks, or three or four bodies of several
/// kinds, which turn.
pub fn draw(dice: &mut Dice, bodies: usize) -> (Stage, Vec<Course>) {
    let many = bodies > 2;
    let apart = match bodies {
        2 => 2.3,
        3 => 1.75,
        _ => 1.5,
    };
    let ground = Pose::ground(
        dice.between(0.5, 0.85) - if many { 0.1 } else { 0.0 },
        dice.between(6.2, 7.2),
    );
    let floor = texture(dice);
    let mut parts = vec![Part {
        solid: Solid::Floor,
        pose: ground,
        material: Material::matt(floor),
        body: 0,
    }];
    // Beyond the floor a wall, so that no horizon shows.
    parts.push(Part {
        pose: Pose::at(0.0, 0.0, dice.between(3.6, 5.0))
            .turned(DMat3::from_rotation_x(std::f64::consts::FRAC_PI_2))
            .within(ground),
        material: Material::matt(texture(dice)),
        ..parts[0].clone()
    });
    let alike = !many && dice.chance(0.6);
    for body in 1..=bodies {
        let own = texture(dice);
        let texture = if alike {
            Texture {
                seed: own.seed,
                ..floor
            }
        } else {
            own
        };
        let slot = body as f64 - 0.5 * (bodies + 1) as f64;
        let x = slot * apart + dice.between(-0.3, 0.3);
        let z = dice.between(-1.0, 0.9);
        let part = object(dice, body, many, x, z, texture);
        parts.push(Part {
            pose: part.pose.within(ground),
            ..part
        });
    }
    let courses = courses(dice, ground, &parts, bodies, many);
    let lamp = DVec3::new(
        dice.between(-1.0, 1.0),
        dice.between(-1.5, -0.8),
        dice.between(-0.8, 0.4),
    );
    let stage = Stage {
        parts,
        motions: vec![RigidMotion::default(); bodies + 1],
        light: Light::daylight(
            ground.direction(lamp),
            ground.direction(DVec3::NEG_Y),
            dice.between(0.12, 0.25),
        ),
        shadows: if many {
            Shadows::Painted
        } else {
            Shadows::Cast
        },
        haze: (0.0, DVec3::ZERO),
    };
    (stage, courses)
}

/// A solid standing on the ground at (x, z).
fn object(dice: &mut Dice, body: usize, many: bool, x: f64, z: f64, texture: Texture) -> Part {
    let yaw = DMat3::from_rotation_y(dice.between(0.0, std::f64::consts::PI));
    let kind = if many { dice.bits() % 3 } else { 0 };
    let (solid, height) = match kind {
        0 => {
            let half = DVec3::new(
                dice.between(0.55, 0.9),
                dice.between(0.4, 0.8),
                dice.between(0.55, 0.9),
            );
            (Solid::Cuboid(half), half.y)
        }
        1 => {
            let radii = DVec3::new(
                dice.between(0.65, 0.95),
                dice.between(0.65, 0.95),
                dice.between(0.65, 0.95),
            );
            (Solid::Ellipsoid(radii), radii.y)
        }
        _ => {
            let half = dice.between(0.55, 0.85);
            let radius = dice.between(0.6, 0.85);
            (Solid::Cylinder { radius, half }, half)
        }
    };
    let shine = if many { dice.between(0.0, 0.25) } else { 0.0 };
    Part {
        solid,
        pose: Pose::at(x, -height, z).turned(yaw),
        material: Material::shiny(texture, shine, 30.0),
        body,
    }
}

/// How the background and each body shall move.
fn courses(
    dice: &mut Dice,
    ground: Pose,
    parts: &[Part],
    bodies: usize,
    many: bool,
) -> Vec<Course> {
    let direction = |dice: &mut Dice, lift: f64| {
        let angle = dice.between(0.0, std::f64::consts::TAU);
        let rise = dice.between(-lift, lift);
        ground.direction(DVec3::new(angle.cos(), rise, angle.sin()))
    };
    let mut courses = vec![match dice.pick(&[0, 0, 0, 1, 1, 2]) {
        0 => Course::default(),
        // The camera moves, or turns: a turn about the camera tells nothing of depth.
        1 => Course {
            shift: direction(dice, 0.4),
            pace: dice.between(0.2, 0.5),
            ..Course::default()
        },
        _ => Course {
            rotation: direction(dice, 0.4),
            pace: dice.between(0.2, 0.5),
            ..Course::default()
        },
    }];
    let background_moves = courses[0].pace > 0.0;
    let fastest = dice.bits() as usize % bodies;
    for body in 0..bodies {
        let pace = if body == fastest {
            1.0
        } else {
            dice.between(0.6, 1.0)
        };
        let still = background_moves && body != fastest && dice.chance(0.25);
        let turns = dice.chance(if many { 0.75 } else { 0.35 });
        // About an axis near the upright one; an angle of 1 moves a surface about as far as a shift.
        let axis = ground
            .direction(DVec3::new(
                dice.between(-0.4, 0.4),
                1.0,
                dice.between(-0.4, 0.4),
            ))
            .normalize();
        let turn = dice.pick(&[-1.0, 1.0]) * dice.between(0.6, 1.2);
        courses.push(Course {
            centre: parts[parts.len() - bodies + body].pose.centre,
            rotation: if turns { axis * turn } else { DVec3::ZERO },
            shift: direction(dice, 0.1),
            pace: if still { 0.0 } else { pace },
        });
    }
    courses
}

/// A texture of any kind and colour, with grain.
fn texture(dice: &mut Dice) -> Texture {
    let pattern = dice.pick(&[
        Pattern::Mottle,
        Pattern::Marble,
        Pattern::Marble,
        Pattern::Speckle,
        Pattern::Strata,
    ]);
    let hue = DVec3::new(
        dice.between(0.45, 1.0),
        dice.between(0.45, 1.0),
        dice.between(0.45, 1.0),
    );
    let hue = hue / hue.max_element();
    let light = dice.between(0.5, 0.85);
    let contrast = dice.between(0.45, 0.85);
    let dark = light * (1.0 - contrast);
    let mut colours = [
        hue * dark,
        hue * 0.5 * (dark + light),
        DVec3::splat(0.3).lerp(hue, 0.7) * light,
    ];
    if dice.chance(0.4) {
        colours.reverse();
    }
    Texture {
        pattern,
        colours,
        scale: dice.between(0.6, 1.3) * if pattern == Pattern::Strata { 0.4 } else { 1.0 },
        grain: dice.between(0.2, 0.5),
        seed: dice.bits() as u32 % 100_000,
    }
}
