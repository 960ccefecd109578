//! The editor, a window in which a stone is cut and its light is watched.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod arrows;
mod dialogs;
mod drops;
mod editor;
mod glyphs;
mod hands;
mod icon;
mod library_cuts;
mod menus;
mod panels;
mod polygons;
mod profile_view;
mod scrolled;
mod setup;
mod shortcuts;
mod state_file;
mod theme;
mod trouble_bar;
mod views;
mod window;

pub use brillianteer_session::model::workspace::Workspace;
pub use editor::Editor;
pub use setup::{PaintedBy, Setup};
pub use window::{WindowError, run};

#[cfg(test)]
mod tests;

// Files that tests of several crates share.
#[cfg(test)]
#[path = "../../../tests/common/proportions.rs"]
mod random;
#[cfg(test)]
#[path = "../../../tests/common/solids.rs"]
mod solids;
