//! JSON text as values. Text becomes a [`Value`] first, and that what is wanted: so the parser is compiled once, and not
//! for everything that is read.

use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::error::Error;

/// The object that `text` writes; `what` is what errors call it.
///
/// # Errors
/// [`Error::Json`] where it is no JSON object, or of something else.
pub(crate) fn read<T: DeserializeOwned>(text: &str, what: &'static str) -> Result<T, Error> {
    object(parsed(text, what)?, what)
}

/// The value that `text` writes.
///
/// # Errors
/// [`Error::Json`] where it is no JSON.
pub(crate) fn parsed(text: &str, what: &'static str) -> Result<Value, Error> {
    // So the parser is compiled in its own crate, for size.
    text.parse().map_err(|e| unreadable(e, what))
}

/// What an object says.
///
/// # Errors
/// [`Error::Json`] where it is none, or of something else.
pub(crate) fn object<T: DeserializeOwned>(it: Value, what: &'static str) -> Result<T, Error> {
    match it {
        // Of a `Map` nothing is compiled that would read T from an array.
        Value::Object(map) => T::deserialize(map).map_err(|e| unreadable(e, what)),
        _ => Err(Error::Json {
            what,
            reason: "a JSON object is needed".to_owned(),
        }),
    }
}

/// That a value is not what it should be.
pub(crate) fn unreadable(error: serde_json::Error, what: &'static str) -> Error {
    Error::Json {
        what,
        reason: error.to_string(),
    }
}
