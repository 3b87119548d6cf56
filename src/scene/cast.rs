//! The ray caster: what a pixel of either frame shows.
//!
//! Brightness constancy is what the method reads motion by, so light is painted on the bodies: a
//! point's shade (Lambert, highlight, sky, the shadow of its own body, haze) is that of the first
//! frame in both. Shadows that one body casts on another follow [`Shadows`].
//!
//! A frame is sampled 3×3 times per pixel on a regular lattice and filtered by a tent two pixels
//! wide (weights 1 2 3 2 1 each way, shared between neighbours), in linear light, then encoded as
//! sRGB and rounded to whole numbers as a PNG would. Light samples differ between the nine places of
//! the lattice, which smooths penumbras without noise. Nothing is allocated per ray.

use glam::{DMat3, DVec3};

use super::stage::{Part, Shadows, Stage};
use crate::camera::Camera;

/// Samples per pixel, each way.
const FINE: usize = 3;
/// Light rays per sample; all nine samples of a pixel use different ones.
const LIGHT_RAYS: usize = 12;
/// Depth of what no ray meets.
const FAR: f64 = 1000.0;

/// One of the two moments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moment {
    /// The first frame.
    First,
    /// The second frame.
    Second,
}

/// What a ray meets.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Depth Z at that moment.
    pub depth: f64,
    /// The body, which is also the label.
    pub body: usize,
    part: usize,
    normal: DVec3,
}

/// A stage at one moment, ready for rays.
pub struct Caster<'a> {
    stage: &'a Stage,
    camera: Camera,
    bodies: Vec<Frame>,
    /// Bounding spheres at that moment.
    bounds: Vec<(DVec3, f64)>,
    lamps: Vec<DVec3>,
}

/// A body's place at a moment: P ↦ rotation · P + shift takes it there from the first frame.
struct Frame {
    rotation: DMat3,
    back: DMat3,
    shift: DVec3,
}

impl Frame {
    fn to_first(&self, p: DVec3) -> DVec3 {
        self.back * (p - self.shift)
    }
}

impl<'a> Caster<'a> {
    /// Sets `stage` to `moment`.
    pub fn new(stage: &'a Stage, camera: Camera, moment: Moment) -> Self {
        let bodies: Vec<Frame> = stage
            .motions
            .iter()
            .map(|motion| {
                let (rotation, shift) = match moment {
                    Moment::First => (DMat3::IDENTITY, DVec3::ZERO),
                    Moment::Second => (motion.matrix(), motion.translation),
                };
                Frame {
                    rotation,
                    back: rotation.transpose(),
                    shift,
                }
            })
            .collect();
        let bounds = stage
            .parts
            .iter()
            .map(|part| {
                let body = &bodies[part.body];
                (
                    body.rotation * part.pose.centre + body.shift,
                    part.solid.bound(),
                )
            })
            .collect();
        Self {
            stage,
            camera,
            bodies,
            bounds,
            lamps: lamp_directions(stage),
        }
    }

    /// The nearest surface that the ray through pixel `(px, py)` meets; the far background when none.
    pub fn look(&self, px: f64, py: f64) -> Seen {
        self.look_beyond(px, py, 0.0)
    }

    /// The same, told that terrain is no nearer than depth `from`.
    fn look_beyond(&self, px: f64, py: f64, from: f64) -> Seen {
        let d = self.camera.ray(px, py);
        let d2 = d.length_squared();
        let mut seen = Seen {
            depth: FAR,
            body: 0,
            part: usize::MAX,
            normal: -d,
        };
        for (i, part) in self.stage.parts.iter().enumerate() {
            let (c, r) = self.bounds[i];
            let along = c.dot(d);
            if r.is_finite() && (c.length_squared() - r * r) * d2 > along * along {
                continue;
            }
            let body = &self.bodies[part.body];
            let (o, d) = (body.to_first(DVec3::ZERO), body.back * d);
            let (o, d) = to_part(part, o, d);
            if let Some(hit) = part.solid.hit(o, d, from)
                && hit.t < seen.depth
            {
                seen = Seen {
                    depth: hit.t,
                    body: part.body,
                    part: i,
                    normal: hit.normal,
                };
            }
        }
        seen
    }

    /// The whole picture, sRGB 0–255 in whole numbers.
    pub fn picture(&self, width: usize, height: usize) -> Vec<[f32; 3]> {
        const TENT: [f64; 2 * FINE - 1] = [1.0, 2.0, 3.0, 2.0, 1.0];
        let step = 1.0 / FINE as f64;
        // One fine row beyond the frame on each side, all filtered along x at once, summed along y.
        let mut out = vec![DVec3::ZERO; width * height];
        let mut fine = vec![DVec3::ZERO; (width + 2) * FINE];
        let lead = FINE as isize;
        // Rows from the bottom up: terrain recedes along them, so that what the row below met, less a
        // fiftieth for the columns' slant, bounds what this one can meet.
        let mut below = vec![0.0; fine.len()];
        for j in (-1..=(height * FINE) as isize).rev() {
            let y = (j as f64 - 1.0) * step;
            let mut left = f64::INFINITY;
            for (i, sample) in fine.iter_mut().enumerate() {
                let x = (i as isize - lead - 1) as f64 * step;
                let right = below.get(i + 1).copied().unwrap_or(f64::INFINITY);
                let from = 0.98 * below[i].min(left).min(right);
                left = below[i];
                let lattice = i % FINE + FINE * (j + lead) as usize % (FINE * FINE);
                let seen = self.look_beyond(x, y, from);
                below[i] = seen.depth;
                *sample = self.colour(x, y, &seen, lattice);
            }
            for (k, weight) in TENT.iter().enumerate() {
                // Row y of pixels has its centre at fine row 3y + 1.
                let centre = j - (k as isize - 2);
                let row = (centre - 1).div_euclid(lead);
                if (centre - 1).rem_euclid(lead) != 0 || row < 0 || row >= height as isize {
                    continue;
                }
                let row = row as usize * width;
                for (x, pixel) in out[row..row + width].iter_mut().enumerate() {
                    let first = x * FINE + FINE - 1;
                    let mut sum = DVec3::ZERO;
                    for (s, w) in fine[first..first + TENT.len()].iter().zip(TENT) {
                        sum += *s * w;
                    }
                    *pixel += sum * (weight / 81.0);
                }
            }
        }
        out.iter().map(|&c| encode(c)).collect()
    }

