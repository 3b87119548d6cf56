//! Signed distance to a polygon, in pixels, above 0 inside: at a point, and over a frame.
//!
//! Inside is what an even number of sides does not separate from infinity (even–odd rule). Over a frame that costs pixels
//! times corners only in principle: a side that is nearest to some pixel of a block is, from the block's middle, at most a
//! diagonal of the block farther away than the nearest one there. So a frame is halved again and again, each part keeping
//! the sides that may still be nearest; what is found is the same to the last bit.

use crate::grid::Grid;
use crate::ordered::ordered;
use crate::window::Window;

type Point = [f64; 2];

/// The sides, from each corner to the next and from the last to the first.
pub(crate) fn sides(corners: &[Point]) -> impl Iterator<Item = [Point; 2]> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&a, &b)| [a, b])
}

/// Distance of a point from a side.
fn distance([a, b]: [Point; 2], x: f64, y: f64) -> f64 {
    let (ex, ey) = (b[0] - a[0], b[1] - a[1]);
    let (px, py) = (x - a[0], y - a[1]);
    let length2 = ex * ex + ey * ey;
    let t = if length2 > 0.0 {
        ((px * ex + py * ey) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (px - t * ex).hypot(py - t * ey)
}

/// Where a side crosses row `y`.
fn crossing([a, b]: [Point; 2], y: f64) -> Option<f64> {
    let crosses = (a[1] > y) != (b[1] > y);
    crosses.then(|| a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
}

/// Signed distance of a point from the polygon with these corners.
pub(super) fn signed_distance(corners: &[Point], x: f64, y: f64) -> f64 {
    let nearest = sides(corners)
        .map(|side| distance(side, x, y))
        .fold(f64::INFINITY, f64::min);
    let beyond = sides(corners).filter_map(|side| crossing(side, y));
    let odd = beyond.filter(|&at| x < at).count() % 2 == 1;
    if odd { nearest } else { -nearest }
}

/// The same at every pixel of a `width × height` frame.
pub(super) fn level_set(corners: &[Point], width: usize, height: usize) -> Grid<f32> {
    let mut phi = Grid::new(width, height, 0.0);
    let all: Vec<[Point; 2]> = sides(corners).collect();
    nearest(&all, Window::whole(width, height), &mut phi);
    for y in 0..height {
        let beyond: Vec<f64> = all.iter().filter_map(|&s| crossing(s, y as f64)).collect();
        let beyond = ordered(beyond, |&at| at);
        let mut passed = 0;
        for x in 0..width {
            while beyond.get(passed).is_some_and(|&at| at <= x as f64) {
                passed += 1;
            }
            if (beyond.len() - passed).is_multiple_of(2) {
                phi[(x, y)] = -phi[(x, y)];
            }
        }
    }
    phi
}

/// Writes the distance of the nearest of `sides` to every pixel of `block`.
fn nearest(sides: &[[Point; 2]], block: Window, phi: &mut Grid<f32>) {
    let Window {
        left,
        top,
        width,
        height,
    } = block;
    let middle = |first: usize, count: usize| first as f64 + (count - 1) as f64 / 2.0;
    let (x, y) = (middle(left, width), middle(top, height));
    let each: Vec<f64> = sides.iter().map(|&side| distance(side, x, y)).collect();
    let least = each.iter().copied().fold(f64::INFINITY, f64::min);
    if width * height == 1 {
        phi[(left, top)] = least as f32;
        return;
    }
    // A little more than the diagonal, for what rounding does.
    let most = least + ((width - 1) as f64).hypot((height - 1) as f64) + 1e-6 * (1.0 + least);
    let kept = sides.iter().zip(&each).filter(|(_, d)| **d <= most);
    let kept: Vec<[Point; 2]> = kept.map(|(side, _)| *side).collect();
    let halves = if width >= height {
        let half = width / 2;
        [
            Window {
                width: half,
                ..block
            },
            Window {
                left: left + half,
                width: width - half,
                ..block
            },
        ]
    } else {
        let half = height / 2;
        [
            Window {
                height: half,
                ..block
            },
            Window {
                top: top + half,
                height: height - half,
                ..block
            },
        ]
    };
    for half in halves {
        nearest(&kept, half, phi);
    }
}
