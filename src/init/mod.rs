//! What is found of two frames before anything is known: sparse matches, and the rigid motion that explains most of them.

mod block_search;
mod box_mean;
mod epipolar;
mod lucas_kanade;
mod matches;
mod rotation;

pub use box_mean::{box_mean, less_box_mean};
pub use epipolar::{EpipolarMotion, epipolar_motion};
pub use matches::{Match, matches};
