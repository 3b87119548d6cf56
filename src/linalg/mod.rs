//! Linear algebra that every part of the method may use; it knows of no picture.

mod banded;
mod cholesky;
mod sphere;

pub(crate) use banded::Banded;
pub(crate) use cholesky::solve_positive;
pub(crate) use sphere::hemisphere;
