//! The layered solver: coarse to fine, one layer a region.

pub mod refine;
