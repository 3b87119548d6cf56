//! Turns a level set back into a signed distance, |∇φ| = 1, in a band around its zero line and without moving that.
//!
//! Next to the zero line the distance is taken from where φ crosses zero between pixels (linear, so exact to a fraction
//! of a pixel; a pixel-accurate start would pin the curve). From there it is carried outwards by sweeps over the rows
//! of the band, down and up in turn, each of which solves the eikonal equation by upwind differences (Zhao, Math. Comp.
//! 74, 2005) at every pixel of a row at once. One sweep carries it a pixel further; stops after one for every pixel of [`REACH`], and one more. φ > 0 inside.
//!
//! A pixel farther off keeps its sign, and a size of at least [`REACH`].

use super::rows::{least, most};
use crate::grid::Grid;

/// Distance up to which φ is one, in pixels: the band that curves are moved in (`curves.rs`), and its neighbours.
pub(super) const REACH: f32 = 7.0;
/// Pixels side by side that are in the band or not together: two vectors of the machine.
const CELL: usize = 8;
/// Least distance of a pixel from the zero line: φ = 0 has no sign.
const ON_THE_LINE: f32 = 1e-3;
/// More than any distance in the band.
const FAR: f32 = 1e3;

/// Pixels `first` to `end` − 1 of a padded row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub row: usize,
    pub first: usize,
    pub end: usize,
}

impl Span {
    pub fn len(&self) -> usize {
        self.end - self.first
    }
}

/// Adds the spans of a row that consist of `cells` which are in the band; the first begins at column `first`, and all
/// end at column `end`.
fn push_spans(
    band: &mut Vec<Span>,
    row: usize,
    first: usize,
    end: usize,
    cells: impl Iterator<Item = bool>,
) {
    let mut before = false;
    for (first, near) in (first..).step_by(CELL).zip(cells) {
        let cell_end = (first + CELL).min(end);
        match band.last_mut() {
            Some(span) if near && before => span.end = cell_end,
            _ if near => band.push(Span {
                row,
                first,
                end: cell_end,
            }),
            _ => {}
        }
        before = near;
    }
}

/// A level set with a ring of pixels around it that repeats its border.
pub(super) struct Padded {
    /// φ, one pixel wider than the frame on every side.
    pub phi: Grid<f32>,
    /// Where it is a distance.
    pub band: Vec<Span>,
}

impl Padded {
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            phi: Grid::new(width + 2, height + 2, 0.0),
            band: Vec::new(),
        }
    }

    /// Takes over a level set that is a distance within [`REACH`] of its zero line: that is the band.
    pub fn read(&mut self, phi: &Grid<f32>) {
        let (width, height) = (phi.width(), phi.height());
        self.band.clear();
        for y in 0..height {
            let row = phi.row(y);
            self.phi.row_mut(y + 1)[1..=width].copy_from_slice(row);
            let near = |cell: &[f32]| cell.iter().fold(false, |near, p| near | (p.abs() < REACH));
            push_spans(
                &mut self.band,
                y + 1,
                1,
                width + 1,
                row.chunks(CELL).map(near),
            );
        }
        self.repeat_border();
    }

    pub fn write(&self, phi: &mut Grid<f32>) {
        let (width, height) = (phi.width(), phi.height());
        for y in 0..height {
            phi.row_mut(y)
                .copy_from_slice(&self.phi.row(y + 1)[1..=width]);
        }
    }

    pub fn repeat_border(&mut self) {
        let (width, height) = (self.phi.width(), self.phi.height());
        for y in 1..height - 1 {
            let row = self.phi.row_mut(y);
            row[0] = row[1];
            row[width - 1] = row[width - 2];
        }
        let phi = self.phi.data_mut();
        phi.copy_within(width..2 * width, 0);
        let last = (height - 1) * width;
        phi.copy_within(last - width..last, last);
    }
}

/// Room to work in.
pub(super) struct Redistancing {
    /// [`FAR`] outside the band at work.
    distance: Grid<f32>,
    /// The distance where it is fixed, next to the zero line, 0 elsewhere.
    fixed: Grid<f32>,
    crossings: Vec<(usize, usize)>,
    /// For each row, which cells have a crossing within [`REACH`] columns.
    cells: Grid<bool>,
    row: Vec<f32>,
}

