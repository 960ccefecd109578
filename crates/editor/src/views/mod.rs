//! The views of the stone, and the overlays and marks in them.

pub mod bench_mode;
pub mod clock;
mod copies;
mod eye_hand;
mod following;
pub mod gallery;
mod known_corners;
pub mod light_path;
pub mod light_path_window;
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
mod tier_drag;
mod tier_hand;
mod tier_picking;
pub mod tools;
mod view_menu;

pub use tools::ViewTools;
