//! Pictures and meshes of what was found.

mod legend;
mod surface;
mod view;
