//! Stage 1 of a scale: motion and relief of every region, on statistics of its pixels.

mod candidates;
mod curvature;
mod normal_equations;
mod planar;
mod rows;
mod state;
mod step;
mod surface;

pub(crate) use candidates::{Blocks, OTHER_DIRECTION};
pub(crate) use curvature::{Prior, surface_energy};
#[cfg(all(target_arch = "wasm32", feature = "bench"))]
pub(crate) use normal_equations::NormalEquations;
pub(crate) use normal_equations::{Problem, Support, most_cost};
pub(crate) use planar::{Degree, PlanarFlow};
pub(crate) use state::State;
pub(crate) use step::Estimator;
pub(crate) use surface::Surface;
