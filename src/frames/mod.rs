//! From bytes to what the solver reads: decoding, brightness, and its derivatives.

mod decode;
mod derivatives;
mod frame;
mod gaussian;
mod lighting;
mod pyramid;
mod samples;
mod shrink;
mod spline;

pub use derivatives::{Derivatives, gradient};
pub use frame::{Frame, FramePair, MAX_PIXELS, MAX_SIDE, MIN_SIDE, MOST_WORKED};
pub(crate) use frame::{check_size, least_factor};
pub use gaussian::blur;
pub use lighting::Lighting;
pub use pyramid::{doubled, halved, halved_camera};
pub(crate) use shrink::shrunk_camera;
pub use spline::Spline;
