//! What it costs a pixel to belong to a region.
//!
//! ```text
//! c(e) = e² / (1 + e²/(κσ)²)  <  (κσ)²,      e = I2(π(R r + ρ T)) − I1, ρ from the region's own surface
//! ```
//!
//! Every region is judged by its own surface, continued beyond its outline: with one depth for all, the present owner
//! of a pixel would be favoured. Grey levels². A pixel that leaves the frame says nothing of who owns it: it is charged
//! [`LEAVES`] of the largest cost.

use std::ops::Range;

use super::super::estimate::Surface;
use super::super::region::Region;
use super::super::scale::Scale;
use super::memory::WINDOW;
use crate::frames::{LANES, Spline};
use crate::grid::Grid;

/// What a pixel that leaves the frame is charged, in units of the largest cost.
const LEAVES: f32 = 0.6;

/// The largest cost, (κσ)² with κ = 2, grey levels².
pub(crate) fn saturation(sigma: f32) -> f32 {
    4.0 * sigma * sigma
}

#[inline(always)]
fn cost(e: f32, most: f32) -> f32 {
    let square = e * e;
    square * most / (most + square)
}

/// Residuals of the unsmoothed frames under a region's motion and surface: infinite where the surface does not reach, not
/// a number where it leads out of the frame.
pub(crate) fn rigid_residual(scale: &Scale, level: usize, region: &Region, out: &mut Grid<f32>) {
    out.data_mut().fill(f32::INFINITY);
    if region.window.is_none() {
        return;
    }
    let view = region.state.view(&scale.camera);
    for_each_row(scale, level, &region.state.surface, |y, columns, rho| {
        let first = &scale.plain.row(y)[columns.clone()];
        let out = &mut out.row_mut(y)[columns.clone()];
        read_row(scale, &scale.plain_second, out, |n| {
            view.target(columns.start + n, y, rho[n])
        });
        out.iter_mut()
            .zip(first)
            .for_each(|(out, first)| *out -= first);
    });
}

/// Calls with every row of pixels that a surface reaches, with its columns there, and ρ of each.
pub(super) fn for_each_row(
    scale: &Scale,
    level: usize,
    surface: &Surface,
    mut each: impl FnMut(usize, Range<usize>, &[f32]),
) {
    // The part of its window that lies on the frame, in pixels of the scale.
    let window = surface.window();
    let columns = window.left >> level..((window.left + window.width) >> level).min(scale.width);
    let rows = window.top >> level..((window.top + window.height) >> level).min(scale.height);
    let mut rho = vec![1.0; columns.len()];
    for y in rows {
        surface.row(level, y, columns.start, &mut rho);
        each(y, columns.clone(), &rho);
    }
}

/// Reads a row of pixels off the second frame, each at its `target`: not a number where that is out of the frame.
fn read_row(scale: &Scale, second: &Spline, out: &mut [f32], target: impl Fn(usize) -> [f32; 2]) {
    for (start, out) in out.chunks_mut(LANES).enumerate() {
        let last = out.len() - 1;
        let places: [_; LANES] = std::array::from_fn(|n| target(LANES * start + n.min(last)));
        let values = second.at_four(places.map(|p| p[0]), places.map(|p| p[1]));
        for (out, (value, [x, y])) in out.iter_mut().zip(values.into_iter().zip(places)) {
            *out = if scale.contains(x, y) {
                value
            } else {
                f32::NAN
            };
        }
    }
}

/// Residuals become costs.
pub(super) fn charge(residuals: &mut Grid<f32>, sigma: f32) {
    let most = saturation(sigma);
    for e in residuals.data_mut() {
        *e = if e.is_nan() {
            LEAVES * most
        } else if e.is_infinite() {
            most
        } else {
            cost(*e, most)
        };
    }
}

/// Costs under a region's planar flow; the largest where it owns nothing.
pub(crate) fn planar_cost(scale: &Scale, region: &Region, sigma: f32, out: &mut Grid<f32>) {
    let most = saturation(sigma);
    if region.window.is_none() {
        out.data_mut().fill(most);
        return;
    }
    let f = scale.camera.focal as f32;
    for py in 0..scale.height {
        let y = (py as f32 - scale.camera.cy as f32) / f;
        let first = scale.first.row(py);
        let out = out.row_mut(py);
        read_row(scale, &scale.second, out, |px| {
            let x = (px as f32 - scale.camera.cx as f32) / f;
            let (u, v) = region.flow.at(x, y);
            [px as f32 + u * f, py as f32 + v * f]
        });
        for (out, first) in out.iter_mut().zip(first) {
            let cost = cost(*out - first, most);
            *out = if cost.is_nan() { LEAVES * most } else { cost };
        }
    }
}

/// What it costs to match by chance: the mean cost of the first frame against itself, a window away.
pub(super) fn chance_cost(scale: &Scale, sigma: f32, out: &mut Grid<f32>) {
    let (most, first) = (saturation(sigma), &scale.plain);
    let (width, height, shift) = (scale.width, scale.height, 2 * WINDOW + 1);
    for y in 0..height {
        let row = first.row(y);
        let above = first.row(y.saturating_sub(shift));
        let below = first.row((y + shift).min(height - 1));
        for (x, out) in out.row_mut(y).iter_mut().enumerate() {
            let here = row[x];
            let around = [
                row[x.saturating_sub(shift)],
                row[(x + shift).min(width - 1)],
                above[x],
                below[x],
            ];
            *out = around.iter().map(|v| cost(v - here, most)).sum::<f32>() / 4.0;
        }
    }
}
