//! Step 2: depth at every pixel.

mod bends;
mod crease;
mod elliptic;
mod hollow;
mod local_line;
mod plane;
mod polynomials;
mod region_field;

pub use bends::Bends;
pub use crease::creases;
pub use elliptic::Elliptic;
pub use hollow::hollow;
pub use local_line::local_line;
pub use plane::Plane;
pub use polynomials::Polynomials;
pub use region_field::{Edges, FieldPrior};