    /// Linear light of what is `seen` through `(px, py)`; `lattice` from 0 to 8 picks the light
    /// samples.
    fn colour(&self, px: f64, py: f64, seen: &Seen, lattice: usize) -> DVec3 {
        let light = &self.stage.light;
        let (loss, haze) = self.stage.haze;
        if seen.part == usize::MAX {
            return haze;
        }
        let part = &self.stage.parts[seen.part];
        let now = self.camera.ray(px, py) * seen.depth;
        let first = self.bodies[part.body].to_first(now);
        let local = part.pose.rotation.transpose() * (first - part.pose.centre);
        let normal = part.pose.direction(seen.normal);
        let distance = first.length();
        let view = -first / distance;
        let facing = normal.dot(view).clamp(0.1, 1.0);
        let footprint = distance / self.camera.focal / facing.sqrt();
        let albedo = part.material.texture.colour(local, footprint);

        let lambert = normal.dot(light.lamp).max(0.0);
        let lit = if lambert > 0.0 {
            self.lit(seen.part, now, first, lattice)
        } else {
            0.0
        };
        let sky = 0.7 + 0.3 * normal.dot(light.up);
        let mut colour = albedo
            * (light.lamp_colour * (lambert * lit)
                + light.fill_colour * normal.dot(light.fill).max(0.0)
                + light.ambient * sky);
        if part.material.shine > 0.0 && lit > 0.0 {
            let half = (light.lamp + view).normalize();
            let glint = normal.dot(half).max(0.0).powf(part.material.gloss);
            colour += light.lamp_colour * (part.material.shine * glint * lit);
        }
        if loss > 0.0 {
            colour = haze.lerp(colour, (-loss * distance).exp());
        }
        colour
    }

    /// The share of the lamp that a point of part `at` sees; the point is `now` at this moment and
    /// `first` in the first frame.
    fn lit(&self, at: usize, now: DVec3, first: DVec3, lattice: usize) -> f64 {
        let light = &self.stage.light;
        let receiver = self.stage.parts[at].body;
        let rays = &self.lamps[lattice * LIGHT_RAYS..(lattice + 1) * LIGHT_RAYS];
        let mut dark = [false; LIGHT_RAYS];
        for (i, part) in self.stage.parts.iter().enumerate() {
            let radius = part.solid.bound();
            if i == at || !radius.is_finite() {
                continue; // convex solids and floors hide nothing from themselves
            }
            let painted = part.body == receiver || self.stage.shadows == Shadows::Painted;
            let (o, centre) = if painted {
                (first, part.pose.centre)
            } else {
                (now, self.bounds[i].0)
            };
            let to = centre - o;
            let along = to.dot(light.lamp);
            let reach = radius + along.max(0.0) * light.softness * 1.1;
            if along < -radius || to.length_squared() - along * along > reach * reach {
                continue;
            }
            let body = &self.bodies[part.body];
            for (ray, dark) in rays.iter().zip(&mut dark) {
                if *dark {
                    continue;
                }
                let (o, d) = if painted {
                    (o, *ray)
                } else {
                    (body.to_first(o), body.back * *ray)
                };
                let (o, d) = to_part(part, o, d);
                *dark = part.solid.hit(o, d, 0.0).is_some();
            }
        }
        let hidden = dark.iter().filter(|&&d| d).count();
        1.0 - hidden as f64 / LIGHT_RAYS as f64
    }
}

/// A ray of the first frame in the frame of `part`.
fn to_part(part: &Part, o: DVec3, d: DVec3) -> (DVec3, DVec3) {
    let back = part.pose.rotation.transpose();
    (back * (o - part.pose.centre), back * d)
}

/// Directions spread evenly over the lamp's disc along a sunflower spiral, dealt out so that each
/// place of the lattice gets some of every radius.
fn lamp_directions(stage: &Stage) -> Vec<DVec3> {
    let count = FINE * FINE * LIGHT_RAYS;
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let lamp = stage.light.lamp;
    let (a, b) = lamp.any_orthonormal_pair();
    let direction = |n: usize| {
        let r = stage.light.softness * ((n as f64 + 0.5) / count as f64).sqrt();
        let angle = golden * n as f64;
        (lamp + a * (r * angle.cos()) + b * (r * angle.sin())).normalize()
    };
    (0..count)
        .map(|n| direction(n % LIGHT_RAYS * FINE * FINE + n / LIGHT_RAYS))
        .collect()
}

/// Linear light as sRGB 0–255, in whole numbers.
fn encode(linear: DVec3) -> [f32; 3] {
    linear.to_array().map(|c| {
        let c = c.clamp(0.0, 1.0);
        let s = if c <= 0.003_130_8 {
            12.92 * c
        } else {
            1.055 * c.powf(1.0 / 2.4) - 0.055
        };
        (255.0 * s).round() as f32
    })
}
