//! Every weight and choice, once.

/// Curves that may be drawn at most; with the background that makes eight regions.
pub const MAX_CURVES: usize = 7;
