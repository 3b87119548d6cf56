//! A whole-pixel displacement to sub-pixel: Lucas and Kanade's least squares over a window.
//!
//! ```text
//! minimise  Σ_{r in 9×9} ( B(x + d + r) − A(x + r) )²        H δ = −Σ ∇A e,   H = Σ ∇A ∇Aᵀ,   d ← d + δ
//! ```
//!
//! Grey levels, frames less their local mean. At most four steps; it stops when a step is below 0.03 px.

use super::matches::Match;
use crate::grid::Grid;

/// Half of the window, in pixels.
pub const RADIUS: usize = 4;
/// A window whose weaker eigenvalue of H, a pixel, is below this has too little texture, (grey levels/px)².
const LEAST_TEXTURE: f32 = 3.0;
/// Residuals are cut here, in grey levels.
const CLIP: f32 = 30.0;
/// A result that is farther than this from the start, in pixels, has left its basin.
const FARTHEST: f32 = 1.5;

/// Follows the window around the pixel `at` of `first` into `second` from the displacement `start`. `None` where the
/// window does not lie within `first`, has too little texture or leads away.
pub fn track(
    first: &Grid<f32>,
    second: &Grid<f32>,
    at: [i32; 2],
    start: [i32; 2],
) -> Option<Match> {
    const SIDE: usize = 2 * RADIUS + 1;
    let (width, height) = (first.width(), first.height());
    let margin = RADIUS as i32 + 1;
    let inside = |p: i32, side: usize| p >= margin && p < side as i32 - margin;
    if !(inside(at[0], width) && inside(at[1], height)) {
        return None;
    }
    let (left, top) = (at[0] as usize - RADIUS, at[1] as usize - RADIUS);
    let mut window = [[0.0f32; 3]; SIDE * SIDE];
    let [mut xx, mut xy, mut yy] = [0.0f32; 3];
    for j in 0..SIDE {
        let row = |dy: usize| &first.row(top + j + dy - 1)[left - 1..left + SIDE + 1];
        let (above, here, below) = (row(0), row(1), row(2));
        for i in 0..SIDE {
            let gx = 0.5 * (here[i + 2] - here[i]);
            let gy = 0.5 * (below[i + 1] - above[i + 1]);
            window[j * SIDE + i] = [gx, gy, here[i + 1]];
            xx += gx * gx;
            xy += gx * gy;
            yy += gy * gy;
        }
    }
    let determinant = xx * yy - xy * xy;
    let half = 0.5 * (xx + yy);
    let weaker = half - (half * half - determinant).max(0.0).sqrt();
    let count = (SIDE * SIDE) as f32;
    if weaker.is_nan() || weaker < LEAST_TEXTURE * count {
        return None;
    }
    let start = start.map(|d| d as f32);
    let mut d = start;
    let mut squares = 0.0;
    for _ in 0..4 {
        let [mut bx, mut by] = [0.0f32; 2];
        squares = 0.0;
        let (x0, y0) = (left as f32 + d[0], top as f32 + d[1]);
        for j in 0..SIDE {
            for i in 0..SIDE {
                let [gx, gy, grey] = window[j * SIDE + i];
                let there = second.bilinear(x0 + i as f32, y0 + j as f32);
                let e = (there - grey).clamp(-CLIP, CLIP);
                bx += gx * e;
                by += gy * e;
                squares += e * e;
            }
        }
        let dx = (yy * bx - xy * by) / determinant;
        let dy = (xx * by - xy * bx) / determinant;
        d = [d[0] - dx, d[1] - dy];
        if dx * dx + dy * dy <= 1e-3 {
            break;
        }
    }
    let near = (0..2).all(|k| (d[k] - start[k]).abs() <= FARTHEST);
    let (x, y) = (at[0] as f32 + d[0], at[1] as f32 + d[1]);
    let on = x >= 0.0 && y >= 0.0 && x <= (width - 1) as f32 && y <= (height - 1) as f32;
    (near && on).then_some(Match {
        at: at.map(|c| c as f32),
        to: [x, y],
        tensor: [xx, xy, yy],
        residual: (squares / count).sqrt(),
    })
}
