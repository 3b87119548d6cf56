//! Step 1: the rigid motion of each region.

mod eliminated;
mod joint;
mod kind;

pub use crate::linalg::solve as solve_positive;
pub use eliminated::{Blocks, Candidate};
pub use joint::{Joint, JointStep, held};
pub use kind::Kind;
