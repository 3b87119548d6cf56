//! Terrain: hills without end, y = −height(x, z), and the march of a ray through them.
//!
//! Heights are three octaves of noise on a lattice of nodes that repeats, joined by biquadratic
//! B-splines: the surface and its slopes are continuous, and one height costs nine nodes.

use glam::DVec3;

use super::noise::{plane_noise, split};
use super::solid::Hit;

/// Nodes along each side of the lattice, before it repeats.
const NODES: usize = 256;
/// Hills along each side of the lattice.
const HILLS: u32 = 16;
/// Nothing is met beyond this depth.
const FAR: f64 = 60.0;

/// A hilly land.
#[derive(Clone, Debug, PartialEq)]
pub struct Terrain {
    heights: Box<[f32]>,
    /// Nodes per unit of length.
    density: f64,
    /// Greatest height.
    highest: f64,
    /// Greatest slope.
    steepest: f64,
}

impl Terrain {
    /// Hills `spacing` apart, up to about `amplitude` above and below y = 0.
    pub fn new(amplitude: f64, spacing: f64, seed: u32) -> Self {
        let node = |i: usize| {
            let (x, z) = ((i % NODES) as f64, (i / NODES) as f64);
            let mut height = 0.0;
            for (octave, strength) in [1.0, 0.45, 0.16].iter().enumerate() {
                let period = HILLS << octave;
                let per = f64::from(period) / NODES as f64;
                height += strength * plane_noise(x * per, z * per, period, seed + octave as u32);
            }
            (1.3 * amplitude * height) as f32
        };
        let heights: Box<[f32]> = (0..NODES * NODES).map(node).collect();
        let density = NODES as f64 / (f64::from(HILLS) * spacing);
        let (mut highest, mut rise) = (0.0_f64, 0.0_f64);
        for (i, &h) in heights.iter().enumerate() {
            let right = heights[i / NODES * NODES + (i + 1) % NODES];
            let away = heights[(i + NODES) % heights.len()];
            highest = highest.max(f64::from(h));
            rise = rise.max(f64::from(right - h).hypot(f64::from(away - h)));
        }
        Self {
            heights,
            density,
            highest,
            steepest: rise * density,
        }
    }

    /// Height above y = 0 at (x, z), and its slopes along x and z.
    fn height(&self, x: f64, z: f64) -> [f64; 3] {
        let (x, z) = (x * self.density, z * self.density);
        let ((cx, fx), (cz, fz)) = (split(x + 0.5), split(z + 0.5));
        let (wx, sx) = spline(fx - 0.5);
        let (wz, sz) = spline(fz - 0.5);
        let at = |c: u32, k: u32| c.wrapping_add(k).wrapping_sub(1) as usize % NODES;
        let columns = [at(cx, 0), at(cx, 1), at(cx, 2)];
        let mut sum = [0.0; 3];
        for k in 0..3 {
            let row = &self.heights[at(cz, k as u32) * NODES..][..NODES];
            let h = columns.map(|c| f64::from(row[c]));
            let across = wx[0] * h[0] + wx[1] * h[1] + wx[2] * h[2];
            sum[0] += wz[k] * across;
            sum[1] += wz[k] * (sx[0] * h[0] + sx[1] * h[1] + sx[2] * h[2]);
            sum[2] += sz[k] * across;
        }
        [sum[0], sum[1] * self.density, sum[2] * self.density]
    }

    /// The first meeting of the ray o + t d with t > `from`, where it must still be above the land.
    ///
    /// Marches with steps that the steepest slope keeps from jumping over a hill, then closes in on
    /// the crossing by Newton's method, kept between its two sides by bisection, until the ray is
    /// within 1e-9 of the land.
    pub fn hit(&self, o: DVec3, d: DVec3, from: f64) -> Option<Hit> {
        if d.y <= 0.0 {
            return None;
        }
        // Height of the ray above the land, how that changes along it, and the upward normal.
        let above = |t: f64| {
            let [h, hx, hz] = self.height(o.x + t * d.x, o.z + t * d.z);
            (
                -(o.y + t * d.y) - h,
                -d.y - hx * d.x - hz * d.z,
                DVec3::new(-hx, -1.0, -hz),
            )
        };
        let mut t = ((-self.highest - o.y) / d.y).max(from);
        let fall = d.y + self.steepest * d.x.hypot(d.z);
        // Grazing rays end too: the land is smooth over less than a node.
        let least = 0.5 / self.density;
        let (mut gap, mut change, mut normal) = above(t);
        if gap < 0.0 && from > 0.0 {
            return self.hit(o, d, 0.0); // what was said of `from` does not hold
        }
        let mut outside = t;
        while gap > 0.0 {
            outside = t;
            t += (gap / fall).max(least);
            if t > FAR {
                return None;
            }
            (gap, change, normal) = above(t);
        }
        let mut inside = t;
        for _ in 0..40 {
            if gap.abs() < 1e-9 {
                break;
            }
            let newton = t - gap / change;
            t = if newton > outside && newton < inside {
                newton
            } else {
                0.5 * (outside + inside)
            };
            (gap, change, normal) = above(t);
            if gap > 0.0 {
                outside = t;
            } else {
                inside = t;
            }
        }
        Some(Hit {
            t,
            normal: normal.normalize(),
        })
    }
}

/// Weights of the three nodes round a place `f` from the middle one, |f| ≤ ½, and their slopes.
fn spline(f: f64) -> ([f64; 3], [f64; 3]) {
    let (l, r) = (0.5 - f, 0.5 + f);
    ([0.5 * l * l, 0.75 - f * f, 0.5 * r * r], [-l, -2.0 * f, r])
}
