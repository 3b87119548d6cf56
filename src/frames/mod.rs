//! From bytes to what the solver reads: decoding, brightness, and its derivatives.

mod derivatives;
mod edges;
mod frame;
mod gaussian;
mod lighting;
mod pyramid;
mod spline;

pub use derivatives::{Derivatives, gradient};
pub use edges::{edge_weight, edge_weights_across};
pub use frame::{Frame, FramePair, MAX_SIDE, MIN_SIDE};
pub use gaussian::blur;
pub(crate) use gaussian::half_gaussian;
pub use lighting::Lighting;
pub use pyramid::{doubled, halved, halved_camera};
pub use spline::Spline;
