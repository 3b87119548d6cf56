//! Pictures and meshes of what was found.

mod legend;
mod measured;
mod surface;
mod view;
