//! What a surface looks like: its texture under lamp and sky.
//!
//! Brightness constancy is what the method reads motion by, so light is painted on the bodies: a
//! point's shade (Lambert, highlight, sky, the shadow of its own body, haze) is that of the first
//! frame in both. Shadows that one body casts on another follow [`Shadows`]. Light samples differ between the nine places
//! of a pixel's lattice, which smooths penumbras without noise. Nothing is allocated per ray.

use glam::DVec3;

use super::cast::{Caster, Seen, to_part};
use super::picture::FINE;
use super::stage::{Shadows, Stage};

/// Light rays per sample; all nine samples of a pixel use different ones.
const LIGHT_RAYS: usize = 12;

impl Caster<'_> {
    /// Linear light of what is `seen` through `(px, py)`; `lattice` from 0 to 8 picks the light
    /// samples.
    pub(super) fn colour(&self, px: f64, py: f64, seen: &Seen, lattice: usize) -> DVec3 {
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

/// Directions spread evenly over the lamp's disc along a sunflower spiral, dealt out so that each
/// place of the lattice gets some of every radius.
pub(super) fn lamp_directions(stage: &Stage) -> Vec<DVec3> {
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
