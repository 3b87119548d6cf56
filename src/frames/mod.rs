//! From bytes to what the solver reads: decoding, brightness, and its derivatives.

mod absent;
mod decode;
mod derivatives;
mod fields;
#[cfg(feature = "decoders")]
mod film;
mod frame;
mod gaussian;
mod jpeg;
mod lens;
mod levels;
mod lighting;
mod note;
mod pyramid;
mod samples;
mod shrink;
mod spline;
#[cfg(feature = "decoders")]
mod tiff;

pub use derivatives::{Derivatives, gradient};
#[cfg(feature = "decoders")]
pub use film::{Film, Kind, Moment};
#[cfg(feature = "scenes")]
pub(crate) use frame::check_size;
pub(crate) use frame::least_factor;
pub use frame::{Frame, FramePair, MAX_PIXELS, MAX_SIDE, MIN_SIDE, MOST_WORKED};
pub use gaussian::blur;
pub use lens::{Lens, LensSource};
pub use lighting::Lighting;
pub use note::Note;
pub use pyramid::{halved, halved_camera};
pub(crate) use shrink::shrunk_camera;
pub(crate) use spline::{LANES, Spline};
