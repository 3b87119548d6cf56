//! The surface as if cast in plaster and lit by a lamp close by.
//!
//! The triangles of [`mesh`](super::mesh()) are turned, seen in perspective and shaded by Lambert's law:
//! light = ambient + lamp · max(0, n·l) / (1 + fall-off · distance²). What goes on hidden is darker; regions whose depth is
//! not known are flat ghosts.

use glam::{Mat3, Vec2, Vec3};

use super::colour::Encoder;
use super::mesh::mesh;
use super::raster::{Corner, Raster};
use super::{Picture, ViewParams};
use crate::frames::Frame;
use crate::grid::Grid;
use crate::interpretation::Interpretation;

/// Distance of the eye from the middle of the surface, whose half width is 1.
const EYE: f32 = 4.2;
/// The lamp, above and to the left of the eye, which looks along −z.
const LAMP: Vec3 = Vec3::new(-1.5, 1.5, 1.7);
const FALL_OFF: f32 = 0.16;
/// Reflectances in linear light.
const PLASTER: Vec3 = Vec3::new(0.86, 0.80, 0.70);
const UNKNOWN: Vec3 = Vec3::new(0.20, 0.21, 0.23);
/// Brightness of what goes on hidden.
const DIMMED: f32 = 0.3;
/// Opacity of what is of unknown depth.
const GHOST: f32 = 0.3;
/// Light behind, at the top and at the bottom.
const BEHIND: [Vec3; 2] = [
    Vec3::new(0.030, 0.034, 0.044),
    Vec3::new(0.010, 0.011, 0.014),
];
/// Share of the picture that the surface fills.
const FILLED: f32 = 0.94;
/// Vertices aimed at when the step is chosen: more than to turn in real time, for finer outlines.
const VERTICES: usize = 400_000;
/// Pictures up to this many pixels are drawn at twice the size and averaged.
const SMOOTHED: usize = 2_000_000;

/// The relief, turned by [`ViewParams::turn`] and [`ViewParams::tilt`] and fitted into a picture of
/// the frame's size.
pub fn relief(frame: &Frame, found: &Interpretation, params: &ViewParams) -> Picture {
    let (width, height) = (frame.width(), frame.height());
    let fine = if width * height <= SMOOTHED { 2 } else { 1 };
    let automatic = ((width * height) as f32 / VERTICES as f32).sqrt().ceil() as usize;
    let finer = ViewParams {
        step: params.step.or(Some(automatic)),
        ..params.clone()
    };
    let mesh = mesh(frame, found, &finer);
    let turn = Mat3::from_rotation_x((params.tilt as f32).to_radians())
        * Mat3::from_rotation_y((params.turn as f32).to_radians());
    let vectors = |flat: &[f32]| -> Vec<Vec3> {
        let turned = flat.chunks_exact(3).map(|v| turn * Vec3::from_slice(v));
        turned.collect()
    };
    let (points, normals) = (vectors(&mesh.positions), vectors(&mesh.normals));
    let seen: Vec<Vec2> = points
        .iter()
        .map(|p| Vec2::new(p.x, -p.y) / (EYE - p.z).max(0.1))
        .collect();
    let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    for &i in &mesh.indices {
        low = low.min(seen[i as usize]);
        high = high.max(seen[i as usize]);
    }
    let size = Vec2::new((width * fine) as f32, (height * fine) as f32);
    let fit = (size * FILLED / (high - low).max(Vec2::splat(1e-6))).min_element();
    let corners: Vec<Corner> = (0..points.len())
        .map(|i| Corner {
            at: (seen[i] - (low + high) / 2.0) * fit + size / 2.0 - 0.5,
            near: points[i].z,
            light: shade(points[i], normals[i], mesh.known[i] != 0),
        })
        .collect();
    let draw = |triangles: &[u32], dim: f32| {
        let mut raster = Raster::new(width * fine, height * fine);
        for t in triangles.chunks_exact(3) {
            raster.triangle([t[0], t[1], t[2]].map(|i| Corner {
                light: corners[i as usize].light * dim,
                ..corners[i as usize]
            }));
        }
        raster
    };
    let [seen, hidden, _] = mesh.parts.map(|count| count as usize);
    let ghosts = draw(&mesh.indices[seen + hidden..], 1.0);
    let mut raster = draw(&mesh.indices[..seen], 1.0);
    raster.add(draw(&mesh.indices[seen..seen + hidden], DIMMED));
    let encoder = Encoder::new();
    Grid::from_fn(width, height, |x, y| {
        let behind = BEHIND[0].lerp(BEHIND[1], y as f32 / height as f32);
        let mut light = Vec3::ZERO;
        for dy in 0..fine {
            for dx in 0..fine {
                let at = (x * fine + dx, y * fine + dy);
                let ghost = ghosts.light[at];
                let nothing = if ghost.is_nan() {
                    behind
                } else {
                    behind.lerp(ghost, GHOST)
                };
                let here = raster.light[at];
                light += if here.is_nan() { nothing } else { here };
            }
        }
        let [r, g, b] = (light / (fine * fine) as f32)
            .to_array()
            .map(|c| encoder.encode(c));
        [r, g, b, 255]
    })
}

fn shade(point: Vec3, normal: Vec3, known: bool) -> Vec3 {
    let to_eye = Vec3::new(0.0, 0.0, EYE) - point;
    let normal = if normal.dot(to_eye) < 0.0 {
        -normal
    } else {
        normal
    };
    let to_lamp = LAMP - point;
    let lamp =
        normal.dot(to_lamp.normalize()).max(0.0) / (1.0 + FALL_OFF * to_lamp.length_squared());
    let sky = 0.06 + 0.05 * normal.y;
    (if known { PLASTER } else { UNKNOWN }) * (sky + 1.5 * lamp)
}
