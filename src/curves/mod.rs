//! Curves: drawn as shapes, kept as level sets φ > 0 inside, read as labels, lengths and polylines.

mod contour;
mod labels;
mod length;
mod polygon;
mod shape;

pub use contour::{Contour, contours};
pub use labels::labels;
pub(crate) use labels::{differing, smoothed};
pub use length::length;
pub(crate) use polygon::sides;
pub use shape::Shape;
