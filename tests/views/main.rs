//! Pictures and meshes of what was found.

mod legend;
mod measured;
mod sizes;
mod surface;
mod view;
