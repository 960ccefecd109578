//! Asks for files without keeping the window waiting, and notices files that others change.

use crate::app::model::document::Stamp;
use crate::io::design_file::DesignFormat;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// What a file is chosen for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// A design to open.
    Open,
    /// A file to save to.
    SaveAs,
    /// A design to compare with.
    Compare,
    /// A light or a panorama.
    Light,
    /// A picture for the backplate.
    Behind,
    /// A folder to export to.
    Folder,
}

/// A question for a file.
#[derive(Debug, Clone)]
pub struct Question {
    /// What the file is for.
    pub purpose: Purpose,
    /// The name that is proposed for a new file.
    pub name: String,
}

/// The answer to a question.
#[derive(Debug, Clone, PartialEq)]
pub enum Choice {
    /// The file that was chosen.
    File(PathBuf),
    /// The user chose no file.
    GivenUp,
    /// The user was not asked: the system has no dialog.
    NoDialog,
}

/// A function that asks the user for a file and waits for the answer.
pub type Chooser = Arc<dyn Fn(&Question) -> Choice + Send + Sync>;

/// A dialog that ends sooner than this has failed: no person answers so quickly.
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

/// Whether the system may have dialogs: other desktops than those of Windows and macOS have them by a bus or by a program.
fn may_have_dialogs() -> bool {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let bus = std::env::var_os("XDG_RUNTIME_DIR").map(|folder| Path::new(&folder).join("bus"));
    cfg!(any(windows, target_os = "macos"))
        || std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some()
        || bus.is_some_and(|bus| bus.exists())
        || std::env::split_paths(&folders).any(|folder| folder.join("zenity").is_file())
}

fn dialog(question: &Question) -> Option<PathBuf> {
    let dialog = rfd::FileDialog::new();
    let cuts =
        |d: rfd::FileDialog| d.add_filter("Designs and meshes", &endings()).add_filter("All files", &["*"]);
    let pictures = ["toml", "hdr", "exr", "png", "jpg", "jpeg"];
    match question.purpose {
        Purpose::Open => cuts(dialog.set_title("Open a cut")).pick_file(),
        Purpose::Compare => cuts(dialog.set_title("Compare with a cut")).pick_file(),
        Purpose::SaveAs => {
            cuts(dialog.set_title("Save the cut as")).set_file_name(&question.name).save_file()
        }
        Purpose::Light => {
            dialog.set_title("A light or a panorama").add_filter("Lights", &pictures).pick_file()
        }
        Purpose::Behind => {
            dialog.set_title("A picture behind the stone").add_filter("Pictures", &pictures[1..]).pick_file()
        }
        Purpose::Folder => dialog.set_title("A folder for the pictures").pick_folder(),
    }
}

/// A question that waits for its answer.
pub struct Choosing {
    /// What the file is for.
    pub purpose: Purpose,
    /// The number of the document that the file is for.
    pub document: u64,
    answer: Receiver<Choice>,
}

impl Choosing {
    /// Asks, on a thread of its own; `wake` is called when there is an answer.
    pub fn ask(
        question: Question,
        document: u64,
        chooser: &Chooser,
        wake: impl FnOnce() + Send + 'static,
    ) -> Self {
        let (sender, answer) = channel();
        let (chooser, purpose) = (Arc::clone(chooser), question.purpose);
        std::thread::spawn(move || {
            // Nobody waits for the answer any more where the window is closed.
            let _ = sender.send(chooser(&question));
            wake();
        });
        Self { purpose, document, answer }
    }

    /// Returns the answer, once there is one.
    pub fn answer(&self) -> Option<Choice> {
        match self.answer.try_recv() {
            Ok(answer) => Some(answer),
            Err(std::sync::mpsc::TryRecvError::Empty) => None,
            Err(std::sync::mpsc::TryRecvError::Disconnected) => Some(Choice::NoDialog),
        }
    }
}

/// Watches a file for changes by others, on a thread of its own.
pub struct Watching(Arc<Watched>);

#[derive(Default)]
struct Watched {
    file: Mutex<Option<(PathBuf, Stamp)>>,
    has_changed: AtomicBool,
}

/// The time from one look at the file to the next.
const PAUSE: Duration = Duration::from_millis(500);

impl Watching {
    /// Begins to watch; `wake` is called when the file has changed.
    pub fn begin(wake: impl Fn() + Send + 'static) -> Self {
        let watched: Arc<Watched> = Arc::default();
        let weak = Arc::downgrade(&watched);
        std::thread::spawn(move || {
            while let Some(watched) = weak.upgrade() {
                if watched.look() {
                    wake();
                }
                drop(watched);
                std::thread::sleep(PAUSE);
            }
        });
        Self(watched)
    }

    /// Watches this file from now on; `None` watches no file.
    pub fn watch(&self, path: Option<&Path>) {
        let mut file = self.0.file.lock().unwrap_or_else(PoisonError::into_inner);
        if file.as_ref().map(|(p, _)| p.as_path()) != path {
            *file = path.map(|p| (p.to_owned(), Stamp::of(p)));
        }
    }

    /// Whether the file has changed since this was last asked.
    pub fn has_changed(&self) -> bool {
        self.0.has_changed.swap(false, Ordering::Relaxed)
    }
}

impl Watched {
    /// Looks at the file; returns whether it has changed since the last look.
    ///
    /// The lock is free meanwhile, since the file system may take its time.
    fn look(&self) -> bool {
        let lock = || self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let Some((path, stamp)) = lock().clone() else { return false };
        let now = Stamp::of(&path);
        if let Some((_, known)) = lock().as_mut().filter(|(other, _)| *other == path) {
            *known = now;
        }
        let is_another = now != stamp;
        if is_another {
            self.has_changed.store(true, Ordering::Relaxed);
        }
        is_another
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

    #[test]
    fn a_file_changed_by_others_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        std::fs::write(&path, "1").unwrap();
        let (sender, told) = channel();
        let watching = Watching::begin(move || {
            // The test may be over.
            let _ = sender.send(());
        });
        watching.watch(Some(&path));
        std::fs::write(&path, "22").unwrap();
        assert!(told.recv_timeout(Duration::from_secs(600)).is_ok());
    }
}
