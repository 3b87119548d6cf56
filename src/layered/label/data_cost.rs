//! What it costs a pixel to belong to a region.
//!
//! ```text
//! c(e) = e² / (1 + e²/(κσ)²)  <  (κσ)²,      e = I2(π(R r + ρ T)) − I1, ρ from the region's own surface
//! ```
//!
//! Every region is judged by its own surface, continued beyond its outline: with one depth for all, the present owner
//! of a pixel would be favoured. Grey levels². A pixel that leaves the frame says nothing of who owns it: it is charged
//! what residuals are usually charged at most.

use crate::grid::Grid;

use super::super::estimate::{PlanarFlow, State};
use super::super::scale::Scale;
use crate::window::Window;

/// κ: a residual of so many σ counts half its square.
const CUT: f32 = 2.0;
/// What a pixel that leaves the frame is charged, in units of the largest cost.
const LEAVES: f32 = 0.6;

/// The largest cost, (κσ)², grey levels².
pub(crate) fn saturation(sigma: f32) -> f32 {
    (CUT * sigma).powi(2)
}

#[inline(always)]
fn cost(e: f32, most: f32) -> f32 {
    let square = e * e;
    square * most / (most + square)
}

/// Costs under a rigid motion and a surface; `saturation` where the surface does not reach.
pub(crate) fn rigid_cost(
    scale: &Scale,
    level: usize,
    state: &State,
    sigma: f32,
    out: &mut Grid<f32>,
) {
    let most = saturation(sigma);
    out.data_mut().fill(f32::INFINITY);
    let Window {
        left,
        top,
        width,
        height,
    } = inside(&state.surface.window(), level, scale);
    let (f, cx, cy) = (
        scale.camera.focal as f32,
        scale.camera.cx as f32,
        scale.camera.cy as f32,
    );
    let pose = state.pose();
    let (r, t) = (pose.rotation, pose.translation);
    let mut rho = vec![1.0; width];
    for y in top..top + height {
        state.surface.row(level, y, left, &mut rho);
        let down = (y as f32 - cy) / f;
        let first = &scale.first.row(y)[left..left + width];
        let out = &mut out.row_mut(y)[left..left + width];
        for x in 0..width {
            let across = ((left + x) as f32 - cx) / f;
            let q: [f32; 3] = std::array::from_fn(|c| {
                r[c][0] * across + r[c][1] * down + r[c][2] + rho[x] * t[c]
            });
            let near = f / q[2].max(1e-3);
            let (to_x, to_y) = (q[0] * near + cx, q[1] * near + cy);
            out[x] = if scale.contains(to_x, to_y) {
                scale.brightness(to_x, to_y) - first[x]
            } else {
                f32::NAN
            };
        }
    }
}

/// GM and shading.
pub(crate) fn finish(
    e: &mut Grid<f32>,
    sigma: f32,
    spare: &mut Grid<f32>,
    radius: usize,
    delta: f32,
    mix: f32,
    scale: &Scale,
    slack: f32,
) {
    let most = saturation(sigma);
    let mut mean = e.map(|v| if v.is_finite() { v } else { 0.0 });
    super::box_blur(&mut mean, radius, spare);
    let [gx, gy] = &scale.gradient;
    let share = slack * slack / (sigma * sigma);
    for (((e, mean), gx), gy) in e
        .data_mut()
        .iter_mut()
        .zip(mean.data())
        .zip(gx.data())
        .zip(gy.data())
    {
        let unit = (1.0 + share * (gx * gx + gy * gy)).sqrt().recip();
        *e = if e.is_nan() {
            LEAVES * most
        } else if e.is_infinite() {
            most
        } else {
            let plain = cost(*e * unit, most);
            let high = cost((*e - mean) * unit, most);
            if mix > 0.0 {
                (1.0 - mix) * plain + mix * high
            } else {
                plain.min(high + delta * most)
            }
        };
    }
}

/// Costs under a planar flow.
pub(crate) fn planar_cost(scale: &Scale, flow: &PlanarFlow, sigma: f32, out: &mut Grid<f32>) {
    let _ = sigma;
    planar_residuals(scale, flow, out);
}

/// Residuals under a planar flow; not a number where it leads out of the frame.
fn planar_residuals(scale: &Scale, flow: &PlanarFlow, out: &mut Grid<f32>) {
    let f = scale.camera.focal as f32;
    for py in 0..scale.height {
        let y = (py as f32 - scale.camera.cy as f32) / f;
        let first = scale.first.row(py);
        for (px, e) in out.row_mut(py).iter_mut().enumerate() {
            let x = (px as f32 - scale.camera.cx as f32) / f;
            let (u, v) = flow.at(x, y);
            let (to_x, to_y) = (px as f32 + u * f, py as f32 + v * f);
            *e = if scale.contains(to_x, to_y) {
                scale.brightness(to_x, to_y) - first[px]
            } else {
                f32::NAN
            };
        }
    }
}

/// The part of a window of the finest scale that lies on scale `level`, in its pixels.
pub(crate) fn inside(window: &Window, level: usize, scale: &Scale) -> Window {
    let (left, top) = (window.left >> level, window.top >> level);
    let right = ((window.left + window.width) >> level).min(scale.width);
    let bottom = ((window.top + window.height) >> level).min(scale.height);
    Window {
        left,
        top,
        width: right - left,
        height: bottom - top,
    }
}
