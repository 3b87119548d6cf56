//! Stage 2 of a scale: which region each pixel belongs to.

mod data_cost;
mod occlusion;
mod partition;

pub(crate) use data_cost::{finish, planar_cost, rigid_cost, saturation};
pub(crate) use occlusion::Cover;
pub(crate) use partition::{LENGTH_OF_PULL, box_blur, outline_energy, partition};
