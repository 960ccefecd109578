//! The editor, a window in which a stone is cut and its light is watched.

mod arrows;
mod described;
mod dialogs;
mod drops;
mod editor;
mod glyphs;
mod hands;
mod icon;
mod library_cuts;
mod liquid;
mod lookup;
mod menus;
mod model;
mod panels;
mod polygons;
mod profile_view;
mod scrolled;
mod setup;
mod shortcuts;
mod shows;
mod state_file;
mod studio;
mod tasks;
mod theme;
mod trouble_bar;
mod urgency;
mod value_grid;
mod views;
mod window;

pub use editor::Editor;
pub use model::workspace::Workspace;
pub use setup::{PaintedBy, Setup};
pub use window::{WindowError, run};

#[cfg(test)]
mod tests;
