//! Writes the main pictures and figures of a stone to files where the editor cannot be opened.

use super::console::say;
use brillianteer_base::Failure;
use brillianteer_files::built_design::is_scene;
use brillianteer_files::library::FIRST_CUT;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The folder to which `export` and `render` write by default.
const FOLDER: &str = "out";

/// The command that writes the pictures that the editor shows first and those that the trade expects, with the
/// figures.
const EXPORT: [&str; 5] =
    ["export", "--views", "aset,ideal-scope,hearts,arrows,profile,diagram", "--format", "png,json"];

/// Writes the main pictures and figures of a file, or of [`FIRST_CUT`] where none is given. Prints the reason `why`, the
/// commands that write the same files, and the folder. `run` runs a command line as if the user had typed it.
pub fn write(
    file: Option<PathBuf>,
    why: &str,
    run: fn(Vec<OsString>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let file = file.unwrap_or_else(|| FIRST_CUT.into());
    // Scenes have no pictures in scopes.
    let exports = (!is_scene(&file)).then_some(EXPORT.as_slice());
    let commands: Vec<&[&str]> = exports.into_iter().chain([["render"].as_slice()]).collect();
    say(&format!("note: {why}"));
    say(&format!(
        "note: pictures and figures are written to the folder '{FOLDER}' instead, as these commands do:"
    ));
    for command in &commands {
        say(&format!("note:   brillianteer {} {}", command.join(" "), file.display()));
    }
    commands.into_iter().try_for_each(|command| run(line(command, &file)))?;
    let folder = std::path::absolute(FOLDER).unwrap_or_else(|_| FOLDER.into());
    say(&format!("note: all files are written; they are in {}", folder.display()));
    Ok(())
}

/// Returns the command line of a command on a file.
fn line(command: &[&str], file: &Path) -> Vec<OsString> {
    let words = ["brillianteer"].iter().chain(command).map(OsString::from);
    // After `--`, a name that begins with a dash is not read as an option.
    words.chain(["--".into(), file.into()]).collect()
}
