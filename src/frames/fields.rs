//! Interlaced frames: even rows show one moment, odd rows another, a fiftieth or sixtieth of a second later.
//!
//! Where such a frame shows something that moves, an odd row is not what lies between its neighbours, but what lies
//! between them a few columns away: the d that makes
//!
//! ```text
//! E(d) = Σ [ I(x, y) − ½ I(x + d, y − 1) − ½ I(x + d, y + 1) ]²        y odd, in a block of 16×16 pixels
//! ```
//!
//! least is not 0, which in whole frames it is next to everywhere. Each field makes a frame of half the size, whose pixels
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

/// Side of a block, pixels.
const BLOCK: usize = 16;
/// Columns by which a row is tried to be shifted.
const SHIFTS: usize = 6;
/// Least E(d) over E(0) below which a block is combed.
const COMBED: f32 = 0.8;
/// E(0) for a pixel, grey levels², below which a block is not looked at.
const FLAT: f32 = 4.0;
/// Share of the blocks that are combed in an interlaced frame, and their number.
const LEAST: (f64, usize) = (0.02, 2);
/// Rows of an interlaced frame at most.
const MOST_ROWS: usize = 1200;

impl Frame {
    /// Whether even and odd rows seem to show different moments.
    pub fn interlaced(&self) -> bool {
        let grey = &*self.grey;
        if self.height() > MOST_ROWS || self.grey_factor() > 1 {
            return false;
        }
        let across = grey.width().saturating_sub(2 * SHIFTS) / BLOCK;
        let down = (grey.height() - 2) / BLOCK;
        let blocks =
            (0..across * down).map(|i| (SHIFTS + i % across * BLOCK, 1 + i / across * BLOCK));
        let combed = blocks.filter(|&at| is_combed(grey, at)).count();
        combed >= LEAST.1 && combed as f64 >= LEAST.0 * (across * down) as f64
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

fn is_combed(grey: &Grid<f32>, (left, top): (usize, usize)) -> bool {
    let mut errors = [0.0f32; 2 * SHIFTS + 1];
    for y in (top..top + BLOCK).step_by(2) {
        let own = &grey.row(y)[left..left + BLOCK];
        let [above, below] = [y - 1, y + 1].map(|y| grey.row(y));
        for (d, error) in errors.iter_mut().enumerate() {
            let from = left + d - SHIFTS;
            let shifted = above[from..].iter().zip(&below[from..]);
            for (own, (a, b)) in own.iter().zip(shifted) {
                *error += (own - 0.5 * (a + b)).powi(2);
            }
        }
    }
    let still = errors[SHIFTS];
    let least = errors.iter().copied().fold(f32::INFINITY, f32::min);
    still > FLAT * (BLOCK * BLOCK / 2) as f32 && least < COMBED * still
}
