//! Antialiased lines: the distance of every pixel from a set of segments, then paint within a radius.

use super::{Picture, mix};
use crate::grid::Grid;

/// A line between two points in picture pixels.
pub(super) type Segment = [[f32; 2]; 2];

/// Distance in pixels from each pixel's centre to the nearest segment, infinite beyond `reach`.
pub(super) fn distances(
    width: usize,
    height: usize,
    segments: impl IntoIterator<Item = Segment>,
    reach: f32,
) -> Grid<f32> {
    let mut distance = Grid::new(width, height, f32::INFINITY);
    for [a, b] in segments {
        let range = |i: usize, side: usize| {
            let from = (a[i].min(b[i]) - reach).ceil().max(0.0) as usize;
            let to = (a[i].max(b[i]) + reach).floor().min(side as f32 - 1.0);
            from..(to + 1.0).max(0.0) as usize
        };
        let (ex, ey) = (b[0] - a[0], b[1] - a[1]);
        let length2 = ex * ex + ey * ey;
        for y in range(1, height) {
            for x in range(0, width) {
                let (px, py) = (x as f32 - a[0], y as f32 - a[1]);
                let t = if length2 > 0.0 {
                    ((px * ex + py * ey) / length2).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let d = (px - t * ex).hypot(py - t * ey);
                let nearest = &mut distance[(x, y)];
                *nearest = nearest.min(d);
            }
        }
    }
    distance
}

/// Paints what lies within `radius` pixels of the segments, the rim antialiased.
pub(super) fn paint(
    picture: &mut Picture,
    distance: &Grid<f32>,
    radius: f32,
    colour: [u8; 3],
    opacity: f32,
) {
    for (p, &d) in picture.data_mut().iter_mut().zip(distance.data()) {
        let cover = (radius + 0.5 - d).clamp(0.0, 1.0) * opacity;
        if cover > 0.0 {
            let [r, g, b] = mix([p[0], p[1], p[2]], colour, cover);
            *p = [r, g, b, 255];
        }
    }
}
