//! A start: curves where something moves by itself, and motions, from where small patches go.

mod assignment;
mod automatic;
mod bodies;
mod consensus;
mod focal;
mod lattice;
mod likeness;
mod look;
mod outline;
mod parting;
mod patches;
mod rigid;
mod seams;
mod sight;
mod surface;
mod surfaces;
mod union;

pub use assignment::assignment;
pub use automatic::automatic;
pub use consensus::{dominant, inside};
pub use focal::{FocalLength, focal_length};
pub use look::Look;
pub use patches::{Patch, patches};
