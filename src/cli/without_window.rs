//! What the program does where its editor cannot be opened: the main pictures and figures of a stone, as files.

use super::{Arguments, Failure, assembly, say};
use crate::io::library::FIRST_CUT;
use clap::Parser;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The folder that both commands write to.
const FOLDER: &str = "out";

/// The pictures that the editor shows first and those that the trade asks for, with the figures.
const EXPORT: [&str; 5] =
    ["export", "--views", "aset,ideal-scope,hearts,arrows,profile,diagram", "--format", "png,json"];

/// Writes the main pictures and figures of a file, or of the first cut, and says why, by which commands and where.
pub fn write(file: Option<PathBuf>, why: &str) -> Result<(), Failure> {
    let file = file.unwrap_or_else(|| FIRST_CUT.into());
    // Scenes have no pictures in scopes.
    let exports = (!assembly::is_scene(&file)).then_some(EXPORT.as_slice());
    let commands: Vec<&[&str]> = exports.into_iter().chain([["render"].as_slice()]).collect();
    say(&format!("note: {why}"));
    say(&format!(
        "note: pictures and figures are written to the folder '{FOLDER}' instead, as these commands do:"
    ));
    for command in &commands {
        say(&format!("note:   brillianteer {} {}", command.join(" "), file.display()));
    }
    commands.into_iter().try_for_each(|command| run(command, &file))?;
    let folder = std::path::absolute(FOLDER).unwrap_or_else(|_| FOLDER.into());
    say(&format!("note: all files are written; they are in {}", folder.display()));
    Ok(())
}

/// Runs a command on a file as if it had been typed.
fn run(command: &[&str], file: &Path) -> Result<(), Failure> {
    let words = ["brillianteer"].iter().chain(command).map(OsString::from);
    // A name that begins with a dash is no option.
    let line = words.chain(["--".into(), file.into()]);
    let parsed = Arguments::try_parse_from(line).map_err(|e| Failure::Usage(e.to_string()))?;
    parsed.command.map_or(Ok(()), |command| command.run())
}
