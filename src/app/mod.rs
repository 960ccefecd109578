//! Floor 6: the editor, a window in which a stone is cut and its light is watched.

mod about;
mod asked_path;
mod command;
mod company_rows;
mod compare;
mod copies;
mod copying;
mod design_panel;
mod desk;
mod dialogs;
mod document;
mod drops;
mod editor;
mod export_dialog;
mod export_job;
mod export_scene;
mod extent;
mod eye;
mod figures_panel;
mod figures_text;
mod files;
mod following;
mod framing;
mod glass_rows;
mod history;
mod icon;
mod keeping;
mod light_path;
mod liquid;
mod look;
mod lookup;
mod menus;
mod moving;
mod notes;
mod opener;
mod opening;
mod ordering;
mod pane;
mod pane_rows;
mod posed;
mod preset;
mod probe;
mod profile_view;
mod proportions;
mod refraction_view;
mod rows;
mod shows;
mod side_panels;
mod stage;
mod state_file;
mod stone_rows;
mod studio;
mod theme;
mod tier_rows;
mod trouble_bar;
mod view_menu;

pub use desk::Desk;
pub use editor::{Editor, Setup};

use crate::io::mesh_options::MeshOptions;
use crate::trace::gpu::Gpu;
use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use state_file::StateFile;
use std::path::PathBuf;
use std::sync::Arc;

/// What the program is called where windows and folders are kept.
const ID: &str = "brillianteer";

/// The window's first size, and its least, points.
const SIZE: [f32; 2] = [1440.0, 900.0];
const LEAST: [f32; 2] = [800.0, 600.0];

/// Opens the window, on a file if one is given, read with these options where it is a mesh, and waits until it is closed.
///
/// # Errors
/// Where there is no display, or nothing that can draw on it; what to do stands in the text.
pub fn run(file: Option<PathBuf>, mesh: MeshOptions) -> Result<(), String> {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    // The tracer shares the device: what it needs is asked for.
    setup.device_descriptor = Arc::new(Gpu::wanted);
    let viewport =
        egui::ViewportBuilder::default().with_app_id(ID).with_inner_size(SIZE).with_min_inner_size(LEAST);
    let viewport = match icon::icon() {
        Some(icon) => viewport.with_icon(icon),
        None => viewport,
    };
    let options = eframe::NativeOptions {
        viewport,
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(setup), ..Default::default() },
        ..Default::default()
    };
    let safe = eframe::storage_dir(ID);
    let create = move |context: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
        let state_file = StateFile::from_environment();
        Ok(Box::new(Editor::new(context, Setup { file, mesh, safe, state_file, ..Setup::default() })?))
    };
    eframe::run_native(ID, options, Box::new(create)).map_err(|e| {
        format!(
            "the window cannot be opened: {e}; it needs a display and a driver for Vulkan or OpenGL (on Debian: \
             mesa-vulkan-drivers, libx11-xcb1, libxcursor1, libxi6, libxkbcommon-x11-0); `brillianteer --help` lists \
             what works without"
        )
    })
}

#[cfg(test)]
mod tests;
