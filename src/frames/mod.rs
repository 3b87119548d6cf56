//! From bytes to what the solver reads: decoding, brightness, and its derivatives.

mod derivatives;
mod frame;
mod gaussian;
mod lighting;
mod pyramid;
mod spline;

pub use derivatives::{Derivatives, gradient};
pub use frame::{Frame, FramePair, MAX_SIDE, MIN_SIDE};
pub use gaussian::blur;
pub use lighting::Lighting;
pub use pyramid::{halved, halved_camera};
pub(crate) use spline::Spline;
