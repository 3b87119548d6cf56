//! What is exactly true of a scene: labels, depth, motion, flow, occlusion, and curves to start from.
//!
//! One ray through each pixel's centre. Flow is the projection of the moved surface point less the
//! pixel, from the same rigid motions that place the bodies in the next frame.

use super::cast::{Caster, Moment};
use super::stage::Stage;
use crate::camera::Camera;
use crate::curves::Shape;
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};

/// Image motion by translation, in pixels, below which depth does not show.
const OBSERVABLE: f64 = 1e-3;

/// The truth about the frame of `moment` and the one after it.
///
/// `occluded` is 1 where this frame's point is hidden in the next, by another body or by its
/// own, and also where it leaves the frame: either way the next frame does not show it.
/// `confidence` is 1 where the body's translation moves the pixel, so that depth can be told from
/// the frames, and 0 elsewhere.
pub fn truth(
    stage: &Stage,
    camera: Camera,
    moment: Moment,
    [width, height]: [usize; 2],
) -> Interpretation {
    let now = Caster::new(stage, camera, moment);
    let seen = Grid::from_fn(width, height, |x, y| now.look(x as f64, y as f64));
    let next = Caster::new(stage, camera, Moment(moment.0 + 1));
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
            if !inside || next.look(qx, qy).depth < depth * 0.999 {
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

/// Where a body is seen.
pub struct Middle {
    /// Column of its centre of gravity, the frame's middle when it is not seen at all.
    pub x: f64,
    /// Row of it.
    pub y: f64,
    /// Pixels that show it.
    pub pixels: f64,
}

/// Where each body but the background is seen.
pub fn middles(labels: &Grid<u8>, bodies: usize) -> Vec<Middle> {
    let mut sums = vec![(0.0_f64, 0.0_f64, 0.0_f64); bodies];
    for (i, &label) in labels.data().iter().enumerate() {
        let (n, x, y) = &mut sums[usize::from(label)];
        *n += 1.0;
        *x += (i % labels.width()) as f64;
        *y += (i / labels.width()) as f64;
    }
    let unseen = ((labels.width() / 2) as f64, (labels.height() / 2) as f64);
    sums[1..]
        .iter()
        .map(|&(pixels, x, y)| {
            let (x, y) = if pixels > 0.0 {
                (x / pixels, y / pixels)
            } else {
                unseen
            };
            Middle { x, y, pixels }
        })
        .collect()
}

/// One circle per body, in the middle of what is seen of it and with a third of that area.
pub fn curves(labels: &Grid<u8>, bodies: usize) -> Vec<Shape> {
    middles(labels, bodies)
        .iter()
        .map(|middle| Shape::Circle {
            x: middle.x,
            y: middle.y,
            // At least half a pixel's diagonal, so that it encloses a pixel.
            r: (middle.pixels / (3.0 * std::f64::consts::PI))
                .sqrt()
                .max(0.75),
        })
        .collect()
}
