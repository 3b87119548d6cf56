//! From bytes to what the solver reads: decoding, brightness, and its derivatives.

mod decode;
mod derivatives;
mod fields;
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
mod tiff;

pub use derivatives::{Derivatives, gradient};
pub use film::{Film, Kind, Moment};
pub use frame::{Frame, FramePair, MAX_PIXELS, MAX_SIDE, MIN_SIDE, MOST_WORKED};
pub(crate) use frame::{check_size, least_factor};
pub use gaussian::blur;
pub use lens::{Lens, LensSource};
pub use lighting::Lighting;
pub use note::Note;
pub use pyramid::{doubled, halved, halved_camera};
pub(crate) use shrink::shrunk_camera;
pub use spline::Spline;
