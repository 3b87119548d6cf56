//! Where a surface is torn: depth leaps there, and what would join both sides is not in the picture.
//!
//! A triangle is a tear where it is steep and either spans much depth by itself or lies where depth leaps within a few
//! vertices: solvers spread a leap over some pixels, and each triangle of that spans little. The wall beside a nose
//! stays, the one behind a hill goes. Depth is that of the box in which the surface is drawn, 2 wide, except that a leap is
//! a ratio of true depths: a shallow relief is drawn deeper than it is. Widths are those seen in the frame, in the same
//! unit, or what leads away along a line of sight would pass for wide.

use glam::Vec2;

/// Steepest surface: depth over width.
const STEEPEST: f32 = 4.0;
/// Most depth that a triangle spans, however steep.
const HIGHEST: f32 = 0.15;
/// The ratio of depths that makes a leap, and the vertices on each side within which it does.
const LEAP: (f32, usize) = (1.5, 3);

/// For each of the `columns × rows` vertices that stand in a grid, row by row, whether depth leaps around it within its
/// region: `depth` is Z, `labels` the regions.
pub(super) fn leaps(depth: &[f32], labels: &[u8], [columns, rows]: [usize; 2]) -> Vec<bool> {
    let around = |at: usize, side: usize| at.saturating_sub(LEAP.1)..(at + LEAP.1 + 1).min(side);
    let leaps = |i: usize| {
        let (x, y) = (i % columns, i / columns);
        let (mut least, mut most) = (f32::INFINITY, 0.0f32);
        for y in around(y, rows) {
            for j in around(x, columns).map(|x| y * columns + x) {
                if labels[j] == labels[i] {
                    least = least.min(depth[j]);
                    most = most.max(depth[j]);
                }
            }
        }
        most > LEAP.0 * least
    };
    (0..columns * rows).map(leaps).collect()
}

/// A corner of a triangle.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    /// Where it is seen, in half the frame's longer side.
    pub place: Vec2,
    /// Depth as drawn.
    pub depth: f32,
    /// Whether depth leaps around it.
    pub leaps: bool,
}

/// Whether a triangle is a tear.
pub(super) fn torn([a, b, c]: [Corner; 3]) -> bool {
    let leap = a.leaps || b.leaps || c.leaps;
    [(a, b), (b, c), (c, a)].iter().any(|(p, q)| {
        let deep = (p.depth - q.depth).abs();
        deep > STEEPEST * p.place.distance(q.place) && (leap || deep > HIGHEST)
    })
}
