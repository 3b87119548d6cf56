//! Step 3: the curves that bound the regions.

mod competition;
mod contour;
mod evolution;
mod geodesic;
mod islands;
mod polygon;
mod redistance;
mod relaxation;
mod shape;
mod threshold;

pub use competition::Measure;
pub use contour::{Contour, contours};
pub use evolution::{cost, evolve, labels, length};
pub use geodesic::outline_cost;
pub use islands::without_islands;
pub use redistance::redistance;
pub use relaxation::least_partition;
pub use shape::Shape;
pub use threshold::threshold;
