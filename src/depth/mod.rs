//! Step 2: depth at every pixel.

mod descent;
mod smoothness;

pub use descent::{DepthDescent, NEAREST_FARTHEST};
pub use smoothness::Smoothness;
