//! Step 2: depth at every pixel.

mod bends;
mod confidence;
mod crease;
mod descent;
mod elliptic;
mod hollow;
mod local_line;
mod plane;
mod polynomials;
mod region_field;
mod smoothness;

pub use bends::Bends;
pub use confidence::confidence;
pub use crease::creases;
pub use descent::{DepthDescent, NEAREST_FARTHEST};
pub use elliptic::Elliptic;
pub use hollow::hollow;
pub use local_line::local_line;
pub use plane::Plane;
pub use polynomials::Polynomials;
pub use region_field::{Edges, FieldPrior};
pub use smoothness::Smoothness;
