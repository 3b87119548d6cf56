//! A rectangle of a frame: what belongs to a small thing need not be computed everywhere.

use std::ops::Range;

/// Pixels `left..left + width` by `top..top + height` of a frame.
///
/// ```
/// use relievo::Window;
///
/// // Two pixels of row 3 of an 8×6 frame.
/// let window = Window::around(8, 6, |i| i == 3 * 8 + 4 || i == 3 * 8 + 6).unwrap();
/// assert_eq!((window.left, window.top), (4, 3));
/// assert_eq!((window.width, window.height), (3, 1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// First column.
    pub left: usize,
    /// First row.
    pub top: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

impl Window {
    /// All of a `width × height` frame.
    pub fn whole(width: usize, height: usize) -> Self {
        Self {
            left: 0,
            top: 0,
            width,
            height,
        }
    }

    /// Its pixels, row by row.
    pub(crate) fn pixels(self) -> Places {
        let columns = self.left..self.left + self.width;
        places(columns, self.top..self.top + self.height)
    }

    /// The smallest window with every pixel of a `width × height` frame for which `inside` holds; `None` when there is no
    /// such pixel.
    pub fn around(width: usize, height: usize, inside: impl Fn(usize) -> bool) -> Option<Self> {
        let (mut min, mut max) = ([usize::MAX; 2], [0; 2]);
        for i in (0..width * height).filter(|&i| inside(i)) {
            let at = [i % width, i / width];
            for axis in 0..2 {
                min[axis] = min[axis].min(at[axis]);
                max[axis] = max[axis].max(at[axis]);
            }
        }
        let [left, top] = min;
        (left <= max[0]).then(|| Self {
            left,
            top,
            width: max[0] + 1 - left,
            height: max[1] + 1 - top,
        })
    }
}

/// The places of a rectangle, row by row.
pub(crate) fn places(columns: Range<usize>, rows: Range<usize>) -> Places {
    Places {
        at: (columns.start, rows.start),
        // Where there are no columns there is nothing.
        bottom: if columns.is_empty() { 0 } else { rows.end },
        columns,
    }
}

/// What [`places`] gives. Adapters nested in one another take much more code.
#[derive(Clone)]
pub(crate) struct Places {
    at: (usize, usize),
    columns: Range<usize>,
    bottom: usize,
}

impl Iterator for Places {
    type Item = (usize, usize);

    fn next(&mut self) -> Option<(usize, usize)> {
        let (x, y) = self.at;
        if y >= self.bottom {
            return None;
        }
        self.at = match x + 1 {
            next if next < self.columns.end => (next, y),
            _ => (self.columns.start, y + 1),
        };
        Some((x, y))
    }
}
