//! Relievo: which parts of a film move, how, and how deep they are, from two of its frames.
//!
//! A camera looks at things that move by themselves, each as a rigid body. Unknown, and found
//! together, are a partition of the frame into regions, each region's rigid motion, and depth at every
//! pixel. The method is that of H. Sekkati and A. Mitiche, "Concurrent 3-D motion segmentation and 3-D
//! interpretation of temporal sequences of monocular images", IEEE Transactions on Image Processing
//! 15(3), 2006; numbers in brackets are that paper's. No optical flow is computed first: each pixel
//! has one equation between its depth Z and its region's translation T and rotation ω,
//!
//! ```text
//! ψ = It + s·T/Z + q·ω = 0
//! ```
//!
//! and closed curves, motions and depth are sought that make one functional small,
//!
//! ```text
//! (7)  E = Σk ∫_Rk [ ψk² + μ g(‖∇Z‖) ] dx + λ Σ_{k≥1} ∮_γk ds
//! ```
//!
//! by three steps in turn: motion by least squares, depth by descent, curves as level sets. So does
//! [`Preset::Paper`](options::Preset::Paper). [`Preset::Best`](options::Preset::Best), the default, takes
//! the same steps coarse to fine, with depth eliminated from the motion step and a depth field for each
//! region.
//!
//! # Use
//!
//! A [`FramePair`], a [`Camera`], a curve ([`Shape`]) roughly on each moving thing and [`Options`] make
//! a [`Solver`]; its [`step`](Solver::step) is one pass; what it has found at any moment is an
//! [`Interpretation`], which [`view`] draws, [`file`](mod@file) writes and [`score`] compares.
//!
//! ```
//! use relievo::{FramePair, Options, Solver, Status, scene, score};
//!
//! let squares = scene::render("squares", 120, 90)?;
//! let [first, second] = squares.frames.clone();
//! let pair = FramePair::new(first, second)?;
//! let camera = squares.truth.camera;
//! let mut solver = Solver::new(pair, camera, &squares.curves, Options::default())?;
//! while solver.step() == Status::Running {}
//!
//! let found = solver.interpretation();
//! assert_eq!(found.regions(), 3); // the background and two squares
//! let scores = score::compare(&found, &squares.truth)?;
//! assert!(scores.labels_wrong < 0.1);
//! # Ok::<(), relievo::Error>(())
//! ```
//!
//! # Features
//!
//! - `decoders` (on): frames from JPEG, PNM, WebP, BMP, GIF and TIFF files, films and EXIF data; without it from PNG files only.
//! - `scenes` (on): [`scene`], the built-in sequences with their truth.
//! - `javascript`: what JavaScript sees of it, for `wasm32-unknown-unknown` only; `javascript-decoders`: the same of what
//!   opens files, for a module of its own.
//!
//! # Versions
//!
//! Semantic versioning: before 1.0 a minor version may change the interface, a patch does not. What counts is what is
//! documented here; figures that come out may change with any version that finds better ones. It needs Rust 1.95; a later
//! one is asked for by a minor version only.
//!
//! # Conventions
//!
//! Pixel (0, 0) is the centre of the top-left pixel, x to the right, y down, Z forward. f is in pixels,
//! brightness in grey levels 0–255, T in units in which its region's mean 1/Z is 1, ω in radians per
//! frame. Label 0 is the background, k the inside of the k-th curve. Every error is an [`Error`], a
//! sentence; bad input never panics.

pub mod camera;
mod confidence;
mod connected;
pub mod constraint;
pub mod curves;
pub mod energy;
pub mod error;
pub mod file;
pub mod frames;
pub mod grid;
pub mod horn_schunck;
pub mod init;
pub mod interpretation;
mod json;
mod layered;
mod linalg;
mod motion_model;
pub mod options;
mod ordered;
pub mod paper;
pub mod probe;
#[cfg(feature = "scenes")]
pub mod scene;
pub mod score;
mod smoothness;
pub mod solver;
mod spread;
mod srgb;
pub mod view;
pub mod window;
pub mod working;

pub use camera::{Camera, RigidMotion};
pub use curves::{Contour, Shape};
pub use error::Error;
pub use frames::{Frame, FramePair};
/// The vectors of [`RigidMotion`] are its.
pub use glam;
pub use grid::Grid;
pub use interpretation::{Flow, Interpretation, Pixel};
pub use motion_model::MotionModel;
pub use options::Options;
pub use solver::{Solver, Status};
pub use window::Window;

#[cfg(all(
    target_arch = "wasm32",
    any(feature = "javascript", feature = "javascript-decoders")
))]
pub mod wasm;
