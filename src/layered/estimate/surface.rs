//! Inverse depth of a region as a bilinear surface over a coarse grid of control points.
//!
//! A thousand numbers instead of a value a pixel: normal equations stay small enough to be solved exactly, and noise
//! is averaged before it is fitted. Control points lie `spacing` pixels of the finest scale apart, at the corners of
//! pixels, so that every scale sees the same surface. ρ = 1/Z in units in which the region's mean is 1; it may be 0
//! (infinitely far) or, under a slightly wrong ω, less.

use crate::grid::Grid;
use crate::window::Window;

/// Least and greatest ρ of a control point.
pub(crate) const RHO: [f32; 2] = [-0.5, 8.0];

/// A grid of control points over a window of the frame.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surface {
    /// Pixels of the finest scale from one control point to the next; a power of two.
    pub spacing: usize,
    /// Pixels of the finest scale left of and above the first control point; multiples of the spacing.
    pub left: usize,
    pub top: usize,
    pub columns: usize,
    pub rows: usize,
    /// ρ at each control point, at [`Self::node`].
    pub rho: Vec<f32>,
}

impl Surface {
    /// A flat surface, ρ = 1, over a window of the finest scale.
    pub fn flat(spacing: usize, window: &Window) -> Self {
        let first = |edge: usize| edge / spacing * spacing;
        let (left, top) = (first(window.left), first(window.top));
        let count = |from: usize, to: usize| (to - from).div_ceil(spacing) + 1;
        let columns = count(left, window.left + window.width);
        let rows = count(top, window.top + window.height);
        Self {
            spacing,
            left,
            top,
            columns,
            rows,
            rho: vec![1.0; columns * rows],
        }
    }

    /// The surface through the means of `rho`, a grid of the finest scale, around each control point.
    pub fn through(spacing: usize, rho: &Grid<f32>) -> Self {
        let (width, height) = (rho.width(), rho.height());
        let mut new = Self::flat(spacing, &Window::whole(width, height));
        let around = |at: usize, most: usize| {
            let at = at * spacing;
            at.saturating_sub(spacing / 2).min(most - 1)..(at + spacing / 2).min(most)
        };
        for i in 0..new.columns {
            for j in 0..new.rows {
                let rows = around(j, height);
                let count = rows.len() * around(i, width).len();
                let sum: f32 = rows.flat_map(|y| &rho.row(y)[around(i, width)]).sum();
                let node = new.node(i, j);
                new.rho[node] = sum / count as f32;
            }
        }
        new
    }

    /// The same surface over other control points; beyond its own it goes on as at its border.
    pub fn over(&self, spacing: usize, window: &Window) -> Self {
        let mut new = Self::flat(spacing, window);
        new.set(|x, y| self.at(x, y));
        new
    }

    /// The same surface moved by (u, v) pixels of the finest scale, over the same control points.
    pub fn shifted(&self, [u, v]: [f32; 2]) -> Self {
        let mut new = self.clone();
        new.set(|x, y| self.at(x - u, y - v));
        new
    }

    /// Gives every control point the ρ of its place on the finest scale.
    fn set(&mut self, rho: impl Fn(f32, f32) -> f32) {
        for i in 0..self.columns {
            for j in 0..self.rows {
                let x = (self.left + i * self.spacing) as f32 - 0.5;
                let y = (self.top + j * self.spacing) as f32 - 0.5;
                let node = self.node(i, j);
                self.rho[node] = rho(x, y);
            }
        }
    }

    /// Where a control point's ρ is kept: neighbours along the shorter side follow each other, which keeps
    /// the normal equations' band narrow.
    #[inline(always)]
    pub fn node(&self, column: usize, row: usize) -> usize {
        if self.rows <= self.columns {
            column * self.rows + row
        } else {
            row * self.columns + column
        }
    }

    /// The control points at the corners of a cell, by column, then row.
    pub fn corners(&self, column: usize, row: usize) -> [usize; 4] {
        [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| self.node(column + i, row + j))
    }

    /// Most by which the places of two control points of one curvature term differ.
    pub fn bandwidth(&self) -> usize {
        2 * self.rows.min(self.columns)
    }

    /// The window of the finest scale that it covers.
    pub fn window(&self) -> Window {
        Window {
            left: self.left,
            top: self.top,
            width: (self.columns - 1) * self.spacing,
            height: (self.rows - 1) * self.spacing,
        }
    }

