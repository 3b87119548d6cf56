//! What is exactly true of a scene: labels, depth, motion, flow, occlusion, and curves to start from.
//!
//! One ray through each pixel's centre. Flow is the projection of the moved surface point less the
//! pixel, from the same rigid motions that place the bodies in the second frame.

use super::cast::{Caster, Moment};
use super::stage::Stage;
use crate::camera::Camera;
use crate::curves::Shape;
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};

/// Image motion by translation, in pixels, below which depth does not show.
const OBSERVABLE: f64 = 1e-3;

/// The truth about `stage`.
///
/// `occluded` is 1 where the first frame's point is hidden in the second, by another body or by its
/// own, and also where it leaves the frame: either way the second frame does not show it.
/// `confidence` is 1 where the body's translation moves the pixel, so that depth can be told from
/// the frames, and 0 elsewhere.
pub fn truth(stage: &Stage, camera: Camera, width: usize, height: usize) -> Interpretation {
    let first = Caster::new(stage, camera, Moment::First);
    let seen = Grid::from_fn(width, height, |x, y| first.look(x as f64, y as f64));
    let second = Caster::new(stage, camera, Moment::Second);
    let mut u = Grid::new(width, height, 0.0_f32);
    let mut v = Grid::new(width, height, 0.0_f32);
    let mut confidence = Grid::new(width, height, 0.0_f32);
    let mut occluded = Grid::new(width, height, 0_u8);
    for y in 0..height {
        for x in 0..width {
            let (px, py) = (x as f64, y as f64);
            let at = seen[(x, y)];
            let motion = &stage.motions[at.body];
            let rho = 1.0 / at.depth;
            let t = motion.translation;
            let ray = camera.ray(px, py);
            let shift = (t.x - ray.x * t.z).hypot(t.y - ray.y * t.z) * camera.focal * rho;
            confidence[(x, y)] = if shift > OBSERVABLE { 1.0 } else { 0.0 };
            let Some((du, dv)) = camera.displacement(motion, px, py, rho) else {
                occluded[(x, y)] = 1;
                continue;
            };
            u[(x, y)] = du as f32;
            v[(x, y)] = dv as f32;
            let (qx, qy) = (px + du, py + dv);
            let inside =
                qx >= -0.5 && qy >= -0.5 && qx < width as f64 - 0.5 && qy < height as f64 - 0.5;
            let depth = motion.apply(ray * at.depth).z;
            // Nothing within a thousandth of its depth can hide it: that is its own surface.
            if !inside || second.look(qx, qy).depth < depth * 0.999 {
                occluded[(x, y)] = 1;
            }
        }
    }
    Interpretation {
        camera,
        labels: seen.map(|s| s.body as u8),
        depth: seen.map(|s| s.depth as f32),
        flow: Flow { u, v },
        confidence,
        occluded,
        motions: stage.motions.clone(),
    }
}

/// One circle per body, in the middle of what is seen of it and with a third of that area; where
/// nothing is seen of it, a small one in the middle of the frame.
pub fn curves(labels: &Grid<u8>, bodies: usize) -> Vec<Shape> {
    (1..bodies)
        .map(|body| {
            let (mut n, mut sx, mut sy) = (0.0_f64, 0.0, 0.0);
            for (i, _) in labels
                .data()
                .iter()
                .enumerate()
                .filter(|&(_, &l)| usize::from(l) == body)
            {
                n += 1.0;
                sx += (i % labels.width()) as f64;
                sy += (i / labels.width()) as f64;
            }
            if n == 0.0 {
                n = 1.0;
                sx = (labels.width() / 2) as f64;
                sy = (labels.height() / 2) as f64;
            }
            Shape::Circle {
                x: sx / n,
                y: sy / n,
                // Above half a pixel's diagonal, so that it encloses at least one pixel.
                r: (n / (3.0 * std::f64::consts::PI)).sqrt().max(0.75),
            }
        })
        .collect()
}
