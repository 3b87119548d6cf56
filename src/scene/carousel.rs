//! `carousel`: a ball, a box and a drum, each turning about an axis of its own; four regions.

use std::f64::consts::FRAC_PI_2;

use glam::{DMat3, DVec3};

use super::Entry;
use super::solid::Solid;
use super::stage::{Light, Material, Part, Pose, Shadows, Stage, slide, turn};
use super::texture::{Pattern, Texture, palette};

pub(super) const ENTRY: Entry = Entry {
    name: "carousel",
    title: "Turning bodies",
    lesson: "Four regions with rotation. Each body moves to one side and rotates back. Only both \
             motions together determine its shape.",
    stage,
};

fn stage() -> Stage {
    let ground = Pose::ground(0.42, 6.4);
    let down = ground.direction(DVec3::Y);
    let texture = |pattern, colours, scale, seed| Texture {
        pattern,
        colours,
        scale,
        grain: 0.4,
        seed,
    };
    let floor = texture(
        Pattern::Speckle,
        palette(0x77716a, 0xa39a8c, 0xe0dacb),
        1.3,
        51,
    );
    let wall = texture(
        Pattern::Mottle,
        palette(0x56646e, 0x8f9a9c, 0xcfcfc4),
        1.0,
        55,
    );
    let ball = texture(
        Pattern::Marble,
        palette(0x8e2b2b, 0xd0603a, 0xf4d7a8),
        0.7,
        52,
    );
    let crate_ = texture(
        Pattern::Strata,
        palette(0x6f4a26, 0xb07f45, 0xdcb67c),
        0.25,
        53,
    );
    let drum = texture(
        Pattern::Speckle,
        palette(0x1f4a53, 0x3d8086, 0xe4e2cf),
        0.6,
        54,
    );
    let part = |body, solid, pose: Pose, material| Part {
        solid,
        pose: pose.within(ground),
        material,
        body,
    };
    let parts = vec![
        Part {
            solid: Solid::Floor,
            pose: ground,
            material: Material::matt(floor),
            body: 0,
        },
        part(
            1,
            Solid::Ellipsoid(DVec3::splat(0.95)),
            Pose::at(-1.75, -0.95, 0.5),
            Material::shiny(ball, 0.25, 40.0),
        ),
        part(
            2,
            Solid::Cuboid(DVec3::new(0.7, 0.7, 0.7)),
            Pose::at(0.25, -0.7, -0.9).turned(DMat3::from_rotation_y(0.7)),
            Material::matt(crate_),
        ),
        part(
            3,
            Solid::Cylinder {
                radius: 0.85,
                half: 0.85,
            },
            Pose::at(2.05, -0.85, 0.6),
            Material::shiny(drum, 0.15, 25.0),
        ),
        // The ground stood upright at the back of the floor.
        part(
            0,
            Solid::Floor,
            Pose::at(0.0, 0.0, 3.4).turned(DMat3::from_rotation_x(FRAC_PI_2)),
            Material::matt(wall),
        ),
    ];
    let centre = |i: usize| parts[i].pose.centre;
    let motions = vec![
        slide(DVec3::ZERO),
        turn(centre(1), down * 0.008, DVec3::new(-0.016, 0.004, -0.006)),
        turn(centre(2), down * -0.007, DVec3::new(0.012, 0.004, 0.0)),
        turn(centre(3), down * 0.008, DVec3::new(-0.013, -0.009, 0.0)),
    ];
    Stage {
        parts,
        motions,
        light: Light::daylight(
            ground.direction(DVec3::new(-0.7, -1.1, -0.5)),
            ground.direction(DVec3::NEG_Y),
            0.16,
        ),
        shadows: Shadows::Painted,
        haze: (0.0, DVec3::ZERO),
    }
}
