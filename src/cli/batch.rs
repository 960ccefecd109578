//! Runs a command on several files, one after the other.

use super::console::say;
use super::specimen::stem;
use crate::io::Failure;
use std::path::{Path, PathBuf};

/// Returns an error if two input files would give their outputs the same names.
pub fn distinct(files: &[PathBuf]) -> Result<(), Failure> {
    for (k, file) in files.iter().enumerate() {
        let name = stem(file);
        if let Some(other) = files[..k].iter().find(|other| stem(other) == name) {
            let (a, b) = (other.display(), file.display());
            let message = format!(
                "{a} and {b}: both would be written as '{name}-...'; write to different --out folders"
            );
            return Err(Failure::Usage(message));
        }
    }
    Ok(())
}

/// Calls `work` for each file. Of several files, one with an input error is reported and skipped; the error at the end names
/// all such files. Any other error ends the loop.
pub fn each_file(
    files: &[PathBuf],
    mut work: impl FnMut(&Path) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut failed = Vec::new();
    for file in files {
        match work(file) {
            Err(Failure::Input(message)) if files.len() > 1 => {
                say(&format!("error: {message}"));
                failed.push(file.display().to_string());
            }
            other => other?,
        }
    }
    if failed.is_empty() {
        return Ok(());
    }
    Err(Failure::Input(format!("{} of {} files failed: {}", failed.len(), files.len(), failed.join(", "))))
}
