//! From bytes to what the solver reads: decoding, brightness, and its derivatives.

mod absent;
mod apng;
mod derivatives;
mod fields;
mod film;
mod frame;
mod gaussian;
#[cfg(feature = "decoders")]
mod jpeg;
mod lens;
mod levels;
mod lighting;
mod note;
#[cfg(feature = "decoders")]
pub(crate) mod others;
#[cfg(feature = "decoders")]
pub(crate) mod pictures;
mod pyramid;
mod samples;
mod shrink;
mod spline;
#[cfg(feature = "decoders")]
mod tiff;
mod unpack;

pub use derivatives::{Derivatives, gradient};
#[cfg(all(
    target_arch = "wasm32",
    any(feature = "javascript", feature = "javascript-decoders")
))]
pub(crate) use film::Contents;
pub use film::{Film, Kind, Moment};
#[cfg(any(feature = "scenes", feature = "javascript"))]
pub(crate) use frame::check_size;
pub(crate) use frame::least_factor;
pub use frame::{Frame, FramePair, MAX_PIXELS, MAX_SIDE, MIN_SIDE, MOST_WORKED};
pub use gaussian::blur;
#[cfg(all(target_arch = "wasm32", feature = "javascript-decoders"))]
pub(crate) use jpeg::views;
pub use lens::{Lens, LensSource};
pub use lighting::Lighting;
pub use note::Note;
pub use pyramid::{halved, halved_camera};
#[cfg(all(target_arch = "wasm32", feature = "javascript-decoders"))]
pub(crate) use samples::Samples;
#[cfg(all(target_arch = "wasm32", feature = "javascript"))]
pub(crate) use samples::frame_of_rows;
#[cfg(all(
    target_arch = "wasm32",
    any(feature = "javascript", feature = "javascript-decoders")
))]
pub(crate) use samples::{Raw, Sample};
pub(crate) use shrink::{shrunk_camera, shrunk_colours};
pub(crate) use spline::{LANES, Spline};
#[cfg(all(target_arch = "wasm32", feature = "javascript-decoders"))]
pub(crate) use unpack::check_length;
#[cfg(all(target_arch = "wasm32", feature = "javascript"))]
pub(crate) use unpack::each_picture;
