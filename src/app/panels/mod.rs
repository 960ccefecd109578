//! The panels beside the views, made of rows.

pub mod audit_panel;
pub mod copy_rows;
pub mod design_panel;
pub mod figure_lines;
pub mod figures_panel;
pub mod figures_text;
pub mod gear_fields;
mod goal_rows;
pub mod light_rows;
mod map_lines;
pub mod map_plot;
pub mod map_window;
pub mod material_rows;
pub mod mesh_rows;
pub mod pane_rows;
mod ring_rows;
pub mod rows;
mod scale_fields;
pub mod scene_rows;
mod search_plot;
mod search_table;
pub mod search_window;
pub mod side_panels;
pub mod stone_rows;
pub mod tier_rows;
pub mod tier_table;
pub mod tilt_plot;
