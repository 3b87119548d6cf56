//! Step 2: depth at every pixel.

mod confidence;
mod crease;
mod descent;
mod elliptic;
mod region_field;
mod smoothness;

pub use confidence::confidence;
pub use crease::creases;
pub use descent::{DepthDescent, NEAREST_FARTHEST};
pub use elliptic::Elliptic;
pub use region_field::{Bends, Edges, FieldPrior, Plane};
pub use smoothness::Smoothness;
