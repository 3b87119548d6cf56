//! `columns`: a walk past columns that stand still; the whole frame is one region and its depth leaps.

use std::f64::consts::FRAC_PI_2;

use glam::{DMat3, DVec3};

use super::Entry;
use super::solid::Solid;
use super::stage::{Light, Material, Part, Pose, Shadows, Stage, turn};
use super::texture::{Pattern, Texture, palette};

pub(super) const ENTRY: Entry = Entry {
    name: "columns",
    title: "Walk past columns",
    lesson: "No curve: the scene stands still and the camera moves past it. So depth has the same \
             unit everywhere. It changes abruptly at the edges of the columns. Look at this one \
             through red-cyan glasses.",
    stage,
};

/// Height of a column.
const TALL: f64 = 2.5;

fn stage() -> Stage {
    let ground = Pose::ground(0.24, 6.6);
    let texture = |pattern, colours, scale, seed| Texture {
        pattern,
        colours,
        scale,
        grain: 0.45,
        seed,
    };
    let paving = Material::matt(texture(
        Pattern::Speckle,
        palette(0x6d6659, 0x9b9382, 0xd8cfbb),
        1.1,
        61,
    ));
    let rock = Material::matt(texture(
        Pattern::Mottle,
        palette(0x8a6a50, 0xb8936f, 0xe3c7a0),
        1.2,
        62,
    ));
    let marble = texture(
        Pattern::Marble,
        palette(0x948d80, 0xd3cab8, 0xf6efdf),
        0.6,
        63,
    );
    let clay = texture(
        Pattern::Mottle,
        palette(0x6e2f1d, 0xb15a35, 0xe09a68),
        0.4,
        64,
    );
    let wood = texture(
        Pattern::Strata,
        palette(0x5a4329, 0x86673f, 0xae8b58),
        0.12,
        65,
    );
    let part = |solid, pose: Pose, material| Part {
        solid,
        pose: pose.within(ground),
        material,
        body: 0,
    };
    let slab = |x: f64, y: f64, z: f64, half: [f64; 3], material| {
        part(
            Solid::Cuboid(DVec3::from_array(half)),
            Pose::at(x, y, z),
            material,
        )
    };
    let drum = |x: f64, y: f64, z: f64, radius: f64, half: f64, material| {
        part(
            Solid::Cylinder { radius, half },
            Pose::at(x, y, z),
            material,
        )
    };
    let mut parts = vec![
        Part {
            solid: Solid::Floor,
            pose: ground,
            material: paving,
            body: 0,
        },
        // The ground stood upright at the back.
        part(
            Solid::Floor,
            Pose::at(0.0, 0.0, 5.5).turned(DMat3::from_rotation_x(FRAC_PI_2)),
            rock,
        ),
    ];
    // Stone of its own for each column: what is alike here and there would be mistaken for another.
    for (column, &(x, z)) in [(-1.3, -2.6), (-1.35, 0.6), (-1.4, 3.8), (2.3, 2.2)]
        .iter()
        .enumerate()
    {
        let stone = Material::shiny(
            Texture {
                seed: marble.seed + 10 * column as u32,
                ..marble
            },
            0.12,
            20.0,
        );
        parts.extend([
            slab(x, -0.12, z, [0.42, 0.12, 0.42], stone),
            drum(x, -0.5 * TALL, z, 0.3, 0.5 * TALL - 0.1, stone),
            slab(x, 0.12 - TALL, z, [0.42, 0.12, 0.42], stone),
        ]);
    }
    let clay = Material::shiny(clay, 0.2, 30.0);
    parts.extend([
        // An urn on the paving, and a chest.
        drum(0.45, -0.06, -0.9, 0.3, 0.06, clay),
        part(
            Solid::Ellipsoid(DVec3::new(0.52, 0.55, 0.52)),
            Pose::at(0.45, -0.6, -0.9),
            clay,
        ),
        drum(0.45, -1.2, -0.9, 0.2, 0.12, clay),
        drum(0.45, -1.33, -0.9, 0.3, 0.05, clay),
        part(
            Solid::Cuboid(DVec3::new(0.75, 0.45, 0.5)),
            Pose::at(1.9, -0.45, -1.2).turned(DMat3::from_rotation_y(-0.45)),
            Material::matt(wood),
        ),
    ]);
    Stage {
        parts,
        // The world moves past the camera: the opposite of the camera's own motion.
        motions: vec![turn(
            DVec3::ZERO,
            DVec3::new(0.0006, -0.0008, 0.0004),
            ground.direction(DVec3::new(-0.024, 0.003, -0.008)),
        )],
        light: Light::daylight(
            ground.direction(DVec3::new(-0.8, -1.1, -0.7)),
            ground.direction(DVec3::NEG_Y),
            0.12,
        ),
        shadows: Shadows::Painted,
        haze: (0.0, DVec3::ZERO),
    }
}
