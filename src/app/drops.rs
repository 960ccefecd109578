//! Files dropped on the window, and what each kind of file is used for.

use crate::app::dialogs::Then;
use crate::app::editor::Editor;
use crate::app::tasks::files::Purpose;
use crate::io::light_file;
use egui::{Align2, Color32, Context, FontId, Id, LayerId, Order};
use std::path::{Path, PathBuf};

/// Returns what a dropped file is for, by its name and, for TOML, by its content.
fn purpose(path: &Path) -> Purpose {
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    match ending.as_str() {
        "hdr" | "exr" => Purpose::Light,
        "png" | "jpg" | "jpeg" => Purpose::Behind,
        "toml" | "light" if light_file::read(path).is_ok() => Purpose::Light,
        _ => Purpose::Open,
    }
}

impl Editor {
    /// Takes dropped files: designs, meshes and scenes are opened, panoramas and light files become the light, pictures
    /// become the backplate.
    pub(super) fn dropped(&mut self, files: &[PathBuf]) {
        let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // TOML is read to find what it is for: once for each file.
        let files: Vec<(&PathBuf, Purpose)> = files.iter().map(|path| (path, purpose(path))).collect();
        let mut to_open = files.iter().filter(|(_, purpose)| *purpose == Purpose::Open);
        if let Some(&(path, _)) = to_open.next() {
            self.ask_before(Then::open(path.clone()));
            let more = to_open.count();
            if more > 0 {
                let files = if more == 1 { "file was" } else { "files were" };
                self.notes.say(&format!(
                    "{} is opened; one design is open at a time, so {more} more {files} left out.",
                    name(path)
                ));
            }
        }
        for (path, purpose) in files {
            let own = self.begun;
            match purpose {
                Purpose::Light => {
                    self.chosen(Purpose::Light, own, path.clone());
                    self.notes.say(&format!("{} lights the stone.", name(path)));
                }
                Purpose::Behind => {
                    self.chosen(Purpose::Behind, own, path.clone());
                    self.notes.say(&format!(
                        "{} hangs behind the stone; as a light it is chosen under Light.",
                        name(path)
                    ));
                }
                _ => {}
            }
        }
    }
}

/// Says what dropping does, while files are held over the window.
pub fn invite(ctx: &Context) {
    if ctx.input(|i| i.raw.hovered_files.is_empty()) {
        return;
    }
    let painter = ctx.layer_painter(LayerId::new(Order::Foreground, Id::unique("drop")));
    let whole = ctx.content_rect();
    painter.rect_filled(whole, 0.0, Color32::from_black_alpha(170));
    let text = "Drop a cut, a mesh or a scene to open it,\na panorama or a light file to light the stone,\na picture to hang it behind.";
    painter.text(whole.center(), Align2::CENTER_CENTER, text, FontId::proportional(20.0), Color32::WHITE);
}
