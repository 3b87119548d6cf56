//! What any bytes may do to the core: nothing. Each function takes bytes, makes of them what a user could give, and
//! panics where the core does, or where what it gives back breaks its promise.
//!
//! `npm run fuzz` calls them with bytes that libFuzzer thinks up, `tests/core` with those of `fuzz/corpus`.

mod files;
mod frames;
mod settings;
mod solves;

pub use files::files;
pub use frames::frames;
pub use settings::settings;
pub use solves::solves;

/// Takes any bytes.
pub type Target = fn(&[u8]);

/// The functions by name.
pub const ALL: [(&str, Target); 4] = [
    ("frames", frames),
    ("files", files),
    ("settings", settings),
    ("solves", solves),
];
