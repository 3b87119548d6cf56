//! The built-in sequences and random scenes.

mod scene;
