//! The preset `best`: coarse to fine, one layer a region.
//!
//! Every region has a motion and a surface of its own, which goes on beyond its outline. Sought are labels, motions and
//! surfaces that make
//!
//! ```text
//! E = Σk Σ_{x∈Rk} c(ek)  +  μ Σk ∫ g(‖∇²ρk‖)  +  λ · length
//! ```
//!
//! small: c the Geman–McClure cost of the residual ek = I2(π(R r + ρ T)) − I1, in grey levels²; ρ = 1/Z. It is (7) with the
//! whole displacement in place of its linearisation, a robust cost in place of the square, and with curvature in place of
//! slope, so that slanted surfaces cost nothing.
//!
//! `solver.rs` is the one loop: for each scale *estimate* (`estimate/`: motion and surface from normal equations), *label*
//! (`label/`: who owns which pixel), and on the finest scale *refine* (`refine/`: depth pixel by pixel where it has steps).

mod approach;
mod by_matches;
mod compose;
mod discontinuities;
mod estimate;
#[cfg(all(target_arch = "wasm32", feature = "bench"))]
pub(crate) mod kernels;
mod label;
mod merge;
mod models;
mod packed;
mod refine;
mod region;
mod scale;
mod solver;
mod stages;
mod start;
mod view;
mod warm;

pub(crate) use solver::Layered;
