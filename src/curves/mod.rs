//! Step 3: the curves that bound the regions.

mod competition;
mod contour;
mod evolution;
mod redistance;
mod shape;
mod threshold;

pub use competition::{misfit, refuted, residual_in_units};
pub use contour::{Contour, contours};
pub use evolution::{evolve, labels, length};
pub use redistance::redistance;
pub use shape::Shape;
pub use threshold::threshold;
