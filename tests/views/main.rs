//! Pictures and meshes of what was found.

mod legend;
mod view;
