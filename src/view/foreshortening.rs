//! How deep a surface is drawn, so that it can be looked at from the side.
//!
//! ```text
//! 1/Z' = (1/Z + b/Zm) / (1 + b)          Zm the middle depth, b ≥ 0
//! ```
//!
//! What reaches far, a street or a floor up to a wall, would be a spike towards the eye with a huge wall behind it, and
//! the far end, where depth is least certain, the most of the picture. So sculptors foreshorten: this maps planes to
//! planes and leaves every point on its line of sight, at b = 0 as it is and flat for large b (relief perspective).
//! b is such that the surface is drawn as deep as [`DEEPEST`]. A shallow surface is deepened in proportion instead.

use glam::Vec3;

/// The depth drawn, as a share of the width, between which it is left as it is.
const SHALLOWEST: f32 = 0.35;
const DEEPEST: f32 = 0.8;
/// Shallow reliefs are deepened by no more than this: past it, one would look at noise.
const MOST: f32 = 3.0;

/// Foreshortens `rho`, whose farthest, middle and nearest without the wildest are `range`, if that reaches far. `side` is
/// the frame's longer side over f. Gives the same three as they are then.
pub(super) fn foreshorten(rho: &mut [f32], range: [f32; 3], side: f32) -> [f32; 3] {
    let [far, middle, near] = range;
    // The frame's size at the middle depth is what depth is a share of.
    let ratio = (middle / far - middle / near) / side;
    if ratio <= DEEPEST {
        return range;
    }
    let b = foreshortening(near / middle, far / middle, DEEPEST * side);
    let map = |rho: f32| (rho + b * middle) / (1.0 + b);
    for value in rho {
        *value = map(*value);
    }
    range.map(map)
}

/// Brings points on their lines of sight, z towards the eye that is at the origin, into a box of about −1 to 1 in x or y.
/// `range` are their farthest, middle and nearest 1/Z. `deepen` multiplies depth; `None` chooses.
/// Gives the factor.
pub(super) fn boxed(points: &mut [Vec3], range: [f32; 3], side: f32, deepen: Option<f32>) -> f32 {
    let [far, middle, near] = range.map(f32::recip);
    let across = side * middle;
    let ratio = (far - near) / across;
    let automatic = (SHALLOWEST / ratio.max(1e-6)).clamp(1.0, MOST);
    let origin = Vec3::new(0.0, 0.0, -(near + far) / 2.0);
    let deepened = deepen.unwrap_or(automatic);
    let scale = Vec3::new(1.0, 1.0, deepened) * 2.0 / across;
    for p in points {
        *p = (*p - origin) * scale;
    }
    deepened
}

/// b, for 1/Z in units of 1/Zm and a `depth` to be drawn in units of Zm: the positive root of
/// (1 + b) (near − far) = depth (near + b) (far + b).
fn foreshortening(near: f32, far: f32, depth: f32) -> f32 {
    let half = 0.5 * ((near + far) - (near - far) / depth);
    let rest = near * far - (near - far) / depth;
    ((half * half - rest).max(0.0).sqrt() - half).max(0.0)
}
