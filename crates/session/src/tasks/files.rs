//! Asks for files by the system's file dialogs.

use crate::model::choosing::{Choice, Purpose, Question};
use brillianteer_files::design_file::DesignFormat;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A function that asks the user for a file and waits for the answer.
pub type Chooser = Arc<dyn Fn(&Question) -> Choice + Send + Sync>;

/// A dialog that ends sooner than this has failed: no user answers so quickly.
const AT_ONCE: Duration = Duration::from_millis(350);

/// Asks by the system's own file dialogs.
pub fn by_dialog(question: &Question) -> Choice {
    let since = Instant::now();
    match dialog(question) {
        Some(path) => Choice::File(path),
        // The dialogs report a failure and a cancelled choice alike.
        None if since.elapsed() < AT_ONCE || !may_have_dialogs() => Choice::NoDialog,
        None => Choice::GivenUp,
    }
}

/// Returns whether the system may have dialogs: desktops other than those of Windows and macOS provide them over
/// D-Bus or by the program zenity.
fn may_have_dialogs() -> bool {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let bus = std::env::var_os("XDG_RUNTIME_DIR").map(|folder| Path::new(&folder).join("bus"));
    cfg!(any(windows, target_os = "macos"))
        || std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some()
        || bus.is_some_and(|bus| bus.exists())
        || std::env::split_paths(&folders).any(|folder| folder.join("zenity").is_file())
}

fn dialog(question: &Question) -> Option<PathBuf> {
    let dialog = rfd::FileDialog::new().set_title(question.purpose.heading());
    let cuts =
        |d: rfd::FileDialog| d.add_filter("Designs and meshes", &endings()).add_filter("All files", &["*"]);
    let pictures = ["toml", "hdr", "exr", "png", "jpg", "jpeg"];
    match question.purpose {
        Purpose::Open | Purpose::Compare => cuts(dialog).pick_file(),
        Purpose::SaveAs => cuts(dialog).set_file_name(&question.name).save_file(),
        Purpose::Light => dialog.add_filter("Lights", &pictures).pick_file(),
        Purpose::Behind => dialog.add_filter("Pictures", &pictures[1..]).pick_file(),
        Purpose::Folder => dialog.pick_folder(),
        Purpose::Goal => dialog.add_filter("Goals", &["toml"]).pick_file(),
        Purpose::SaveGoal => dialog.set_file_name(&question.name).save_file(),
    }
}

/// Returns the endings of the files that can be opened.
fn endings() -> Vec<&'static str> {
    DesignFormat::ALL.into_iter().map(DesignFormat::ending).chain(["gltf"]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ending_is_offered_once() {
        let mut endings = endings();
        let count = endings.len();
        endings.sort_unstable();
        endings.dedup();
        assert_eq!(endings.len(), count);
        assert!(endings.contains(&"ply") && endings.contains(&"gltf"));
    }
}
