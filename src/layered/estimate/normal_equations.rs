//! One pass over a region's pixels: what they say of its motion and of its surface, as normal equations.
//!
//! A pixel with ray r = ((x − cx)/f, (y − cy)/f, 1) and inverse depth ρ goes to the image of q = R r + ρ T. With
//! h = (f/q_z)(g_x, g_y, −(g_x q_x + g_y q_y)/q_z), g the mean of both frames' gradients, its residual
//! e = I2(π(q)) − I1 changes to first order by
//!
//! ```text
//! δe = h·T δρ + ρ h·δT + (R r × h)·δω
//! ```
//!
//! and counts with the weight of the Geman–McClure cost c(e) = e²/(1 + e²/(κσ)²), grey levels²:
//! w = (1 + e²/(κσ)²)⁻². Sums are kept by cell of the control grid for ρ, and over the region for the rest.

use crate::grid::Grid;
use crate::window::Window;

use super::super::scale::Scale;
use super::curvature::Prior;
use super::rows::Rows;
use super::state::State;
use super::surface::Surface;

/// The largest cost of a residual, (κσ)² with κ = 3, grey levels². With the κ = 2 by which labels are judged, motion and
/// labels hold each other where they are: twice as many labels are wrong in strong noise.
pub(crate) fn most_cost(sigma: f32) -> f32 {
    9.0 * sigma * sigma
}

/// Bins a grey level of the histogram from which σ comes.
pub(super) const BINS_PER_LEVEL: f32 = 8.0;

/// Which pixels belong: those of `labels` that are `label`, inside `window`.
#[derive(Clone, Copy)]
pub(crate) struct Support<'a> {
    pub labels: &'a Grid<u8>,
    /// Pixels that another region owns but does not explain.
    pub offered: Option<&'a Grid<u8>>,
    pub label: u8,
    pub window: Window,
}

impl<'a> Support<'a> {
    /// The pixels that region `k` owns.
    pub fn of(labels: &'a Grid<u8>, k: usize, window: Window) -> Self {
        Self {
            labels,
            offered: None,
            label: k as u8,
            window,
        }
    }

    /// The same in the window around them; `None` if there are none.
    pub fn around(labels: &'a Grid<u8>, k: usize) -> Option<Self> {
        let owns = |i: usize| usize::from(labels.data()[i]) == k;
        let window = Window::around(labels.width(), labels.height(), owns)?;
        Some(Self::of(labels, k, window))
    }
}

/// A region's pixels at one scale, and what is charged.
pub(crate) struct Problem<'a> {
    pub scale: &'a Scale,
    pub level: usize,
    pub support: Support<'a>,
    pub prior: Prior,
}

/// Sums of products with the derivative a = h·T by ρ, in one cell: of a² with the products of two pairs of linear
/// weights, of a with each of the six others with one pair.
#[derive(Clone, Copy, Default)]
pub(crate) struct Cell {
    pub square: [f32; 9],
    pub cross: [[f32; 6]; 4],
}

/// What one pass finds.
#[derive(Default)]
pub(crate) struct NormalEquations {
    /// By column and row of cells.
    pub cells: Vec<Cell>,
    /// Over (δT along both tangents, δω, e): upper triangle.
    pub motion: [[f64; 6]; 6],
    /// Σ c(e), grey levels².
    pub cost: f64,
    /// Pixels that could be compared.
    #[cfg(test)]
    pub pixels: usize,
    /// 1.4826 times the median |e|, grey levels.
    pub spread: f32,
    rows: Rows,
}

impl NormalEquations {
    /// Goes over the region's pixels; residuals of the prior's σ are usual.
    pub fn gather(&mut self, problem: &Problem, state: &State) {
        let (scale, level, support) = (problem.scale, problem.level, problem.support);
        let (view, surface) = (&state.view(&scale.camera), &state.surface);
        let tangent = state.tangent().map(|b| b.to_array().map(|v| v as f32));
        let Window {
            left,
            top,
            width,
            height,
        } = support.window;
        self.rows.fit(width);
        self.rows.clear_sums();
        self.cells.clear();
        self.cells
            .resize((surface.columns - 1) * (surface.rows - 1), Cell::default());
        self.motion = Default::default();
        self.cost = 0.0;
        let mut histogram = [0u32; 512];
        let inverse = 1.0 / most_cost(problem.prior.sigma);
        let mut lanes = [[[0.0f32; 8]; 6]; 6];
        for y in top..top + height {
            surface.row(level, y, left, &mut self.rows.rho);
            self.rows.project(scale, view, left, y);
            self.rows.compare(scale, &support, y, &mut histogram);
            self.cost += self.rows.weigh(scale, view, left, y, inverse);
            let (row, below) = surface.row_cell(level, y);
            self.rows.sum_down(tangent, below);
            self.rows.sum_motion(&mut lanes);
            let last = surface.row_cell(level, y + 1).0 != row || y + 1 == top + height;
            if last {
                self.collect(surface, level, left, width, row);
                self.rows.clear_sums();
            }
        }
        for a in 0..6 {
            for b in a..6 {
                self.motion[a][b] = lanes[a][b].iter().map(|&v| f64::from(v)).sum();
            }
        }
        #[cfg(test)]
        {
            self.pixels = histogram.iter().sum::<u32>() as usize;
        }
        self.spread = spread(&histogram);
    }

    /// Adds the sums down a row of cells to the cells.
    fn collect(&mut self, surface: &Surface, level: usize, left: usize, width: usize, row: usize) {
        let share = 1.0 / (surface.spacing >> level) as f32;
        let (rows, cells) = (&self.rows, &mut self.cells);
        surface.runs(level, left, width, |run| {
            let cell = &mut cells[run.column * (surface.rows - 1) + row];
            for n in 0..run.length {
                let i = run.start + n;
                let right = ((run.offset + n) as f32 + 0.5) * share;
                let weights = [1.0 - right, right];
                let pairs = [
                    weights[0] * weights[0],
                    weights[0] * weights[1],
                    weights[1] * weights[1],
                ];
                for (down, sums) in rows.square.iter().enumerate() {
                    for (across, pair) in pairs.iter().enumerate() {
                        cell.square[3 * across + down] += sums[i] * pair;
                    }
                }
                for (m, sums) in rows.cross.iter().enumerate() {
                    for (across, weight) in weights.iter().enumerate() {
                        for (down, sums) in sums.iter().enumerate() {
                            cell.cross[2 * across + down][m] += sums[i] * weight;
                        }
                    }
                }
            }
        });
    }
}

/// 1.4826 times the median of a histogram of |e|.
fn spread(histogram: &[u32]) -> f32 {
    let count: usize = histogram.iter().map(|&n| n as usize).sum();
    let mut below = 0;
    let median = histogram.iter().position(|&n| {
        below += n as usize;
        2 * below >= count
    });
    1.4826 * (median.unwrap_or(0) as f32 + 0.5) / BINS_PER_LEVEL
}

#[cfg(test)]
pub(super) mod tests;
