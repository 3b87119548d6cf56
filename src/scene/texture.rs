//! Solid textures: a colour for every point of a body, so that it is carved out of its material and
//! no seam or stretching shows, whatever its shape.
//!
//! Colours are linear light, red green blue, 0–1. Every texture has detail at many scales at once:
//! image motion of a pixel or less is read from the finest, the eye reads the coarsest.

use glam::DVec3;

use super::noise::octaves;
use crate::srgb::decode;

/// How a colour between the three of a texture is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pattern {
    /// The middle colour alone.
    Plain,
    /// Clouds.
    Mottle,
    /// Veins of the third colour through clouds of the first two.
    Marble,
    /// Spots of the third colour on clouds of the first two.
    Speckle,
    /// Bands across y, bent by noise: layers of rock, or strands.
    Strata,
}

/// A material's colour throughout space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture {
    /// How the colours are mixed.
    pub pattern: Pattern,
    /// Dark, middle, light; linear light.
    pub colours: [DVec3; 3],
    /// Size of the coarsest structure, in the scene's unit.
    pub scale: f64,
    /// Strength of the brightness grain laid over the pattern, 0 none, 1 strong.
    pub grain: f64,
    /// Which one of all such textures.
    pub seed: u32,
}

impl Texture {
    /// The colour at `p` in the body's frame, where a pixel is `footprint` wide.
    pub fn colour(&self, p: DVec3, footprint: f64) -> DVec3 {
        let [dark, middle, light] = self.colours;
        let s = self.scale;
        let seed = self.seed.wrapping_mul(101);
        let colour = match self.pattern {
            Pattern::Plain => middle,
            Pattern::Mottle => {
                let x = octaves(p, s, 0.75, footprint, seed);
                ramp(&self.colours, 0.5 + 0.9 * x)
            }
            Pattern::Marble => {
                let bend = octaves(p, s, 0.6, footprint, seed);
                let axis = DVec3::new(0.62, 0.45, 0.64);
                let wave = (p.dot(axis) / s * 1.3 + 2.6 * bend) * std::f64::consts::PI;
                let vein = 1.0 - wave.sin().abs();
                let ground = dark.lerp(middle, (0.5 + 1.2 * bend).clamp(0.0, 1.0));
                ground.lerp(light, vein * vein * vein)
            }
            Pattern::Speckle => {
                let ground = octaves(p, s, 0.6, footprint, seed);
                let spots = octaves(p, 0.2 * s, 0.4, footprint, seed.wrapping_add(50));
                let spot = smoothstep(0.08, 0.28, spots);
                dark.lerp(middle, (0.5 + ground).clamp(0.0, 1.0))
                    .lerp(light, spot)
            }
            Pattern::Strata => {
                let bend = octaves(p, 2.0 * s, 0.6, footprint, seed);
                let wave = ((p.y / s + 1.1 * bend) * std::f64::consts::TAU).sin();
                ramp(&self.colours, 0.5 + 0.45 * wave)
            }
        };
        if self.grain <= 0.0 {
            return colour;
        }
        let grain = octaves(p, 0.25 * s, 0.85, footprint, seed.wrapping_add(77));
        colour * (1.0 + 1.8 * self.grain * grain).max(0.05)
    }
}

/// The colour 0xRRGGBB, as a screen shows it, in linear light.
pub fn srgb(hex: u32) -> DVec3 {
    let channel = |shift: u32| {
        let byte = (hex >> shift) & 255;
        decode(f64::from(byte) / 255.0)
    };
    DVec3::new(channel(16), channel(8), channel(0))
}

/// Three colours by [`srgb`].
#[inline(never)]
pub fn palette(dark: u32, middle: u32, light: u32) -> [DVec3; 3] {
    [srgb(dark), srgb(middle), srgb(light)]
}

fn ramp(colours: &[DVec3; 3], x: f64) -> DVec3 {
    let x = 2.0 * x.clamp(0.0, 1.0);
    if x < 1.0 {
        colours[0].lerp(colours[1], x)
    } else {
        colours[1].lerp(colours[2], x - 1.0)
    }
}

fn smoothstep(a: f64, b: f64, x: f64) -> f64 {
    let s = ((x - a) / (b - a)).clamp(0.0, 1.0);
    s * s * (3.0 - 2.0 * s)
}
