//! Step 1: the rigid motion of each region.

mod cholesky;
mod eliminated;
mod joint;
mod kind;

pub use cholesky::solve_positive;
pub use eliminated::{Blocks, Candidate};
pub use joint::{Joint, JointStep, held};
pub use kind::Kind;
