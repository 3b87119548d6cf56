//! Step 2: depth at every pixel.

mod descent;
mod elliptic;
mod smoothness;

pub use descent::{DepthDescent, NEAREST_FARTHEST};
pub use elliptic::Elliptic;
pub use smoothness::Smoothness;
