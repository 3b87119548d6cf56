//! A region of patches as a polygon in the frame.
//!
//! What a region's patches cost less under it than under any other is interpolated between patches; its
//! outline is where that is zero ([`contours`]), its corners are those without which the outline would be
//! off by more than [`OFF`] (Ramer 1972; Douglas and Peucker 1973). Where a region goes on beyond the
//! frame, the polygon runs along the frame's border.

use super::block_search::SPACING;
use crate::curves::{contours, sides};
use crate::grid::Grid;

/// Polygons smaller than this share of the frame are dropped.
const SMALLEST: f64 = 0.01;
/// So are those whose area is a smaller share of a circle's of the same length.
const COMPACT: f64 = 0.2;
/// How far a polygon may be off the outline, as a share of the frame's longer side.
const OFF: f64 = 0.005;

/// A polygon in pixels of the frame.
pub(crate) struct Outline {
    /// Its corners, to a tenth of a pixel.
    pub corners: Vec<[f64; 2]>,
    /// Its area, as a share of the frame's.
    pub share: f64,
}

/// A number for each place of the lattice of a frame of so many columns and rows, at each pixel.
pub(super) fn at_pixels(field: &Grid<f32>, [width, height]: [usize; 2]) -> Grid<f32> {
    let place = |at: usize| (at as f32 - (SPACING / 2) as f32) / SPACING as f32;
    Grid::from_fn(width, height, |x, y| field.bilinear(place(x), place(y)))
}

/// The outlines of where a number for each pixel is above 0, in pixels of a `frame` of another size.
pub(crate) fn outlines(level_set: &Grid<f32>, frame: [usize; 2]) -> Vec<Outline> {
    let small = [level_set.width(), level_set.height()];
    let grow = |value: f32, k: usize| {
        let factor = frame[k] as f64 / small[k] as f64;
        let at = (f64::from(value) + 0.5) * factor - 0.5;
        (10.0 * at.clamp(0.0, (frame[k] - 1) as f64)).round() / 10.0
    };
    let [width, height] = frame;
    let whole = (width * height) as f64;
    let off = OFF * width.max(height) as f64;
    contours(level_set, 1)
        .into_iter()
        .map(|contour| {
            let points: Vec<[f64; 2]> = contour
                .points
                .iter()
                .map(|&[x, y]| [grow(x, 0), grow(y, 1)])
                .collect();
            let corners = simplified(&points, off);
            let share = area(&corners) / whole;
            Outline { corners, share }
        })
        // Holes have areas below 0.
        .filter(|outline| outline.share >= SMALLEST && compact(&outline.corners))
        .collect()
}

/// A closed line without the points that are within `off` of what is left.
fn simplified(points: &[[f64; 2]], off: f64) -> Vec<[f64; 2]> {
    let Some(&first) = points.first() else {
        return Vec::new();
    };
    // Two corners that surely stay: the first point, and the farthest from it.
    let apart = |p: &[f64; 2]| (p[0] - first[0]).hypot(p[1] - first[1]);
    let far = (0..points.len())
        .max_by(|&a, &b| apart(&points[a]).total_cmp(&apart(&points[b])))
        .unwrap_or(0);
    let back = [&points[far..], &[first]].concat();
    let mut corners = Vec::new();
    for half in [&points[..=far], &back] {
        corners.push(half[0]);
        keep(half, off, &mut corners);
    }
    corners
}

/// Adds the points strictly between the ends of a line that must stay.
fn keep(line: &[[f64; 2]], off: f64, kept: &mut Vec<[f64; 2]>) {
    let (Some(&a), Some(&b)) = (line.first(), line.last()) else {
        return;
    };
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx.hypot(dy);
    let distance = |p: &[f64; 2]| {
        let (x, y) = (p[0] - a[0], p[1] - a[1]);
        if length > 0.0 {
            (x * dy - y * dx).abs() / length
        } else {
            x.hypot(y)
        }
    };
    let inner = 1..line.len().saturating_sub(1).max(1);
    let farthest = inner.max_by(|&i, &j| distance(&line[i]).total_cmp(&distance(&line[j])));
    if let Some(i) = farthest
        && distance(&line[i]) > off
    {
        keep(&line[..=i], off, kept);
        kept.push(line[i]);
        keep(&line[i..], off, kept);
    }
}

/// Above 0 when the corners run clockwise on the screen.
fn area(corners: &[[f64; 2]]) -> f64 {
    let each = sides(corners).map(|[a, b]| a[0] * b[1] - b[0] * a[1]);
    0.5 * each.sum::<f64>()
}

fn compact(corners: &[[f64; 2]]) -> bool {
    let around: f64 = sides(corners)
        .map(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1]))
        .sum();
    4.0 * std::f64::consts::PI * area(corners) >= COMPACT * around * around
}
