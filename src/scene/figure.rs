//! `figure`: a toy bear built of ellipsoids, one rigid body, after the paper's Teddy.

use glam::{DMat3, DVec3};

use super::Entry;
use super::solid::Solid;
use super::stage::{Light, Material, Part, Pose, Shadows, Stage, turn};
use super::texture::{Pattern, Texture, palette};

pub(super) const ENTRY: Entry = Entry {
    name: "figure",
    title: "Toy bear",
    lesson: "One body with strong relief. Nose, ears and bow tie stand out only if smoothing stops at \
             depth edges. Compare the two kinds of smoothing here.",
    stage,
};

fn stage() -> Stage {
    let fur = Texture {
        pattern: Pattern::Mottle,
        colours: palette(0x5f3a1c, 0xa8743f, 0xe0b67e),
        scale: 0.5,
        grain: 0.5,
        seed: 21,
    };
    let cream = Texture {
        colours: palette(0xa58a62, 0xd9c197, 0xf7ead0),
        seed: 22,
        ..fur
    };
    let black = Texture {
        pattern: Pattern::Mottle,
        colours: palette(0x0c0b0d, 0x1d1a1c, 0x3a3336),
        scale: 0.2,
        grain: 0.2,
        seed: 23,
    };
    let bow = Texture {
        pattern: Pattern::Speckle,
        colours: palette(0x8e1420, 0xc4262f, 0xf4e6d8),
        scale: 0.6,
        grain: 0.3,
        seed: 24,
    };
    let wall = Texture {
        pattern: Pattern::Mottle,
        colours: palette(0x35506e, 0x6f93a8, 0xcfdcd6),
        scale: 1.4,
        grain: 0.4,
        seed: 25,
    };
    // Bear coordinates: origin in the middle of the head, x to the camera's right, y down, the face
    // looking along −z; turned a little so that it looks past the camera.
    let bear = Pose::at(0.05, -0.5, 5.2).turned(DMat3::from_rotation_y(0.3));
    let lump = |x: f64, y: f64, z: f64, radii: [f64; 3], material: Material| Part {
        solid: Solid::Ellipsoid(DVec3::from_array(radii)),
        pose: Pose::at(x, y, z).within(bear),
        material,
        body: 1,
    };
    let soft = Material::matt;
    let glass = Material::shiny(black, 0.8, 60.0);
    let mut parts = vec![
        Part {
            solid: Solid::Floor,
            pose: Pose::wall(8.5, 0.15),
            material: soft(wall),
            body: 0,
        },
        lump(0.0, 0.0, 0.0, [0.95, 0.86, 0.85], soft(fur)),
        lump(0.0, 0.28, -0.72, [0.44, 0.35, 0.42], soft(cream)),
        lump(0.0, 0.12, -1.1, [0.15, 0.11, 0.1], glass),
        lump(0.0, 1.75, 0.1, [1.0, 1.05, 0.85], soft(fur)),
        lump(0.0, 1.85, -0.45, [0.62, 0.72, 0.42], soft(cream)),
        lump(0.0, 0.92, -0.82, [0.14, 0.14, 0.14], soft(bow)),
    ];
    for side in [-1.0, 1.0] {
        parts.push(lump(0.78 * side, -0.68, 0.1, [0.36, 0.36, 0.2], soft(fur)));
        parts.push(lump(
            0.78 * side,
            -0.66,
            -0.07,
            [0.22, 0.22, 0.1],
            soft(cream),
        ));
        parts.push(lump(0.34 * side, -0.16, -0.74, [0.11, 0.13, 0.1], glass));
        parts.push(Part {
            pose: Pose::at(0.4 * side, 0.92, -0.76)
                .turned(DMat3::from_rotation_z(0.25 * side))
                .within(bear),
            ..lump(0.0, 0.0, 0.0, [0.34, 0.22, 0.13], soft(bow))
        });
        parts.push(Part {
            pose: Pose::at(1.0 * side, 1.55, -0.3)
                .turned(DMat3::from_rotation_z(0.6 * side))
                .within(bear),
            ..lump(0.0, 0.0, 0.0, [0.3, 0.66, 0.34], soft(fur))
        });
    }
    Stage {
        parts,
        motions: vec![
            turn(DVec3::ZERO, DVec3::ZERO, DVec3::new(-0.006, 0.0, 0.0)),
            turn(
                bear.point(DVec3::new(0.0, 0.8, 0.0)),
                DVec3::new(0.0, -0.0006, 0.001),
                DVec3::new(0.017, -0.004, -0.004),
            ),
        ],
        light: Light::daylight(
            DVec3::new(-0.7, -0.9, -0.9),
            DVec3::new(0.0, -1.0, -0.2),
            0.14,
        ),
        shadows: Shadows::Painted,
        haze: (0.0, DVec3::ZERO),
    }
}
