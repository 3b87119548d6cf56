//! The method as printed: H. Sekkati and A. Mitiche, *Concurrent 3-D motion segmentation and 3-D interpretation of
//! temporal sequences of monocular images*, IEEE Transactions on Image Processing 15(3), 2006.
//!
//! One scale, one depth Z for all regions, and three steps in turn until the curves stand still:
//!
//! | paper            | here            | what it does                                                      |
//! | ---------------- | --------------- | ----------------------------------------------------------------- |
//! | (7)              | `energy.rs`     | the functional, term by term                                      |
//! | ψ                | `psi.rs`        | ψ of every region, row by row                                     |
//! | step 1           | `motion.rs`     | (T, ω) of every region by linear least squares, Z and curves fixed |
//! | step 2, (9)      | `depth.rs`      | descent on Z, motions and curves fixed                            |
//! | (11), (12)       | `Smoothness`    | the function g that smooths depth                                 |
//! | step 3, (17)     | `curves.rs`     | curves as level sets, motions and Z fixed                         |
//! | –                | `redistance.rs` | keeps level sets distances; the paper does not say how            |
//! | –                | `weights.rs`    | μ and λ, which the paper sets by hand                             |
//! | –                | `confidence.rs` | how far depth shows at a pixel                                    |
//! | the whole        | `solver.rs`     | the order of the steps, the scale of depth, what is reported      |
//!
//! The constraint ψ itself is in [`constraint`](crate::constraint). Grids and products are `f32`, what is summed over
//! more than a row is `f64`.

mod curves;
mod depth;
mod energy;
mod motion;
mod packed;
mod psi;
mod redistance;
mod rows;
mod solver;
mod weights;

/// The function g of (11) and (12).
pub use crate::smoothness::Smoothness;
pub use curves::{CurveEvolution, Residuals};
pub use depth::DepthDescent;
pub use energy::energy;
pub use motion::least_squares;
pub use psi::Psi;
pub(crate) use solver::Paper;
