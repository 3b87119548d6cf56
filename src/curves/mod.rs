//! Step 3: the curves that bound the regions.

mod evolution;
mod redistance;
mod shape;

pub use evolution::{evolve, labels, length};
pub use redistance::redistance;
pub use shape::Shape;
