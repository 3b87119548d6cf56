//! Sparse matches between two frames: which point of the second shows what a point of the first shows.
//!
//! Both frames are taken less their local mean, so that a change of light does not matter. Blocks are searched for
//! from the first frame to the second and back; a match is kept where both ways agree to a pixel, and then brought to
//! sub-pixel. Around a tenth of the matches are wrong all the same: whoever uses them has to be robust.

use super::block_search::{Blocks, SPACING, point, search};
use super::box_mean::less_box_mean;
use super::lucas_kanade::track;
use crate::frames::halved;
use crate::grid::Grid;

/// Radius of the local mean in pixels, on each level of the search.
const MEAN_RADIUS: usize = 6;
/// The same for sub-pixel steps.
const FINE_MEAN_RADIUS: usize = 8;
/// The pyramid ends before its width or height falls below these.
const COARSEST: [usize; 2] = [40, 20];

/// A point of the first frame and where it is in the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Match {
    /// Column and row in the first frame.
    pub at: [f32; 2],
    /// Column and row in the second frame.
    pub to: [f32; 2],
    /// xx, xy and yy of Σ ∇I ∇Iᵀ over the 9×9 window, (grey levels/px)². With noise of σ grey levels the
    /// displacement's covariance is about 2σ² times its inverse.
    pub tensor: [f32; 3],
    /// Root mean square difference of the two windows, grey levels.
    pub residual: f32,
}

impl Match {
    /// Displacement in pixels.
    pub fn displacement(&self) -> [f32; 2] {
        [self.to[0] - self.at[0], self.to[1] - self.at[1]]
    }
}

/// Matches between two frames of the same size, grey levels 0–255; at most one for every 4×4 pixels, displacements up
/// to a fifth of the frame's width and height. Empty where the frames have no texture.
pub fn matches(first: &Grid<f32>, second: &Grid<f32>) -> Vec<Match> {
    debug_assert!(first.same_size(second));
    let (width, height) = (first.width(), first.height());
    let pyramids = [pyramid(first), pyramid(second)];
    let forward = search(&pyramids[0], &pyramids[1]);
    let backward = search(&pyramids[1], &pyramids[0]);
    let fine = [first, second].map(|frame| less_box_mean(frame, FINE_MEAN_RADIUS));
    let mut kept = Vec::new();
    for j in 0..forward.height() {
        for i in 0..forward.width() {
            let (at, displacement) = (point(i, j, width, height), forward[(i, j)]);
            if returns(&backward, at, displacement) {
                kept.extend(track(&fine[0], &fine[1], at, displacement));
            }
        }
    }
    kept
}

fn pyramid(frame: &Grid<f32>) -> Vec<Blocks> {
    let blocks = |frame: &Grid<f32>| Blocks::new(&less_box_mean(frame, MEAN_RADIUS));
    let mut levels = vec![blocks(frame)];
    let mut coarse = None;
    loop {
        let finer = coarse.as_ref().unwrap_or(frame);
        if finer.width() / 2 < COARSEST[0] || finer.height() / 2 < COARSEST[1] {
            return levels;
        }
        let next = halved(finer);
        levels.push(blocks(&next));
        coarse = Some(next);
    }
}

/// Whether one of the four points around the target leads back to within a pixel.
fn returns(backward: &Grid<[i32; 2]>, [x, y]: [i32; 2], [dx, dy]: [i32; 2]) -> bool {
    let spacing = SPACING as i32;
    let cell = |p: i32| (p - spacing / 2).div_euclid(spacing);
    let (i0, j0) = (cell(x + dx), cell(y + dy));
    let on = |k: i32, count: usize| k >= 0 && k < count as i32;
    [(0, 0), (1, 0), (0, 1), (1, 1)].iter().any(|&(oi, oj)| {
        let (i, j) = (i0 + oi, j0 + oj);
        on(i, backward.width()) && on(j, backward.height()) && {
            let [bx, by] = backward[(i as usize, j as usize)];
            (bx + dx).abs() <= 1 && (by + dy).abs() <= 1
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A smooth random texture, by waves of irrational directions.
    fn texture(x: f32, y: f32) -> f32 {
        let waves = [
            (0.9, 0.31, 0.2),
            (-0.43, 0.77, 1.1),
            (0.21, -0.57, 2.0),
            (0.13, 0.11, 0.7),
            (1.3, -0.9, 0.4),
            (0.37, 0.93, 2.9),
        ];
        let sum: f32 = waves
            .iter()
            .map(|(a, b, c)| {
                (a * x + b * y + c + 1.7 * (0.071 * x * a - 0.053 * y * b).sin()).sin()
            })
            .sum();
        127.0 + 18.0 * sum
    }

    fn shifted(width: usize, height: usize, dx: f32, dy: f32, gain: f32) -> Grid<f32> {
        Grid::from_fn(width, height, |x, y| {
            gain * texture(x as f32 - dx, y as f32 - dy)
        })
    }

    #[test]
    fn finds_a_large_shift_to_sub_pixel() {
        let (dx, dy) = (11.3, -6.7);
        let found = matches(
            &shifted(120, 90, 0.0, 0.0, 1.0),
            &shifted(120, 90, dx, dy, 1.1),
        );
        assert!(found.len() > 200, "{}", found.len());
        let right = found.iter().filter(|m| {
            let [u, v] = m.displacement();
            (u - dx).hypot(v - dy) < 0.15
        });
        assert!(right.count() * 10 > found.len() * 9);
    }

    #[test]
    fn says_nothing_without_texture() {
        let flat = Grid::new(32, 24, 90.0);
        assert!(matches(&flat, &flat).is_empty());
    }

    #[test]
    fn takes_the_smallest_frame() {
        let found = matches(
            &shifted(16, 16, 0.0, 0.0, 1.0),
            &shifted(16, 16, 1.0, 0.0, 1.0),
        );
        assert!(found.iter().all(|m| m.to[0].is_finite()));
    }
}
