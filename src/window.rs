//! A rectangle of a frame: what belongs to a small thing need not be computed everywhere.

use crate::grid::Grid;

/// Pixels `left..left + width` by `top..top + height` of a frame.
///
/// ```
/// use relievo::Window;
///
/// // One pixel at (4, 3) of an 8×6 frame, and a pixel around it.
/// let window = Window::around(8, 6, 1, |i| i == 3 * 8 + 4).unwrap();
/// assert_eq!((window.left, window.top), (3, 2));
/// assert_eq!((window.width, window.height), (3, 3));
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

    /// The smallest window with every pixel for which `inside` holds, and `margin` pixels around them as
    /// far as the `width × height` frame reaches; `None` when there is no such pixel.
    pub fn around(
        width: usize,
        height: usize,
        margin: usize,
        inside: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        let (mut min, mut max) = ([usize::MAX; 2], [0; 2]);
        for i in (0..width * height).filter(|&i| inside(i)) {
            let at = [i % width, i / width];
            for axis in 0..2 {
                min[axis] = min[axis].min(at[axis]);
                max[axis] = max[axis].max(at[axis]);
            }
        }
        let [left, top] = min.map(|m| m.saturating_sub(margin));
        (min[0] <= max[0]).then(|| Self {
            left,
            top,
            width: (max[0] + margin + 1).min(width) - left,
            height: (max[1] + margin + 1).min(height) - top,
        })
    }

    /// Column and row in the frame of pixel `i` of the window, in row order.
    pub fn place(&self, i: usize) -> (usize, usize) {
        (self.left + i % self.width, self.top + i / self.width)
    }

    /// What `frame` holds in the window.
    pub fn crop<T: Copy>(&self, frame: &Grid<T>) -> Grid<T> {
        Grid::from_fn(self.width, self.height, |x, y| {
            frame[(self.left + x, self.top + y)]
        })
    }

    /// Puts `part` into the window of `frame`.
    pub fn paste<T: Copy>(&self, part: &Grid<T>, frame: &mut Grid<T>) {
        for y in 0..self.height {
            let row = frame.row_mut(self.top + y);
            row[self.left..self.left + self.width].copy_from_slice(part.row(y));
        }
    }
}
