//! Image motion as arrows over the dimmed frame.

use super::flow::full_speed;
use super::palette::label_colour;
use super::stroke::{Segment, distances, paint};
use super::{Picture, ViewParams, dimmed};
use crate::frames::Frame;
use crate::grid::Grid;
use crate::interpretation::Interpretation;

/// Length of an arrow at full speed, as a share of the distance between arrows.
const LONGEST: f32 = 0.92;
/// Arrows shorter than this many pixels are dots.
const LEAST: f32 = 1.5;

/// Arrows on a regular grid in the colours of their regions, white in the background, lengthened by
/// one factor so that the fastest (98th percentile, or [`ViewParams::speed`]) nearly fill it. A dot
/// is rest; unknown flow has none.
pub fn arrows(frame: &Frame, found: &Interpretation, params: &ViewParams) -> Picture {
    let (width, height) = (frame.width(), frame.height());
    let m = params.magnify as f32;
    let automatic = (width.max(height) as f64 / 26.0).clamp(10.0, 96.0);
    let spacing = params.spacing.unwrap_or(automatic) as f32;
    let gain = LONGEST * spacing * m / full_speed(found, params);
    let longest = 1.6 * spacing * m;
    let mut of_label: Vec<Vec<Segment>> = vec![Vec::new(); 256];
    let mut dots: Vec<Segment> = Vec::new();
    // As many as fit, the rest shared by both margins.
    let places = |side: usize| -> Vec<usize> {
        let count = ((side as f32 / spacing).floor() as usize).max(1);
        let margin = (side as f32 - 1.0 - (count - 1) as f32 * spacing) / 2.0;
        let place = |i: usize| (margin + i as f32 * spacing).round().max(0.0) as usize;
        (0..count).map(place).filter(|&p| p < side).collect()
    };
    for y in places(height) {
        for &x in &places(width) {
            let (u, v) = (found.flow.u[(x, y)], found.flow.v[(x, y)]);
            if !(u.is_finite() && v.is_finite()) {
                continue;
            }
            let from = [x as f32, y as f32].map(|c| (c + 0.5) * m - 0.5);
            let length = u.hypot(v) * gain;
            if length < LEAST {
                dots.push([from, from]);
                continue;
            }
            let shorten = (longest / length).min(1.0);
            let vector = [u * gain * shorten, v * gain * shorten];
            let lines = &mut of_label[usize::from(found.labels[(x, y)])];
            lines.extend(arrow(from, vector, length * shorten, spacing * m));
        }
    }
    let radius = (spacing * m / 26.0).clamp(0.55, 3.0);
    let mut picture = dimmed(frame, params.dim, params.magnify);
    let resting = distances(picture.width(), picture.height(), dots, radius + 2.0);
    paint(&mut picture, &resting, 0.8 * radius, [245, 245, 245], 0.45);
    let drawn: Vec<(u8, Grid<f32>)> = of_label
        .into_iter()
        .enumerate()
        .filter(|(_, lines)| !lines.is_empty())
        .map(|(k, lines)| {
            let (w, h) = (picture.width(), picture.height());
            (k as u8, distances(w, h, lines, radius + 2.0))
        })
        .collect();
    for (_, distance) in &drawn {
        paint(&mut picture, distance, radius + 0.9, [8, 8, 12], 0.65);
    }
    for (label, distance) in &drawn {
        let colour = match label {
            0 => [245, 245, 245],
            k => label_colour(*k),
        };
        paint(&mut picture, distance, radius, colour, 1.0);
    }
    picture
}

/// Shaft and two barbs.
fn arrow(from: [f32; 2], vector: [f32; 2], length: f32, spacing: f32) -> Vec<Segment> {
    // Centred on its pixel, so that neighbouring arrows keep their distance.
    let tail = [from[0] - vector[0] / 2.0, from[1] - vector[1] / 2.0];
    let tip = [from[0] + vector[0] / 2.0, from[1] + vector[1] / 2.0];
    let barb = (0.38 * length).min(0.3 * spacing).max(1.5);
    let (dx, dy) = (vector[0] / length * barb, vector[1] / length * barb);
    let side = |s: f32| {
        [
            tip[0] - 0.85 * dx - s * 0.55 * dy,
            tip[1] - 0.85 * dy + s * 0.55 * dx,
        ]
    };
    vec![[tail, tip], [tip, side(1.0)], [tip, side(-1.0)]]
}
