//! Step 3: the curves that bound the regions.

mod shape;

pub use shape::Shape;
