//! Pictures and meshes of what was found.

mod surface;
mod view;
