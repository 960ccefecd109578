//! The views of the stone and what is drawn in them.

mod arrows;
mod copies;
mod eye_hand;
pub mod following;
pub mod gallery;
pub mod light_path;
mod liquid_view;
pub mod look_ups;
pub mod modes;
mod pane;
mod pane_context;
mod pane_head;
mod pane_view;
pub mod probe;
mod refraction_view;
mod scene_view;
pub mod stage;
pub mod tools;
pub mod view_menu;

pub use tools::ViewTools;
