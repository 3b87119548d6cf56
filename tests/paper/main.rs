//! The method as printed: the constraint, each step by its own property, and what the preset `paper` finds.

#[path = "../solving/mod.rs"]
mod solving;

mod confidence;
mod constraint;
mod curves;
mod depth;
mod drawn;
mod energy;
mod finds;
mod motion;
mod steps;
