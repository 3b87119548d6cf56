//! From bytes to what the solver reads: decoding, brightness, and its derivatives.

mod frame;

pub use frame::{Frame, FramePair, MAX_SIDE, MIN_SIDE};
