//! Pictures and meshes of what was found.

mod view;
