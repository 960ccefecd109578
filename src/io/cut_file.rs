//! Cut files: a design as TOML, format 1, read and written through one declaration of its keys (`form`).
//!
//! Written numbers are percent of the girdle diameter and degrees; [`Design`] keeps them as written, so that
//! reading what was written gives the same design to the last bit. Every error names file, line and key, and says
//! what was expected.

use std::path::Path;

use serde::Deserialize;
use toml::de::{DeTable, Deserializer};

use super::fault::Fault;
use super::text::{self, TextError};
use crate::cut::Design;
use form::DesignForm;

mod form;
pub(super) mod material_form;
mod tier_form;
pub(super) mod values;

#[cfg(test)]
mod tests;

/// The format that this program reads and writes.
pub const FORMAT: i64 = 1;

/// The largest file taken, bytes.
pub const MAX_BYTES: u64 = 4 << 20;

/// The largest one that holds a mesh: some millions of triangles.
pub const MAX_MESH_BYTES: u64 = 256 << 20;

/// Why a cut file could not be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{path}{}: {message}", .line.map(|line| format!(":{line}")).unwrap_or_default())]
pub struct CutFileError {
    /// The file, as it was named.
    pub path: String,
    /// The line at fault, from 1; `None` where it is the file as a whole.
    pub line: Option<usize>,
    /// The key at fault and what was expected of it.
    pub message: String,
}

/// Reads a cut file.
///
/// # Errors
/// What keeps it from being a cut file, with path, line and key.
pub fn read(path: impl AsRef<Path>) -> Result<Design, CutFileError> {
    let path = path.as_ref();
    let label = path.display().to_string();
    match text::read(path, MAX_MESH_BYTES) {
        Ok(text) => parse(&text, &label),
        Err(TextError { line, message }) => Err(CutFileError { path: label, line, message }),
    }
}

/// Reads a design from the text of a cut file; `label` stands for its path in errors.
///
/// # Errors
/// What keeps it from being a cut file, with label, line and key.
pub fn parse(text: &str, label: &str) -> Result<Design, CutFileError> {
    design(text).map_err(|fault| CutFileError {
        path: label.to_owned(),
        line: fault.line(text),
        message: fault.message,
    })
}

/// The text of a cut file that reads back as the same design.
///
/// A design that [`Design::check`] refuses is written too, but not read back.
pub fn write(design: &Design) -> String {
    // TOML lacks a form only for maps without text keys and integers beyond 64 bits, and here are neither.
    toml::to_string(&DesignForm::of(design)).expect("a cut file's form is text, numbers, lists and tables")
}

fn design(text: &str) -> Result<Design, Fault> {
    let most = if holds_mesh(text) { MAX_MESH_BYTES } else { MAX_BYTES };
    if text.len() as u64 > most {
        return Err(Fault::whole(text::too_large(most)));
    }
    let table = DeTable::parse(text).map_err(|error| Fault::syntax(text, &error))?;
    check_format(table.get_ref())?;
    DesignForm::deserialize(Deserializer::from(table)).map_err(Fault::form)?.design()
}

/// Whether a mesh stands in it, as far as its beginning tells.
fn holds_mesh(text: &str) -> bool {
    const BEGINNING: usize = 64 << 10;
    text.lines().take_while(|line| line.len() < BEGINNING).take(1000).any(|line| line.trim() == "[mesh]")
}

/// Read before all else, since another format may have other keys.
pub(super) fn check_format(table: &DeTable<'_>) -> Result<(), Fault> {
    let Some(value) = table.get("format") else {
        return Err(Fault::top(format!(
            "format: the key is missing; begin the file with `format = {FORMAT}`"
        )));
    };
    let number = value.get_ref().as_integer().map(|n| i64::from_str_radix(n.as_str(), n.radix()));
    match number {
        Some(Ok(FORMAT)) => Ok(()),
        Some(Ok(other)) => Err(Fault::at(
            "format",
            format!("format: {other} is not known here, only {FORMAT}; update the program"),
        )),
        _ => Err(Fault::at("format", format!("format: a whole number is expected, `format = {FORMAT}`"))),
    }
}
