//! What is found of two frames before anything is known: sparse matches, and the rigid motion that explains most of them.

mod affine;
mod background;
mod block_search;
mod box_mean;
mod curves;
mod displacement;
mod epipolar;
mod field;
mod focal;
mod groups;
mod lattice;
mod lucas_kanade;
mod matches;
mod outline;
mod patches;
mod rotation;
mod sample;
mod segments;

pub(crate) use box_mean::less_box_mean;
pub(crate) use curves::{Candidates, candidates};
pub use displacement::{Displacement, Verdict, displacement};
pub use epipolar::{EpipolarMotion, epipolar_motion};
pub use focal::{FocalLength, focal_length};
pub(crate) use lucas_kanade::RADIUS as MATCH_RADIUS;
pub use matches::{Match, matches};
pub(crate) use outline::outlines;
pub(crate) use sample::{Carrier, Sample, Small, small_samples};
