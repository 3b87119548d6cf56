//! JSON text as values. Text becomes a [`Value`] first, and that what is wanted: so the parser is compiled once, and not
//! for everything that is read.

use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::error::Error;

/// What `text` says; `what` is what errors call it.
///
/// # Errors
/// [`Error::Json`] where it is no JSON, or of something else.
pub(crate) fn read<T: DeserializeOwned>(text: &str, what: &'static str) -> Result<T, Error> {
    T::deserialize(parsed(text, what)?).map_err(|e| unreadable(e, what))
}

fn parsed(text: &str, what: &'static str) -> Result<Value, Error> {
    serde_json::from_str(text).map_err(|e| unreadable(e, what))
}

/// That a value is not what it should be.
pub(crate) fn unreadable(error: serde_json::Error, what: &'static str) -> Error {
    Error::Json {
        what,
        reason: error.to_string(),
    }
}
