//! The solver: its interface under both presets, what it refuses, and what the preset `best` finds and promises.

#[path = "../support/mod.rs"]
mod support;

mod best;
mod detail;
mod extremes;
mod films;
mod light;
mod passes;
mod refused;
mod states;
mod steps;
