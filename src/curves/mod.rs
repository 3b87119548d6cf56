//! Curves: drawn as shapes, kept as level sets φ > 0 inside, read as labels, lengths and polylines.

mod competition;
mod contour;
mod evolution;
mod geodesic;
mod islands;
mod labels;
mod length;
mod polygon;
mod redistance;
mod relaxation;
mod shape;
mod threshold;

pub use competition::Measure;
pub use contour::{Contour, contours};
pub use evolution::{cost, evolve};
pub use geodesic::outline_cost;
pub use islands::without_islands;
pub use labels::labels;
pub use length::length;
pub use redistance::redistance;
pub use relaxation::least_partition;
pub use shape::Shape;
pub use threshold::threshold;
