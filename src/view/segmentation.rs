//! The curves on the frame, and labels as flat colours.

use super::palette::label_colour;
use super::stroke::{Segment, distances, paint};
use super::{Picture, ViewParams, mix};
use crate::curves::{Contour, contours as contours_of};
use crate::frames::Frame;
use crate::grid::Grid;
use crate::interpretation::Interpretation;

/// Dark rim that lets a curve be seen on any frame.
const RIM: [u8; 3] = [12, 12, 16];

/// The frame with a tint of colour in each region and the curves drawn over it: those given, or, when
/// there are none, the borders of the labels.
pub fn segmentation(
    frame: &Frame,
    found: &Interpretation,
    contours: &[Contour],
    params: &ViewParams,
) -> Picture {
    let m = params.magnify;
    let (width, height) = (frame.width() * m, frame.height() * m);
    let mut picture = Grid::from_fn(width, height, |x, y| {
        let at = (x / m, y / m);
        let label = found.labels[at];
        let tint = if label == 0 { 0.0 } else { params.tint as f32 };
        let [r, g, b] = mix(frame.rgb[at], label_colour(label), tint);
        [r, g, b, 255]
    });
    let derived;
    let contours = if contours.is_empty() {
        derived = label_contours(&found.labels);
        &derived
    } else {
        contours
    };
    // About two pixels on a small frame, thicker where a screen would shrink the picture.
    let radius = (width.min(height) as f32 / 480.0).clamp(1.0, 4.0);
    let lines: Vec<(u8, Grid<f32>)> = (0..=u8::MAX)
        .filter(|&label| contours.iter().any(|c| c.label == label))
        .map(|label| {
            let of_label = contours.iter().filter(|c| c.label == label);
            let segments = of_label.flat_map(|c| segments(c, m as f32));
            (label, distances(width, height, segments, radius + 2.0))
        })
        .collect();
    for (_, distance) in &lines {
        paint(&mut picture, distance, radius + 1.0, RIM, 0.75);
    }
    for (label, distance) in &lines {
        paint(&mut picture, distance, radius, label_colour(*label), 1.0);
    }
    picture
}

/// Labels as flat colours.
pub fn labels(found: &Interpretation) -> Picture {
    found.labels.map(|label| {
        let [r, g, b] = label_colour(label);
        [r, g, b, 255]
    })
}

/// Borders of all labels but the background's. The label's indicator is smoothed by a 3×3 binomial
/// before it is followed, which takes the stairs out of slanted borders.
fn label_contours(labels: &Grid<u8>) -> Vec<Contour> {
    let last = labels.data().iter().copied().max().unwrap_or(0);
    (1..=last)
        .flat_map(|k| {
            let phi = Grid::from_fn(labels.width(), labels.height(), |x, y| {
                let mut sum = 0.0;
                for dy in -1..=1_isize {
                    for dx in -1..=1_isize {
                        let weight = ((2 - dx.abs()) * (2 - dy.abs())) as f32;
                        if labels.clamped(x as isize + dx, y as isize + dy) == k {
                            sum += weight;
                        }
                    }
                }
                sum / 16.0 - 0.5
            });
            contours_of(&phi, k)
        })
        .collect()
}

fn segments(contour: &Contour, magnify: f32) -> Vec<Segment> {
    let points: Vec<[f32; 2]> = contour
        .points
        .iter()
        .map(|p| p.map(|c| (c + 0.5) * magnify - 0.5))
        .collect();
    let mut lines: Vec<Segment> = points.windows(2).map(|p| [p[0], p[1]]).collect();
    if let (true, Some(first), Some(last)) = (contour.closed, points.first(), points.last()) {
        lines.push([*last, *first]);
    }
    lines
}