    /// ρ at a place of the finest scale, in pixels; beyond its border as at its border, sloping.
    pub fn at(&self, x: f32, y: f32) -> f32 {
        let fx = (x + 0.5 - self.left as f32) / self.spacing as f32;
        let fy = (y + 0.5 - self.top as f32) / self.spacing as f32;
        let (i, tx) = split(fx, self.columns);
        let (j, ty) = split(fy, self.rows);
        let rho = |i, j| self.rho[self.node(i, j)];
        let left = rho(i, j) * (1.0 - ty) + rho(i, j + 1) * ty;
        let right = rho(i + 1, j) * (1.0 - ty) + rho(i + 1, j + 1) * ty;
        left * (1.0 - tx) + right * tx
    }

    /// ρ at pixels `left..` of row `y` of scale `level`, all inside its window.
    pub fn row(&self, level: usize, y: usize, left: usize, out: &mut [f32]) {
        let spacing = self.spacing >> level;
        let (j, below) = self.row_cell(level, y);
        self.runs(level, left, out.len(), |run| {
            let rho = |i| {
                let (a, b) = (self.rho[self.node(i, j)], self.rho[self.node(i, j + 1)]);
                a * (1.0 - below) + b * below
            };
            let (low, high) = (rho(run.column), rho(run.column + 1));
            let step = (high - low) / spacing as f32;
            let first = low + step * (run.offset as f32 + 0.5);
            for (n, out) in out[run.start..run.start + run.length]
                .iter_mut()
                .enumerate()
            {
                *out = first + step * n as f32;
            }
        });
    }

    /// The row of cells in which row `y` of scale `level` lies, and how far down, 0–1.
    #[inline(always)]
    pub fn row_cell(&self, level: usize, y: usize) -> (usize, f32) {
        let (spacing, top) = (self.spacing >> level, self.top >> level);
        let offset = (y - top) % spacing;
        ((y - top) / spacing, (offset as f32 + 0.5) / spacing as f32)
    }

    /// The parts of a row of pixels that lie in one cell each.
    #[inline(always)]
    pub fn runs(&self, level: usize, left: usize, count: usize, mut each: impl FnMut(Run)) {
        let (spacing, origin) = (self.spacing >> level, self.left >> level);
        let mut start = 0;
        while start < count {
            let x = left + start - origin;
            let offset = x % spacing;
            let length = (spacing - offset).min(count - start);
            each(Run {
                column: x / spacing,
                offset,
                start,
                length,
            });
            start += length;
        }
    }
}

/// Pixels of a row that lie in one cell.
pub(crate) struct Run {
    /// The cell's column.
    pub column: usize,
    /// Pixels of the cell to the left of the first.
    pub offset: usize,
    /// The first pixel's place in the row that was asked for.
    pub start: usize,
    /// Their number.
    pub length: usize,
}

/// The cell of a coordinate and the fraction within, limited to one cell beyond the border.
fn split(f: f32, count: usize) -> (usize, f32) {
    let cell = (f.max(0.0) as usize).min(count - 2);
    (cell, (f - cell as f32).clamp(-1.0, 2.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_what_points_are_at_every_scale() {
        let window = Window {
            left: 19,
            top: 5,
            width: 50,
            height: 31,
        };
        let mut surface = Surface::flat(8, &window);
        for (n, rho) in surface.rho.iter_mut().enumerate() {
            *rho = 1.0 + 0.1 * ((n * n) as f32).sin();
        }
        for level in 0..3 {
            let side = 1 << level;
            let mut row = vec![0.0; 10];
            for y in [8 >> level, 30 >> level] {
                surface.row(level, y, 24 >> level, &mut row);
                for (n, rho) in row.iter().enumerate() {
                    let centre = |at: usize| (at as f32 + 0.5) * side as f32 - 0.5;
                    let point = surface.at(centre((24 >> level) + n), centre(y));
                    assert!((rho - point).abs() < 1e-5);
                }
            }
        }
    }

    #[test]
    fn a_plane_stays_a_plane_over_other_control_points() {
        let window = Window::whole(64, 48);
        let mut coarse = Surface::flat(16, &window);
        for i in 0..coarse.columns {
            for j in 0..coarse.rows {
                let node = coarse.node(i, j);
                coarse.rho[node] = 0.5 + 0.1 * i as f32 - 0.05 * j as f32;
            }
        }
        let fine = coarse.over(8, &window);
        for (x, y) in [(3.0, 4.0), (40.5, 30.25), (63.0, 47.0)] {
            assert!((fine.at(x, y) - coarse.at(x, y)).abs() < 1e-5);
        }
    }
}
