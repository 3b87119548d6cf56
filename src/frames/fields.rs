//! Interlaced frames: even rows show one moment, odd rows another, a fiftieth or sixtieth of a second later.
//!
//! Where such a frame shows something that moves, a row is not what lies between its neighbours, but what lies
//! between them a few columns away: over the odd rows of a block of 16×16 pixels, and over its even ones, the d that makes
//!
//! ```text
//! E(d) = Σ [ I(x, y) − ½ I(x + d, y − 1) − ½ I(x + d, y + 1) ]²
//! ```
//!
//! least is not 0. Motion shifts odd rows to one side and even rows to the other. Lettering and stripes may look shifted in
//! whole frames as well, but then to either side alike: such blocks count against the others. Each field makes a frame of half the size, whose pixels
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

/// Half the side of a block, pixels; blocks overlap by as much.
const HALF: usize = 8;
/// Columns by which a row is tried to be shifted.
const SHIFTS: usize = 6;
/// Least E(d) over E(0) below which rows are shifted.
const SHIFTED: f32 = 0.8;
/// E(0) for a pixel, grey levels², below which a block is not looked at.
const FLAT: f32 = 4.0;
/// By how many more blocks are combed than shifted to one side in an interlaced frame: in shares of those looked at, and
/// their number.
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
        let (mut textured, mut combed, mut alike) = (0usize, 0, 0);
        for at in (1..down).flat_map(|j| (1..across).map(move |i| (i, j))) {
            let [Some(odd), Some(even)] = [0, 1].map(|rows| shift(&cells, at, rows)) else {
                continue;
            };
            textured += 1;
            if odd != 0 && even != 0 {
                combed += usize::from((odd + even).abs() <= 1);
                alike += usize::from((odd - even).abs() <= 1);
            }
        }
        combed >= alike + LEAST.1 && (combed - alike) as f64 >= LEAST.0 * textured as f64
    }

    /// The two moments of an interlaced frame, even rows first, as frames of half its size, seen with half its f.
    ///
    /// # Errors
    /// [`Error::Size`] when the fields are smaller than a frame may be.
    pub fn fields(&self) -> Result<[Self; 2], Error> {
        let (width, height) = (self.width() / 2, self.height() / 2);
        check_size("a field of the frame", width, height)?;
        let field = |near: usize, far: isize| {
            let mut fields = Self::from_rows(width, height, |k, out, _| {
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

/// By how many columns the odd (0) or even (1) rows of the block whose last cell is (i, j) are shifted; `None` where it
/// is flat.
fn shift(
    cells: &Grid<[[f32; 2 * SHIFTS + 1]; 2]>,
    (i, j): (usize, usize),
    rows: usize,
) -> Option<i32> {
    let four = [(i, j), (i - 1, j), (i, j - 1), (i - 1, j - 1)].map(|at| &cells[at][rows]);
    let sum = |d: usize| four.iter().map(|errors| errors[d]).sum::<f32>();
    let still = sum(SHIFTS);
    let least = (0..=2 * SHIFTS).min_by(|&a, &b| sum(a).total_cmp(&sum(b)))?;
    let shifted = sum(least) < SHIFTED * still;
    (still > FLAT * (2 * HALF * HALF) as f32).then(|| {
        if shifted {
            least as i32 - SHIFTS as i32
        } else {
            0
        }
    })
}
