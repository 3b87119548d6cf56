//! `squares`: two textured square plates sliding apart before a wall that moves as well.

use glam::{DMat3, DVec3};

use super::Entry;
use super::solid::Solid;
use super::stage::{Light, Material, Part, Pose, Shadows, Stage, slide};
use super::texture::{Pattern, Texture, palette};

pub(super) const ENTRY: Entry = Entry {
    name: "squares",
    title: "Two squares",
    lesson: "The simplest case: three surfaces with three translations. Each curve has to find the \
             outline of its square by motion alone. Each tilted square gets its own depth.",
    stage,
};

fn stage() -> Stage {
    let wall = Texture {
        pattern: Pattern::Mottle,
        colours: palette(0x5d5a4e, 0x9c9a86, 0xdad6c0),
        scale: 0.9,
        grain: 0.35,
        seed: 1,
    };
    let left = Texture {
        pattern: Pattern::Marble,
        colours: palette(0x7a2f22, 0xc8663f, 0xf3dcc0),
        scale: 0.7,
        grain: 0.35,
        seed: 2,
    };
    let right = Texture {
        pattern: Pattern::Speckle,
        colours: palette(0x24386b, 0x4f79b8, 0xe8e6d6),
        scale: 1.3,
        grain: 0.35,
        seed: 3,
    };
    let plate = |half: f64| Solid::Cuboid(DVec3::new(half, half, 0.12));
    let part = |body, solid, pose, texture| Part {
        solid,
        pose,
        material: Material::matt(texture),
        body,
    };
    Stage {
        parts: vec![
            part(0, Solid::Floor, Pose::wall(8.0, 0.25), wall),
            part(
                1,
                plate(0.95),
                Pose::at(-1.35, -0.25, 5.6).turned(DMat3::from_rotation_y(-0.5)),
                left,
            ),
            part(
                2,
                plate(0.85),
                Pose::at(1.25, 0.4, 5.0)
                    .turned(DMat3::from_rotation_x(0.45))
                    .turned(DMat3::from_rotation_z(0.12)),
                right,
            ),
        ],
        motions: vec![
            slide(DVec3::new(0.010, 0.004, 0.0)),
            slide(DVec3::new(0.018, -0.010, 0.0)),
            slide(DVec3::new(-0.014, 0.009, 0.0)),
        ],
        light: Light::daylight(
            DVec3::new(-0.5, -0.9, -1.0),
            DVec3::new(0.0, -1.0, -0.3),
            0.12,
        ),
        shadows: Shadows::Painted,
        haze: (0.0, DVec3::ZERO),
    }
}
