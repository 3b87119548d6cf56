//! Interlaced frames: even rows show one moment, odd rows another, a fiftieth or sixtieth of a second later.
//!
//! Where such a frame shows something that moves, a row is not what lies between its neighbours, but what lies
//! between them d columns away, d being of opposite sign for even and for odd rows. So a block of 16×16 pixels is combed if in
//!
//! ```text
//! E(d) = Σ [ I(x, y) − ½ I(x + d, y − 1) − ½ I(x + d, y + 1) ]²
//! ```
//!
//! summed over its odd and over its even rows, the least of Eodd(d) + Eeven(−d) is well below that of Eodd(d) + Eeven(d). In
//! whole frames lettering and stripes may look shifted too, but then alike in all rows. Each field makes a frame of half the size, whose pixels
//! are square and whose rows lie at the same height in both:
//!
//! ```text
//! even(k) = ¾ I(2k) + ¼ I(2k + 2)        odd(k) = ¾ I(2k + 1) + ¼ I(2k − 1)
//! ```
//!
//! and columns in pairs.

use super::frame::{Frame, check_size};
use crate::error::Error;
use crate::grid::Grid;
use crate::window::places;

/// Half the side of a block, pixels; blocks overlap by as much.
const HALF: usize = 8;
/// Columns by which a row is tried to be shifted.
const SHIFTS: usize = 6;
/// Share of what a shift alike in all rows leaves below which opposite shifts tell a comb.
const COMBED: f32 = 0.8;
/// E(0) for a pixel, grey levels², below which a block is not looked at.
const FLAT: f32 = 4.0;
/// Combed blocks of an interlaced frame: in shares of those looked at, and their number.
const LEAST: (f64, usize) = (0.015, 3);
/// Rows of an interlaced frame at most.
const MOST_ROWS: usize = 1200;

impl Frame {
    /// Whether even and odd rows seem to show different moments.
    pub fn interlaced(&self) -> bool {
        let grey = &*self.grey;
        if self.height() > MOST_ROWS || self.grey_factor() > 1 {
            return false;
        }
        let across = grey.width().saturating_sub(2 * SHIFTS) / HALF;
        let down = (grey.height() - 2) / HALF;
        let cells = Grid::from_fn(across, down, |i, j| {
            let rows = |first| errors(grey, (SHIFTS + i * HALF, 1 + j * HALF + first));
            [rows(0), rows(1)]
        });
        let (mut textured, mut combed) = (0usize, 0usize);
        for (i, j) in places(1..across, 1..down) {
            let four = [(i, j), (i - 1, j), (i, j - 1), (i - 1, j - 1)].map(|at| cells[at]);
            let sum = |rows: usize, d: usize| four.iter().map(|cell| cell[rows][d]).sum::<f32>();
            if (0..2).any(|rows| sum(rows, SHIFTS) < FLAT * (2 * HALF * HALF) as f32) {
                continue;
            }
            let least = |even: &dyn Fn(usize) -> usize| {
                let each = (0..=2 * SHIFTS).map(|d| sum(0, d) + sum(1, even(d)));
                each.fold(f32::INFINITY, f32::min)
            };
            textured += 1;
            combed += usize::from(least(&|d| 2 * SHIFTS - d) < COMBED * least(&|d| d));
        }
        combed >= LEAST.1 && combed as f64 >= LEAST.0 * textured as f64
    }

    /// The two moments of an interlaced frame, even rows first, as frames of half its size, seen with half its f.
    ///
    /// # Errors
    /// [`Error::Size`] when the fields are smaller than a frame may be.
    pub fn fields(&self) -> Result<[Self; 2], Error> {
        let (width, height) = (self.width() / 2, self.height() / 2);
        check_size("a field of the frame", width, height)?;
        let field = |near: usize, far: isize| {
            let mut fields = Self::from_rows(width, height, &mut |k, out, _| {
                let last = 2 * (height as isize - 1) + near as isize;
                let other = 2 * k as isize + near as isize + far;
                let other = if (near as isize..=last).contains(&other) {
                    other as usize
                } else {
                    2 * k + near
                };
                let rows = [self.rgb.row(2 * k + near), self.rgb.row(other)];
                for (x, out) in out.iter_mut().enumerate() {
                    let pair = |row: &[[u8; 3]], c: usize| {
                        0.5 * (f32::from(row[2 * x][c]) + f32::from(row[2 * x + 1][c]))
                    };
                    *out = [0, 1, 2].map(|c| 0.75 * pair(rows[0], c) + 0.25 * pair(rows[1], c));
                }
            });
            fields.lens = self.lens.map(|lens| lens.shrunk(2));
            fields
        };
        Ok([field(0, 2), field(1, -2)])
    }
}

/// E(d) for each shift, over every other of [`HALF`] rows from `top`.
fn errors(grey: &Grid<f32>, (left, top): (usize, usize)) -> [f32; 2 * SHIFTS + 1] {
    let mut errors = [0.0; 2 * SHIFTS + 1];
    for y in (top..top + HALF)
        .step_by(2)
        .filter(|y| y + 1 < grey.height())
    {
        let own = &grey.row(y)[left..left + HALF];
        let [above, below] = [y - 1, y + 1].map(|y| grey.row(y));
        for (d, error) in errors.iter_mut().enumerate() {
            let from = left + d - SHIFTS;
            let shifted = above[from..].iter().zip(&below[from..]);
            for (own, (a, b)) in own.iter().zip(shifted) {
                *error += (own - 0.5 * (a + b)).powi(2);
            }
        }
    }
    errors
}
