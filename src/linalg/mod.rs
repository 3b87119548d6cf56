//! Linear algebra that every part of the method may use; it knows of no picture.

mod banded;
mod cholesky;
mod sphere;
mod sums;

pub(crate) use banded::Banded;
pub use cholesky::solve;
pub(crate) use sphere::{hemisphere, tangents};
pub(crate) use sums::{dot, sum};
