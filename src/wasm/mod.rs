//! What JavaScript sees: the core's own words, passed on.
//!
//! There are two modules of WebAssembly, each with a feature of its own: that which solves reads PNG files, and asks
//! for the one that opens others when it meets such a file. Nothing is computed here. Pictures and arrays cross as
//! typed arrays of their own memory (they stay valid whatever happens to the core afterwards), structured values as
//! JSON text, and every [`crate::Error`] as a JavaScript `Error` whose message is its sentence. Objects hold memory
//! that JavaScript's collector frees when it likes: `free()` does it at once.

#[cfg(feature = "javascript-decoders")]
mod decoders;
mod panic;
#[cfg(feature = "javascript")]
mod solving;

#[cfg(feature = "javascript-decoders")]
pub use decoders::{Opened, Unpacked, unpack, views_of};
pub use panic::{panic_for_test, panic_message};
#[cfg(feature = "javascript")]
pub use solving::*;

use wasm_bindgen::JsValue;

use crate::Error;

/// An error's `name` tells whose fault it is: `SettingError` for a number or word that no frame could
/// make right, `InputError` for what is wrong with the frames or does not go with them.
impl From<Error> for JsValue {
    fn from(error: Error) -> Self {
        let thrown = js_sys::Error::new(&error.to_string());
        thrown.set_name(match error {
            Error::Focal(_)
            | Error::Centre(..)
            | Error::TooManyCurves(_)
            | Error::CurveNotFinite { .. }
            | Error::Option { .. }
            | Error::Count { .. }
            | Error::Choice { .. } => "SettingError",
            _ => "InputError",
        });
        thrown.into()
    }
}
