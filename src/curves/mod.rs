//! Step 3: the curves that bound the regions.

mod contour;
mod evolution;
mod redistance;
mod shape;

pub use contour::{Contour, contours};
pub use evolution::{evolve, labels, length};
pub use redistance::redistance;
pub use shape::Shape;
