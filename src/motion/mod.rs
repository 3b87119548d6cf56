//! Step 1: the rigid motion of each region.

mod cholesky;
mod least_squares;

pub use cholesky::solve_positive;
pub use least_squares::least_squares;
