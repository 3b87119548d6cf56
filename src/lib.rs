//! Relievo.

pub mod camera;
pub mod constraint;
pub mod curves;
pub mod depth;
pub mod energy;
pub mod error;
pub mod file;
pub mod frames;
pub mod grid;
pub mod horn_schunck;
pub mod interpretation;
pub mod motion;
pub mod options;
pub mod scene;
pub mod score;
pub mod solver;
pub mod view;
pub mod warp;

pub use camera::{Camera, RigidMotion};
pub use curves::{Contour, Shape};
pub use error::Error;
pub use frames::{Frame, FramePair};
pub use grid::Grid;
pub use interpretation::{Flow, Interpretation};
pub use options::Options;
pub use solver::{Solver, Status};

#[cfg(target_arch = "wasm32")]
pub mod wasm;
