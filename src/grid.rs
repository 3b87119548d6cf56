//! A picture-shaped array of numbers.
//!
//! Rows run downwards, `x` to the right; pixel (0, 0) is the centre of the top-left pixel, so that
//! real coordinates `(x, y)` with `-0.5 <= x < width - 0.5` lie on the picture.

use std::ops::{Index, IndexMut};

use crate::error::Error;

/// A `width × height` array in row order.
///
/// ```
/// use relievo::Grid;
///
/// let ramp = Grid::from_fn(4, 3, |x, y| (x + 10 * y) as f32);
/// assert_eq!(ramp[(3, 2)], 23.0);
/// assert_eq!(ramp.row(1), [10.0, 11.0, 12.0, 13.0]);
/// assert_eq!(ramp.bilinear(0.5, 1.0), 10.5);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Grid<T> {
    width: usize,
    height: usize,
    data: Vec<T>,
}

impl<T: Copy> Grid<T> {
    /// A grid with the same `value` everywhere.
    pub fn new(width: usize, height: usize, value: T) -> Self {
        Self {
            width,
            height,
            data: vec![value; width * height],
        }
    }

    /// A grid over `data`, given in row order.
    ///
    /// # Errors
    /// [`Error::Length`] unless `data.len() == width * height`.
    pub fn from_vec(width: usize, height: usize, data: Vec<T>) -> Result<Self, Error> {
        if data.len() != width * height {
            return Err(Error::Length {
                what: "grid",
                width,
                height,
                expected: width * height,
                found: data.len(),
            });
        }
        Ok(Self {
            width,
            height,
            data,
        })
    }

    /// A grid whose value at `(x, y)` is `f(x, y)`.
    pub fn from_fn(width: usize, height: usize, mut f: impl FnMut(usize, usize) -> T) -> Self {
        let mut data = Vec::with_capacity(width * height);
        for y in 0..height {
            for x in 0..width {
                data.push(f(x, y));
            }
        }
        Self {
            width,
            height,
            data,
        }
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Number of pixels.
    pub fn len(&self) -> usize {
        self.data.len()
    }

    /// Whether there is no pixel at all.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    /// All values in row order.
    pub fn data(&self) -> &[T] {
        &self.data
    }

    /// All values in row order.
    pub fn data_mut(&mut self) -> &mut [T] {
        &mut self.data
    }

    /// Row `y`.
    pub fn row(&self, y: usize) -> &[T] {
        &self.data[y * self.width..(y + 1) * self.width]
    }

    /// Row `y`.
    pub fn row_mut(&mut self, y: usize) -> &mut [T] {
        &mut self.data[y * self.width..(y + 1) * self.width]
    }

    /// The value at `(x, y)`, the nearest border pixel's when that lies outside.
    pub fn clamped(&self, x: isize, y: isize) -> T {
        let x = x.clamp(0, self.width as isize - 1) as usize;
        let y = y.clamp(0, self.height as isize - 1) as usize;
        self.data[y * self.width + x]
    }

    /// A grid of `f(value)`.
    pub fn map<U: Copy>(&self, f: impl FnMut(T) -> U) -> Grid<U> {
        Grid {
            width: self.width,
            height: self.height,
            data: self.data.iter().copied().map(f).collect(),
        }
    }

    /// Whether `other` has the same width and height.
    pub fn same_size<U: Copy>(&self, other: &Grid<U>) -> bool {
        self.width == other.width() && self.height == other.height()
    }
}

impl Grid<f32> {
    /// The value at real coordinates by bilinear interpolation, the border continued outwards.
    pub fn bilinear(&self, x: f32, y: f32) -> f32 {
        let (x0, y0) = (x.floor(), y.floor());
        let (fx, fy) = (x - x0, y - y0);
        let (x0, y0) = (x0 as isize, y0 as isize);
        let top = self.clamped(x0, y0) * (1.0 - fx) + self.clamped(x0 + 1, y0) * fx;
        let bottom = self.clamped(x0, y0 + 1) * (1.0 - fx) + self.clamped(x0 + 1, y0 + 1) * fx;
        top * (1.0 - fy) + bottom * fy
    }
}

impl<T> Index<(usize, usize)> for Grid<T> {
    type Output = T;

    fn index(&self, (x, y): (usize, usize)) -> &T {
        debug_assert!(x < self.width && y < self.height);
        &self.data[y * self.width + x]
    }
}

impl<T> IndexMut<(usize, usize)> for Grid<T> {
    fn index_mut(&mut self, (x, y): (usize, usize)) -> &mut T {
        debug_assert!(x < self.width && y < self.height);
        &mut self.data[y * self.width + x]
    }
}
