//! Coarse to fine, one layer a region.

mod estimate;
mod label;
pub mod refine;
mod region;
mod scale;
mod solver;

pub(crate) use solver::Layered;
pub use solver::ORACLE;
