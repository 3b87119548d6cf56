//! `blocks`: two marble blocks moving over a still marble floor, after the paper's Marbled block.

use glam::{DMat3, DVec3};

use super::Entry;
use super::solid::Solid;
use super::stage::{Light, Material, Part, Pose, Shadows, Stage, slide};
use super::texture::{Pattern, Texture, palette};

pub(super) const ENTRY: Entry = Entry {
    name: "blocks",
    title: "Marble blocks",
    lesson: "Two blocks of the same marble as the floor. Some of their edges can be found only by \
             motion. Their shadows move over the still floor, and no rigid motion explains them.",
    stage,
};

fn stage() -> Stage {
    let marble = Texture {
        pattern: Pattern::Marble,
        colours: palette(0x8d8a86, 0xc9c2b6, 0x4a4f58),
        scale: 1.1,
        grain: 0.4,
        seed: 11,
    };
    let ground = Pose::ground(0.72, 7.0);
    let block = |x: f64, z: f64, yaw: f64, half: DVec3, body: usize, seed: u32| Part {
        solid: Solid::Cuboid(half),
        pose: Pose::at(x, -half.y, z)
            .turned(DMat3::from_rotation_y(yaw))
            .within(ground),
        material: Material::matt(Texture { seed, ..marble }),
        body,
    };
    Stage {
        parts: vec![
            Part {
                solid: Solid::Floor,
                pose: ground,
                material: Material::matt(marble),
                body: 0,
            },
            block(-1.15, 0.75, 0.5, DVec3::new(0.75, 0.55, 0.8), 1, 12),
            block(1.2, -0.55, -0.35, DVec3::new(0.8, 0.6, 0.65), 2, 13),
        ],
        motions: vec![
            slide(DVec3::ZERO),
            slide(ground.direction(DVec3::new(-0.026, 0.0, 0.008))),
            slide(ground.direction(DVec3::new(-0.016, 0.0, -0.017))),
        ],
        light: Light::daylight(
            ground.direction(DVec3::new(0.75, -1.0, 0.35)),
            ground.direction(DVec3::NEG_Y),
            0.1,
        ),
        shadows: Shadows::Cast,
        haze: (0.0, DVec3::ZERO),
    }
}
