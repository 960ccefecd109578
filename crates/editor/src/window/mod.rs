//! Opens the window: a graphics card paints it where there is one, else the processor does.
//!
//! A driver that computes on the processor (Mesa's llvmpipe, Microsoft's Basic Render Driver) counts as no card: it needs
//! many times as long to paint a window as [`Painter`](brillianteer_painter::Painter), on the cores that trace light.
//!
//! The window's place and the editor's state are kept in the same file whoever paints.

mod by_card;
mod by_processor;
mod pacer;
mod storage;
mod surface;

use super::icon::icon;
use super::setup::{PaintedBy, Setup};
use super::state_file::StateFile;
use brillianteer_files::mesh_options::MeshOptions;
use brillianteer_session::urgency;
use egui::ViewportBuilder;
use std::path::PathBuf;

/// The program's name for the window system, and that of its folder of settings.
const ID: &str = "brillianteer";

/// The window's first size and its least size, in points.
const SIZE: [f32; 2] = [1440.0, 900.0];
const LEAST: [f32; 2] = [640.0, 420.0];

/// The environment variable that chooses the painter of the window: `card` or `processor`.
const CHOICE: &str = "BRILLIANTEER_PAINTER";

/// The libraries that a window needs, by the names of their packages in Debian.
const PACKAGES: &str = "libx11-xcb1, libxcursor1, libxi6, libxkbcommon-x11-0";

/// The reason why no window could be opened, or why it closed by itself.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum WindowError {
    /// There is no screen for the window.
    #[error("the window cannot be opened: there is no display ({0})")]
    NoDisplay(String),
    /// There is a screen, but opening a window or painting its first image failed.
    #[error("the window cannot be opened: {0}; on Debian it needs {PACKAGES}")]
    NoWindow(String),
    /// The window was open and has shown an image, and then painting or the window system failed.
    #[error("the window was lost: {0}; start the program again to recover unsaved work")]
    Lost(String),
    /// The environment names a painter that does not exist.
    #[error(
        "{CHOICE}={0} is unknown; set it to `card` or `processor`, or unset it to let the program choose"
    )]
    NoSuchPainter(String),
}

impl WindowError {
    /// The error of a window that ended by a fault: it was lost if it had shown an image, else it was never opened.
    fn of_ended(why: &str, has_shown: bool) -> Self {
        let why = without_place(why);
        if has_shown { Self::Lost(why) } else { Self::NoWindow(why) }
    }
}

/// Removes the place in winit's source code from an error's text, because it is a path of the machine that built the
/// program: `os error at FILE:LINE: TEXT` becomes `TEXT`.
fn without_place(text: &str) -> String {
    let shortened = text.split_once("os error at ").and_then(|(before, rest)| {
        let (_, reason) = rest.split_once(": ")?;
        Some(format!("{before}{reason}"))
    });
    shortened.unwrap_or_else(|| text.to_owned())
}

impl PaintedBy {
    /// Returns the painter of this name. Without a name, it is the card where there is one, else the processor.
    fn chosen(name: Option<&str>, has_card: impl FnOnce() -> bool) -> Result<Self, WindowError> {
        match name {
            None | Some("") => Ok(if has_card() { Self::Card } else { Self::Processor }),
            Some(name) => [Self::Card, Self::Processor]
                .into_iter()
                .find(|by| by.name() == name)
                .ok_or_else(|| WindowError::NoSuchPainter(name.to_owned())),
        }
    }
}

/// Opens the window and waits until it is closed. If `file` is given, the window opens it; a mesh is read with the
/// options `mesh`.
///
/// # Errors
/// Fails where the environment names an unknown painter, where there is no display, where no window can be opened on
/// it, or where the window is lost. Except for a missing display, the text of the error says what to do.
pub fn run(file: Option<PathBuf>, mesh: MeshOptions) -> Result<(), WindowError> {
    check_display()?;
    let name = std::env::var(CHOICE).ok();
    let painted_by = PaintedBy::chosen(name.as_deref(), by_card::is_there)?;
    urgency::lower_the_pool();
    let state_file = StateFile::from_environment();
    let safe = eframe::storage_dir(ID);
    let setup = Setup { file, mesh, safe, painted_by, state_file, ..Setup::default() };
    match painted_by {
        PaintedBy::Card => by_card::run(setup),
        PaintedBy::Processor => by_processor::run(setup),
    }
}

/// Checks that a display is named at all, before any graphics driver is loaded.
fn check_display() -> Result<(), WindowError> {
    let is_named = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let names = ["WAYLAND_DISPLAY", "WAYLAND_SOCKET", "DISPLAY"];
    let is_named_by_variable = cfg!(all(unix, not(target_os = "macos")));
    if is_named_by_variable && !names.iter().any(|name| is_named(name)) {
        return Err(WindowError::NoDisplay("neither WAYLAND_DISPLAY nor DISPLAY is set".to_owned()));
    }
    Ok(())
}

fn viewport() -> ViewportBuilder {
    let viewport = ViewportBuilder::default()
        .with_app_id(ID)
        .with_title("Brillianteer")
        .with_inner_size(SIZE)
        .with_min_inner_size(LEAST);
    match icon() {
        Some(icon) => viewport.with_icon(icon),
        None => viewport,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_that_has_shown_an_image_is_lost_and_not_missing() {
        let error = |has_shown| WindowError::of_ended("the server is gone", has_shown);
        assert_eq!(error(false), WindowError::NoWindow("the server is gone".to_owned()));
        assert_eq!(error(true), WindowError::Lost("the server is gone".to_owned()));
    }

    #[test]
    fn no_path_of_the_building_machine_is_told() {
        let place = "/root/.cargo/registry/src/index/winit-0.30.13/src/platform_impl/linux/mod.rs:788";
        let reason = "Failed to open connection to X server";
        assert_eq!(without_place(&format!("os error at {place}: {reason}")), reason);
        let text = without_place(&format!("winit error: os error at {place}: {reason}: none"));
        assert_eq!(text, format!("winit error: {reason}: none"));
        assert_eq!(without_place("EventLoop can't be recreated"), "EventLoop can't be recreated");
    }

    #[test]
    fn the_processor_paints_where_there_is_no_card_unless_a_painter_is_asked_for() {
        let chosen = |name: Option<&str>, card: bool| PaintedBy::chosen(name, || card);
        assert_eq!(chosen(None, true), Ok(PaintedBy::Card));
        assert_eq!(chosen(None, false), Ok(PaintedBy::Processor));
        assert_eq!(chosen(Some(""), false), Ok(PaintedBy::Processor));
        assert_eq!(chosen(Some("card"), false), Ok(PaintedBy::Card));
        assert_eq!(chosen(Some("processor"), true), Ok(PaintedBy::Processor));
        let wrong = chosen(Some("crayon"), true).unwrap_err().to_string();
        assert!(wrong.contains("BRILLIANTEER_PAINTER=crayon") && wrong.contains("`processor`"), "{wrong}");
    }
}
