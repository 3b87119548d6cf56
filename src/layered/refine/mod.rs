//! Dense inverse depth of one rigid motion: a plane sweep for where it has steps, and its refinement.

mod boundaries;
mod census;
mod dense;
mod hidden;
mod linearisation;
mod lines;
mod motion_step;
mod semi_global;
mod sweep;
mod volume;

pub use dense::{Refined, refine};
pub use sweep::{match_range, sweep};

#[cfg(all(target_arch = "wasm32", feature = "bench"))]
pub use {census::census, semi_global::aggregate, volume::volume};
