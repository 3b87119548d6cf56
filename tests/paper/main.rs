//! The method as printed: each step by its own property, and what the preset `paper` finds.

#[path = "../support/mod.rs"]
mod support;

mod curves;
mod depth;
mod energy;
mod finds;
mod motion;
