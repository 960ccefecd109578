//! The views of the stone and what is drawn in them.

pub mod copies;
pub mod following;
pub mod gallery;
pub mod light_path;
pub mod modes;
pub mod pane;
pub mod probe;
pub mod refraction_view;
pub mod stage;
pub mod view_menu;
