//! A start: curves where something moves by itself, and motions, from where small patches go.

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
mod scale;
mod seams;
mod sight;
mod surface;
mod surfaces;
mod union;

pub use automatic::automatic;
pub use focal::{FocalLength, focal_length};
