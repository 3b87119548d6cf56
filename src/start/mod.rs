//! A start for the motions inside given curves, from where small patches go.

mod assignment;
mod consensus;
mod patches;

pub use assignment::assignment;
pub use consensus::{dominant, inside};
pub use patches::{Patch, patches};
