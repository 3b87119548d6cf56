//! Numerical linear algebra that several steps use.

mod cholesky;
mod sphere;

pub use cholesky::solve;
pub use sphere::{hemisphere, tangents};
