//! `head`: a head moving back and slightly left before a noisy wall, after the paper's Robert.

use glam::{DMat3, DVec3};

use super::Entry;
use super::solid::Solid;
use super::stage::{Light, Material, Part, Pose, Shadows, Stage, slide};
use super::texture::{Pattern, Texture, palette, srgb};

pub(super) const ENTRY: Entry = Entry {
    name: "head",
    title: "Head before a wall",
    lesson: "Cheeks and hair have almost no texture, so their depth comes from the features around \
             them, by smoothness. The head moves away from the camera, so its image shrinks.",
    stage,
};

fn stage() -> Stage {
    let skin = Texture {
        pattern: Pattern::Mottle,
        colours: palette(0xc98d6c, 0xd49a78, 0xdfa887),
        scale: 0.6,
        grain: 0.05,
        seed: 31,
    };
    let hair = Texture {
        pattern: Pattern::Strata,
        colours: palette(0x2a1b13, 0x37251b, 0x463024),
        scale: 0.2,
        grain: 0.25,
        seed: 32,
    };
    let lips = Texture {
        colours: palette(0x9c4f46, 0xb0605a, 0xc0746a),
        seed: 33,
        ..skin
    };
    let white = Texture {
        pattern: Pattern::Plain,
        colours: [srgb(0xe8e2da); 3],
        scale: 1.0,
        grain: 0.0,
        seed: 34,
    };
    let iris = Texture {
        colours: [srgb(0x33261e); 3],
        ..white
    };
    let shirt = Texture {
        pattern: Pattern::Strata,
        colours: palette(0x2a3e63, 0x47618f, 0x93a9c9),
        scale: 0.22,
        grain: 0.3,
        seed: 35,
    };
    let wall = Texture {
        pattern: Pattern::Speckle,
        colours: palette(0x4b5b45, 0x8b9a72, 0xe2dcc0),
        scale: 1.6,
        grain: 0.7,
        seed: 36,
    };
    // Head coordinates: origin in its middle, the face looking along −z.
    let head = Pose::at(0.1, -0.1, 4.6).turned(DMat3::from_rotation_y(0.35));
    let lump = |x: f64, y: f64, z: f64, radii: [f64; 3], material: Material| Part {
        solid: Solid::Ellipsoid(DVec3::from_array(radii)),
        pose: Pose::at(x, y, z).within(head),
        material,
        body: 1,
    };
    let flesh = Material::shiny(skin, 0.06, 14.0);
    let mut parts = vec![
        Part {
            solid: Solid::Floor,
            pose: Pose::wall(7.5, 0.15),
            material: Material::matt(wall),
            body: 0,
        },
        lump(0.0, 0.04, 0.0, [0.86, 1.14, 0.95], flesh),
        lump(0.0, 0.86, -0.46, [0.32, 0.26, 0.24], flesh),
        lump(0.0, -0.28, 0.16, [0.95, 1.05, 0.98], Material::matt(hair)),
        lump(0.0, 0.16, -0.98, [0.13, 0.26, 0.2], flesh),
        lump(0.0, 0.3, -1.04, [0.17, 0.11, 0.14], flesh),
        lump(0.0, 0.6, -0.79, [0.25, 0.07, 0.1], Material::matt(lips)),
        Part {
            solid: Solid::Cylinder {
                radius: 0.52,
                half: 0.6,
            },
            ..lump(0.0, 1.35, 0.2, [1.0; 3], flesh)
        },
        lump(0.0, 2.25, 0.3, [1.9, 0.85, 0.85], Material::matt(shirt)),
    ];
    for side in [-1.0, 1.0] {
        parts.push(lump(
            0.32 * side,
            -0.12,
            -0.8,
            [0.15, 0.09, 0.1],
            Material::matt(white),
        ));
        parts.push(lump(
            0.32 * side,
            -0.12,
            -0.86,
            [0.07, 0.07, 0.06],
            Material::matt(iris),
        ));
        parts.push(lump(
            0.34 * side,
            -0.34,
            -0.86,
            [0.2, 0.05, 0.08],
            Material::matt(hair),
        ));
        parts.push(lump(0.88 * side, 0.08, 0.1, [0.1, 0.26, 0.18], flesh));
    }
    Stage {
        parts,
        motions: vec![slide(DVec3::ZERO), slide(DVec3::new(-0.0085, 0.0, 0.026))],
        light: Light::daylight(
            DVec3::new(0.8, -0.8, -1.0),
            DVec3::new(0.0, -1.0, -0.2),
            0.14,
        ),
        shadows: Shadows::Painted,
        haze: (0.0, DVec3::ZERO),
    }
}
