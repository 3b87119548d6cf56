//! Coarse to fine, one layer a region.

mod estimate;
mod label;
mod region;
mod scale;
mod solver;

pub(crate) use solver::Layered;
pub use solver::ORACLE;
