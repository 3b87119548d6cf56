//! A start for the regions' motions, from where small patches go.

mod consensus;
mod patches;

pub use consensus::{dominant, inside};
pub use patches::{Patch, patches};
