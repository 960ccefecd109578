//! Keeps what a file holds beside its design from being lost where a command writes over the file that it reads.

use brillianteer_base::Failure;
use brillianteer_files::design_file::DesignFormat;
use brillianteer_files::has_comments;
use std::path::Path;

/// Refuses to write over a mesh that is read, whose triangles the new file would lack.
///
/// # Errors
/// Fails with [`Failure::Usage`] where triangles would be lost.
pub fn keep_mesh(input: &Path, output: &Path) -> Result<(), Failure> {
    use DesignFormat::{Asc, Gcs, Gem, Toml};
    let is_design = matches!(DesignFormat::of_name(output), Some(Toml | Asc | Gem | Gcs));
    if is_design || !is_same(input, output) {
        return Ok(());
    }
    let path = output.display();
    Err(Failure::Usage(format!(
        "{path}: this is the mesh that is read, and of its triangles only the facets would be left; give another name"
    )))
}

/// Refuses to write over the file that is read where that has comments, which the new file would lack; `remedy` ends the
/// message.
///
/// # Errors
/// Fails with [`Failure::Usage`] where comments would be lost.
pub fn keep(input: &Path, output: &Path, remedy: &str) -> Result<(), Failure> {
    if !is_same(input, output) || !has_comments(input) {
        return Ok(());
    }
    let path = output.display();
    Err(Failure::Usage(format!(
        "{path}: this is the file that is read, and its comments would be lost; {remedy}"
    )))
}

/// Returns whether two paths lead to one file.
fn is_same(a: &Path, b: &Path) -> bool {
    let places = [a, b].map(std::fs::canonicalize);
    matches!(places, [Ok(a), Ok(b)] if a == b || has_same_number(&a, &b))
}

/// Returns whether two paths are names of one file.
#[cfg(unix)]
fn has_same_number(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let [a, b] = [a, b].map(|path| path.metadata().map(|file| (file.dev(), file.ino())).ok());
    a.is_some() && a == b
}

#[cfg(not(unix))]
fn has_same_number(_: &Path, _: &Path) -> bool {
    false
}
