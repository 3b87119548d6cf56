//! Image motion as colour: hue is the direction, strength of colour the speed, white is rest.
//!
//! Right is red, down yellow, left green-blue, up violet.

use super::colour::from_oklch;
use super::span::percentile;
use super::{Picture, ViewParams, hatched, mix};
use crate::grid::Grid;
use crate::interpretation::Interpretation;

const REST: [u8; 3] = [250, 250, 250];
/// Directions told apart by the wheel.
const DIRECTIONS: usize = 360;
/// Slower than this in pixels per frame, a whole field counts as at rest: its colours would be noise.
const LEAST_SPEED: f32 = 0.01;

/// Flow in colours; full colour is [`ViewParams::speed`] or the 98th percentile of speed. Unknown
/// flow is hatched dark grey.
pub fn flow(found: &Interpretation, params: &ViewParams) -> Picture {
    let (u, v) = (&found.flow.u, &found.flow.v);
    let full = full_speed(found, params);
    let wheel = wheel();
    let mut picture = Grid::from_fn(u.width(), u.height(), |x, y| {
        let (u, v) = (u[(x, y)], v[(x, y)]);
        let [r, g, b] = if u.is_finite() && v.is_finite() {
            colour(&wheel, u / full, v / full)
        } else if hatched(x, y) {
            [70, 70, 76]
        } else {
            [52, 52, 58]
        };
        [r, g, b, 255]
    });
    if params.legend {
        legend(&mut picture, &wheel);
    }
    picture
}

/// Colours of full speed in each direction, from right clockwise on screen.
pub fn wheel() -> Vec<[u8; 3]> {
    (0..DIRECTIONS)
        .map(|degree| {
            let angle = degree as f32;
            // Yellow is a light colour and blue a dark one; lightness follows them a little, so that
            // both are vivid.
            let lightness = 0.70 + 0.14 * (angle - 85.0).to_radians().cos();
            from_oklch(lightness, 0.21, angle + 25.0)
        })
        .collect()
}

/// Speed in pixels per frame that gets full colour.
pub(super) fn full_speed(found: &Interpretation, params: &ViewParams) -> f32 {
    if let Some(speed) = params.speed {
        return speed as f32;
    }
    let pairs = found.flow.u.data().iter().zip(found.flow.v.data());
    let mut speeds: Vec<f32> = pairs
        .map(|(u, v)| u.hypot(*v))
        .filter(|s| s.is_finite())
        .collect();
    let speed = percentile(&mut speeds, 0.98).unwrap_or(0.0);
    if speed > 0.0 {
        speed.max(LEAST_SPEED)
    } else {
        // Everything at rest or little moves: the fastest.
        speeds.iter().fold(LEAST_SPEED, |a, &b| a.max(b))
    }
}

fn colour(wheel: &[[u8; 3]], u: f32, v: f32) -> [u8; 3] {
    let degree = v.atan2(u).to_degrees().rem_euclid(360.0).round() as usize;
    mix(REST, wheel[degree % DIRECTIONS], u.hypot(v))
}

/// The wheel itself in the lower right corner, with a rim.
fn legend(picture: &mut Picture, wheel: &[[u8; 3]]) {
    let (width, height) = (picture.width(), picture.height());
    let radius = (0.085 * width.min(height) as f32).max(7.0);
    let (cx, cy) = (width as f32 - 1.6 * radius, height as f32 - 1.6 * radius);
    let from = |c: f32| (c - radius - 3.0).max(0.0) as usize;
    for y in from(cy)..height {
        for x in from(cx)..width {
            let (dx, dy) = ((x as f32 - cx) / radius, (y as f32 - cy) / radius);
            let edge = (1.0 - dx.hypot(dy)) * radius;
            let p = &mut picture[(x, y)];
            let below = [p[0], p[1], p[2]];
            let rimmed = mix(below, [40, 40, 46], (edge + 2.5).clamp(0.0, 1.0));
            let [r, g, b] = mix(rimmed, colour(wheel, dx, dy), (edge + 0.5).clamp(0.0, 1.0));
            *p = [r, g, b, 255];
        }
    }
}
