//! Step 1: the rigid motion of each region.

mod cholesky;
mod joint;
mod least_squares;

pub use cholesky::solve_positive;
pub use joint::{Joint, JointStep, Kind};
pub use least_squares::least_squares;
