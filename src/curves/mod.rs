//! Curves: drawn as shapes, kept as level sets φ > 0 inside, read as labels, lengths and polylines.

mod contour;
mod labels;
mod length;
mod polygon;
mod shape;

pub use contour::{Contour, contours};
pub(crate) use labels::differing;
pub use labels::labels;
pub use length::length;
pub use shape::Shape;
