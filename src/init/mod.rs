//! What is found of two frames before anything is known: sparse matches, and the rigid motion that explains most of them.

mod background;
mod block_search;
mod box_mean;
mod curves;
mod displacement;
mod epipolar;
mod focal;
mod lattice;
mod local_flow;
mod lucas_kanade;
mod matches;
mod outline;
mod pieces;
mod rotation;
mod sample;
mod segments;

pub use box_mean::{box_mean, less_box_mean};
pub use curves::find_curves;
pub use displacement::{Displacement, Verdict, displacement};
pub use epipolar::{EpipolarMotion, epipolar_motion};
pub use focal::{FocalLength, focal_length};
pub use matches::{Match, matches};
