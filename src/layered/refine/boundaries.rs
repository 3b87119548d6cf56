//! Depth discontinuities: to which side a pixel near one belongs.
//!
//! A sweep has its steps of depth a pixel or two off, and smoothing rounds them. In a band around each, a pixel has three
//! candidates: the planes ρ = a + b dx + c dy through the nearer and through the farther pixels of the window around it,
//! and what it has. Their brightness is compared over a window of pixels of the band,
//!
//! ```text
//! c = e²/(e² + (2.5 σ)²),     C(x) = Σ w(x, x') c(x'),     w = exp(−|I(x) − I(x')|/15)
//! ```
//!
//! and the candidate of least C is taken. One that is hidden has no brightness to compare; it costs what one does that is
//! neither right nor wrong.

use super::hidden::Arrivals;
use crate::grid::Grid;
use crate::layered::scale::Scale;
use crate::layered::view::View;
use crate::linalg::solve;

/// Neighbours that differ by more than this, in pixels of image motion, have a step between them.
const STEP: f32 = 0.3;
/// Both planes must be farther apart than this, in pixels of image motion.
const GAP: f32 = 0.5;
/// Pixels around a step that may change sides.
const BAND: usize = 3;
/// Half of the window of a plane, and of C.
const WINDOW: usize = 4;
/// The grey levels of w.
const SIMILAR: f32 = 15.0;
/// c of what is hidden.
const HIDDEN: f32 = 0.35;

/// Lets the pixels near steps of `rho` change sides. `pixels` of image motion are a unit of ρ, `sigma` the
/// spread of a comparison in grey levels.
pub fn settle(
    scale: &Scale,
    view: &View,
    support: &Grid<bool>,
    rho: &mut Grid<f32>,
    pixels: f32,
    sigma: f32,
) {
    let (width, height) = (rho.width(), rho.height());
    let band = band(rho, support, STEP / pixels);
    let arrivals = Arrivals::new(rho, view, support);
    let cut = (2.5 * sigma).powi(2);
    let mut places = Vec::new();
    let mut values = Vec::new();
    // Which of the candidates below is a pixel's.
    let mut index = Grid::new(width, height, u32::MAX);
    let mut costs: Vec<[f32; 3]> = Vec::new();
    for y in 0..height {
        for x in 0..width {
            if !band[(x, y)] {
                continue;
            }
            let Some([near, far]) = planes(rho, support, x, y, GAP / pixels) else {
                continue;
            };
            let first = scale.first[(x, y)];
            let three = [near, far, rho[(x, y)]];
            index[(x, y)] = costs.len() as u32;
            costs.push(three.map(|r| {
                let [tx, ty] = view.target(x, y, r);
                if !arrivals.sees([tx, ty], r, 0.5 * (near - far)) {
                    return HIDDEN;
                }
                let e = scale.second.at(tx, ty) - first;
                e * e / (e * e + cut)
            }));
            places.push((x, y));
            values.push(three);
        }
    }
    let similar: Vec<f32> = (0..512)
        .map(|k| (-0.5 * k as f32 / SIMILAR).exp())
        .collect();
    let guide = &scale.plain;
    for (&(x, y), three) in places.iter().zip(&values) {
        let grey = guide[(x, y)];
        let mut sums = [0.0f32; 3];
        let (columns, rows) = window(x, y, width, height);
        for v in rows {
            let greys = &guide.row(v)[columns.clone()];
            for (&k, g) in index.row(v)[columns.clone()].iter().zip(greys) {
                if k != u32::MAX {
                    let weight = similar[((2.0 * (g - grey).abs()) as usize).min(511)];
                    for (s, c) in sums.iter_mut().zip(costs[k as usize]) {
                        *s += weight * c;
                    }
                }
            }
        }
        let best = usize::from(sums[1] < sums[0]);
        if sums[best] < sums[2] {
            rho[(x, y)] = three[best];
        }
    }
}

/// The columns and rows of the window around a pixel.
fn window(x: usize, y: usize, width: usize, height: usize) -> (Range, Range) {
    let around = |k: usize, side: usize| k.saturating_sub(WINDOW)..(k + WINDOW + 1).min(side);
    (around(x, width), around(y, height))
}

type Range = std::ops::Range<usize>;

/// Pixels within [`BAND`] of a step.
fn band(rho: &Grid<f32>, support: &Grid<bool>, step: f32) -> Grid<bool> {
    let (width, height) = (rho.width(), rho.height());
    let mut marks = Grid::new(width, height, false);
    for y in 0..height {
        for x in 0..width {
            let here = rho[(x, y)];
            let right = x + 1 < width && (rho[(x + 1, y)] - here).abs() > step;
            let below = y + 1 < height && (rho[(x, y + 1)] - here).abs() > step;
            if right || below {
                for v in y.saturating_sub(BAND)..(y + BAND + 1).min(height) {
                    let columns = x.saturating_sub(BAND)..(x + BAND + 1).min(width);
                    marks.row_mut(v)[columns].fill(true);
                }
            }
        }
    }
    for (m, &s) in marks.data_mut().iter_mut().zip(support.data()) {
        *m &= s;
    }
    marks
}

/// ρ at (x, y) of the planes through the nearer and the farther pixels around it; `None` unless they are `gap` apart.
fn planes(rho: &Grid<f32>, support: &Grid<bool>, x: usize, y: usize, gap: f32) -> Option<[f32; 2]> {
    let (columns, rows) = window(x, y, rho.width(), rho.height());
    let (mut least, mut most) = (f32::MAX, f32::MIN);
    for v in rows.clone() {
        for &r in &rho.row(v)[columns.clone()] {
            least = least.min(r);
            most = most.max(r);
        }
    }
    if most - least < gap {
        return None;
    }
    let middle = 0.5 * (least + most);
    // 1, dx, dy, dx², dx dy, dy², ρ, ρ dx, ρ dy summed over either side; a quarter of the pixels will do.
    let mut sums = [[0.0f32; 9]; 2];
    for v in rows.step_by(2) {
        for u in columns.clone().step_by(2).filter(|&u| support[(u, v)]) {
            let r = rho[(u, v)];
            let (dx, dy) = (u as f32 - x as f32, v as f32 - y as f32);
            let terms = [1.0, dx, dy, dx * dx, dx * dy, dy * dy, r, r * dx, r * dy];
            for (s, t) in sums[usize::from(r < middle)].iter_mut().zip(terms) {
                *s += t;
            }
        }
    }
    let [near, far] = sums.map(|s| {
        let [n, sx, sy, xx, xy, yy, r, rx, ry] = s.map(f64::from);
        // Few pixels in a line leave a slope open: hold it towards 0.
        let ridge = 0.05 * (xx + yy) + 1.0;
        let normal = [[n, sx, sy], [sx, xx + ridge, xy], [sy, xy, yy + ridge]];
        let plane = (n >= 3.0).then(|| solve(&normal, &[r, rx, ry]))??;
        Some(plane[0] as f32)
    });
    let (near, far) = (near?, far?);
    (near - far > gap).then_some([near, far])
}

#[cfg(test)]
mod tests;