impl Redistancing {
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            distance: Grid::new(width + 2, height + 2, FAR),
            fixed: Grid::new(width + 2, height + 2, 0.0),
            crossings: Vec::new(),
            cells: Grid::new(width.div_ceil(CELL), height + 2, false),
            row: vec![0.0; width],
        }
    }

    /// Makes `level` a distance around its zero line, which is looked for in the present band; the band becomes all
    /// pixels within [`REACH`] of the line, and some more.
    pub fn run(&mut self, level: &mut Padded) {
        self.find_crossings(level);
        // What the line has left is far from it.
        for span in &level.band {
            for p in &mut level.phi.row_mut(span.row)[span.first..span.end] {
                *p = most(p.abs(), REACH).copysign(*p);
            }
        }
        self.lay(&mut level.band);
        for sweep in 0..=REACH as usize {
            if sweep % 2 == 0 {
                level.band.iter().for_each(|span| self.solve(*span));
            } else {
                level.band.iter().rev().for_each(|span| self.solve(*span));
            }
        }
        for span in &level.band {
            let distance = &mut self.distance.row_mut(span.row)[span.first..span.end];
            let phi = &mut level.phi.row_mut(span.row)[span.first..span.end];
            for (p, d) in phi.iter_mut().zip(distance) {
                let far = most(p.abs(), REACH);
                *p = if *d < REACH { *d } else { far }.copysign(*p);
                *d = FAR;
            }
        }
        for (x, y) in self.crossings.drain(..) {
            self.fixed[(x, y)] = 0.0;
        }
        level.repeat_border();
    }

    /// The pixels that have a neighbour on the other side of the line, and their distance from it.
    fn find_crossings(&mut self, level: &Padded) {
        let phi = &level.phi;
        for span in &level.band {
            let (up, here, down) = (
                phi.row(span.row - 1),
                phi.row(span.row),
                phi.row(span.row + 1),
            );
            let mut x = span.first;
            while x < span.end {
                let end = (x + CELL).min(span.end);
                // Signs differ where a product is not above 0.
                let mut lowest = f32::INFINITY;
                for i in x..end {
                    let sides = least(least(here[i - 1], here[i + 1]), least(up[i], down[i]));
                    let other = most(most(here[i - 1], here[i + 1]), most(up[i], down[i]));
                    lowest = least(lowest, least(here[i] * sides, here[i] * other));
                }
                if lowest <= 0.0 {
                    for i in x..end {
                        let near = |there: f32| {
                            if (here[i] > 0.0) == (there > 0.0) {
                                f32::INFINITY
                            } else {
                                (here[i] / (here[i] - there)).abs().max(ON_THE_LINE)
                            }
                        };
                        let dx = near(here[i - 1]).min(near(here[i + 1]));
                        let dy = near(up[i]).min(near(down[i]));
                        if dx.is_finite() || dy.is_finite() {
                            // The foot of the perpendicular on the line through both crossings.
                            let d = (dx.powi(-2) + dy.powi(-2)).sqrt().recip();
                            self.distance[(i, span.row)] = d;
                            self.fixed[(i, span.row)] = d;
                            self.crossings.push((i, span.row));
                        }
                    }
                }
                x = end;
            }
        }
    }

    /// Lays the band: the cells of pixels around the crossings.
    fn lay(&mut self, band: &mut Vec<Span>) {
        band.clear();
        let (Some(first), Some(last)) = (self.crossings.first(), self.crossings.last()) else {
            return;
        };
        let (width, height) = (self.distance.width() - 2, self.distance.height() - 2);
        let (top, bottom) = (first.1, last.1);
        for y in top..=bottom {
            self.cells.row_mut(y).fill(false);
        }
        for &(x, y) in &self.crossings {
            // The ring is no part of a cell.
            let cells = (x - 1).saturating_sub(REACH as usize) / CELL
                ..=(x - 1 + REACH as usize).min(width - 1) / CELL;
            self.cells.row_mut(y)[cells].fill(true);
        }
        let mut near = vec![false; self.cells.width()];
        for row in top.saturating_sub(REACH as usize).max(1)..=(bottom + REACH as usize).min(height)
        {
            near.fill(false);
            for y in
                row.saturating_sub(REACH as usize).max(top)..=(row + REACH as usize).min(bottom)
            {
                for (n, &c) in near.iter_mut().zip(self.cells.row(y)) {
                    *n |= c;
                }
            }
            push_spans(band, row, 1, width + 1, near.iter().copied());
        }
    }

    /// The eikonal equation at every pixel of a span, from what its neighbours have at present.
    fn solve(&mut self, span: Span) {
        let n = span.len();
        let around = |row: usize| &self.distance.row(row)[span.first - 1..=span.end];
        let (up, here, down) = (around(span.row - 1), around(span.row), around(span.row + 1));
        let fixed = &self.fixed.row(span.row)[span.first..span.end];
        let (up, down, fixed) = (&up[1..=n], &down[1..=n], &fixed[..n]);
        let (left, here, right) = (&here[..n], &here[1..=n], &here[2..n + 2]);
        let found = &mut self.row[..n];
        for i in 0..n {
            let (a, b) = (least(left[i], right[i]), least(up[i], down[i]));
            let gap = a - b;
            let both = 0.5 * (a + b + most(2.0 - gap * gap, 0.0).sqrt());
            let one = least(a, b) + 1.0;
            let solved = if gap.abs() < 1.0 { both } else { one };
            found[i] = least(here[i], most(solved, fixed[i]));
        }
        self.distance.row_mut(span.row)[span.first..span.end].copy_from_slice(found);
    }
}

#[cfg(test)]
mod tests;
