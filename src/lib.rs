//! Relievo.

pub mod camera;
pub mod curves;
pub mod error;
pub mod frames;
pub mod grid;
pub mod horn_schunck;
pub mod interpretation;
pub mod options;

pub use camera::{Camera, RigidMotion};
pub use curves::Shape;
pub use error::Error;
pub use frames::{Frame, FramePair};
pub use grid::Grid;
pub use interpretation::{Flow, Interpretation};
