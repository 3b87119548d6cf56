//! Plane sweep: inverse depth at every pixel of one rigid motion, by trying depths.
//!
//! Depth is u (see [`View`]) at 32 to 64 equal steps, so that a pixel's target moves evenly along a line of the second
//! frame, by half a pixel or so. What a step costs (`volume.rs`) is smoothed by semi-global matching; the best step is taken,
//! to sub-step by the two lines through its neighbours, then the 3×3 median, and hidden pixels are filled from behind.
//!
//! ρ belongs to the T given. Frames of more than 640×480 pixels are swept at half
//! their size: 3 bytes × 64 steps a pixel is the memory that it takes.

use super::hidden::{fill, hidden};
use super::semi_global::aggregate;
use super::volume::volume;
use crate::camera::{Camera, RigidMotion};
use crate::frames::{halved, halved_camera};
use crate::grid::Grid;
use crate::init::{EpipolarMotion, Match};
use crate::layered::view::View;

/// Fewest and most steps of depth.
const LABELS: [usize; 2] = [32, 64];
/// Steps for each pixel of image motion.
const STEPS_A_PIXEL: f32 = 2.0;
/// Frames with more pixels than this are halved.
const MOST_PIXELS: usize = 640 * 480;

/// The range of u that the matches of one motion need, with a margin; |T| is 1. `None` with fewer than eight, and
/// where they reach farther behind the camera than before it.
pub fn match_range(matches: &[Match], found: &EpipolarMotion, camera: &Camera) -> Option<[f32; 2]> {
    let view = View::of(camera, &found.motion);
    let mut all: Vec<f32> = matches
        .iter()
        .filter_map(|m| {
            let rho = found.inverse_depth(m, camera)? as f32;
            Some(view.along(view.turned(m.at[0] as usize, m.at[1] as usize)[2], rho))
        })
        .collect();
    if all.len() < 8 {
        return None;
    }
    all.sort_unstable_by(f32::total_cmp);
    let (low, high) = (all[all.len() / 100], all[all.len() - 1 - all.len() / 150]);
    // Farther behind the camera than before it: no motion of something seen.
    if low < -high {
        return None;
    }
    // Near things are small and so have few matches.
    let span = (high - low).max(1e-6);
    Some([low - 0.12 * span, high + 0.25 * span])
}

/// ρ by a sweep of `range` of u for the `motion` of the pixels of `support`. Frames are grey levels of one size.
pub fn sweep(
    frames: [&Grid<f32>; 2],
    camera: &Camera,
    motion: &RigidMotion,
    support: &Grid<bool>,
    range: [f32; 2],
) -> Grid<f32> {
    if frames[0].len() <= MOST_PIXELS {
        return sweep_whole(frames, camera, motion, support, range);
    }
    let [width, height] = [frames[0].width(), frames[0].height()];
    let small = frames.map(halved);
    let mask = Grid::from_fn(width / 2, height / 2, |x, y| support[(2 * x, 2 * y)]);
    let camera = halved_camera(camera);
    let coarse = sweep_whole([&small[0], &small[1]], &camera, motion, &mask, range);
    Grid::from_fn(width, height, |x, y| {
        coarse[((x / 2).min(width / 2 - 1), (y / 2).min(height / 2 - 1))]
    })
}

fn sweep_whole(
    frames: [&Grid<f32>; 2],
    camera: &Camera,
    motion: &RigidMotion,
    support: &Grid<bool>,
    [low, high]: [f32; 2],
) -> Grid<f32> {
    let (width, height) = (frames[0].width(), frames[0].height());
    let view = View::of(camera, motion);
    let labels = count_labels(&view, width, height, high - low);
    let step = (high - low) / (labels - 1) as f32;
    let costs = volume(frames, &view, support, labels, low, step);
    let sums = aggregate(&costs, labels, frames[0]);
    drop(costs);
    let best = Grid::from_fn(width, height, |x, y| {
        let at = labels * (y * width + x);
        minimum(&sums[at..at + labels])
    });
    drop(sums);
    let depth = |labels: &Grid<f32>| {
        Grid::from_fn(width, height, |x, y| {
            let u = low + step * labels[(x, y)];
            view.rho(view.turned(x, y)[2], u)
        })
    };
    let raw = depth(&best);
    let mask = hidden(&raw, &view, support, STEPS_A_PIXEL * step);
    let mut rho = depth(&median3(&best));
    fill(&mut rho, &mask);
    rho
}

/// Steps such that most pixels move by less than half a pixel a step.
fn count_labels(view: &View, width: usize, height: usize, span: f32) -> usize {
    let mut speeds = Vec::new();
    for y in (0..height).step_by(8) {
        for x in (0..width).step_by(8) {
            let (_, [u, v]) = view.line(view.turned(x, y));
            speeds.push(u.hypot(v));
        }
    }
    let rank = speeds.len() * 9 / 10;
    let speed = *speeds.select_nth_unstable_by(rank, f32::total_cmp).1;
    let wanted = (span * speed * STEPS_A_PIXEL) as usize;
    wanted
        .div_ceil(16)
        .saturating_mul(16)
        .clamp(LABELS[0], LABELS[1])
}

/// The place of the least of a pixel's sums, between labels.
fn minimum(sums: &[u16]) -> f32 {
    let mut k = 0;
    for (i, &s) in sums.iter().enumerate() {
        if s < sums[k] {
            k = i;
        }
    }
    let at = |k: usize| f32::from(sums[k]);
    if k == 0 || k + 1 == sums.len() {
        return k as f32;
    }
    let (a, b, c) = (at(k - 1), at(k), at(k + 1));
    let rise = (a - b).max(c - b);
    let shift = if rise > 0.0 {
        0.5 * (a - c) / rise
    } else {
        0.0
    };
    k as f32 + shift
}

/// The median of the 3×3 pixels around each, the border left as it is: of the columns' medians the middle one, unless all
/// least or all greatest values of columns say otherwise.
fn median3(field: &Grid<f32>) -> Grid<f32> {
    let least = |v: [f32; 3]| v[0].min(v[1]).min(v[2]);
    let most = |v: [f32; 3]| v[0].max(v[1]).max(v[2]);
    let middle = |v: [f32; 3]| v[0].min(v[1]).max(v[0].max(v[1]).min(v[2]));
    let mut out = field.clone();
    for y in 1..field.height() - 1 {
        for x in 1..field.width() - 1 {
            let columns = [x - 1, x, x + 1].map(|x| [y - 1, y, y + 1].map(|y| field[(x, y)]));
            let [low, mid, high] = [
                most(columns.map(least)),
                middle(columns.map(middle)),
                least(columns.map(most)),
            ];
            out[(x, y)] = middle([low, mid, high]);
        }
    }
    out
}

#[cfg(test)]
mod tests;
