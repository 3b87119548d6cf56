//! `flight`: a camera flying low over hills; the whole frame is one region.

use glam::DVec3;

use super::Entry;
use super::solid::Solid;
use super::stage::{Light, Material, Part, Pose, Shadows, Stage, turn};
use super::terrain::Terrain;
use super::texture::{Pattern, Texture, palette, srgb};

pub(super) const ENTRY: Entry = Entry {
    name: "flight",
    title: "Flight over hills",
    lesson: "No curve: only the camera moves, and one rigid motion explains every pixel. Depth \
             increases from the slope below to the far ridge.",
    stage,
};

fn stage() -> Stage {
    let land = Texture {
        pattern: Pattern::Mottle,
        colours: palette(0x455c2c, 0x8c8a52, 0xd0bd8a),
        scale: 0.9,
        grain: 0.8,
        seed: 41,
    };
    let ground = Pose::ground(0.56, 5.2);
    let sky = srgb(0xc4d6e6);
    // The land moves past the camera: the opposite of the camera's own motion.
    Stage {
        parts: vec![Part {
            solid: Solid::Terrain(Terrain::new(1.0, 2.2, 7)),
            pose: ground,
            material: Material::matt(land),
            body: 0,
        }],
        motions: vec![turn(
            DVec3::ZERO,
            DVec3::new(0.0004, -0.0006, 0.0003),
            ground.direction(DVec3::new(0.003, 0.0, -0.017)),
        )],
        light: Light::daylight(
            ground.direction(DVec3::new(-1.0, -0.5, 0.35)),
            ground.direction(DVec3::NEG_Y),
            0.05,
        ),
        shadows: Shadows::Painted,
        haze: (0.022, sky),
    }
}
