//! What JavaScript sees: the core's own words, passed on.
//!
//! Nothing is computed here. Pictures and arrays cross as typed arrays of their own memory (they
//! stay valid whatever happens to the core afterwards), structured values as JSON text, and every
//! [`crate::Error`] as a JavaScript `Error` whose message is its sentence. Objects hold memory that
//! JavaScript's collector frees when it likes: `free()` does it at once.

mod catalogue;
mod frame;
mod panic;
mod scene;
mod solver;

pub use catalogue::{limits, option_catalogue, scene_catalogue};
pub use frame::{Frame, Picture};
pub use panic::{panic_for_test, panic_message};
pub use scene::Scene;
pub use solver::Solver;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::Error;

/// Reads JSON that came from JavaScript; `what` is what an error calls it.
fn read<T: DeserializeOwned>(what: &'static str, json: &str) -> Result<T, Error> {
    serde_json::from_str(json).map_err(|e| Error::Json {
        what,
        reason: e.to_string(),
    })
}

/// Writes JSON for JavaScript. What is not a number becomes `null`.
fn write<T: Serialize + ?Sized>(value: &T) -> String {
    serde_json::to_string(value).expect("the core's own values have text for keys")
}
