//! Cut files: a design as TOML, format 1, read and written through one declaration of its keys (`form`), and those of
//! families of cuts by their tables of proportions (`family_form`).
//!
//! Numbers in a file are percent of the girdle diameter and degrees; [`Design`] keeps them as they stand, so that
//! reading back what was written gives the same design to the last bit. Every error names file, line and key, and says
//! what was expected.

use std::path::Path;

use serde::Deserialize;
use toml::de::{DeTable, Deserializer};

use super::fault::Fault;
use super::text::{self, TextError};
use crate::cut::{Design, FAMILIES};
use family_form::FamilyForm;
use form::DesignForm;

mod family_form;
mod form;
pub(super) mod material_form;
mod tier_form;
pub(super) mod values;

#[cfg(test)]
mod tests;

/// The number of the format that this program reads and writes.
pub const FORMAT: i64 = 1;

/// The size of the largest file without a mesh that is read, in bytes.
pub const MAX_BYTES: u64 = 4 << 20;

/// The size of the largest file with a mesh that is read, in bytes: some millions of triangles.
pub const MAX_MESH_BYTES: u64 = 256 << 20;

/// Why a cut file could not be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{path}{}: {message}", .line.map(|line| format!(":{line}")).unwrap_or_default())]
pub struct CutFileError {
    /// The path of the file, as the caller gave it.
    pub path: String,
    /// The line at fault, from 1; `None` where the file as a whole is at fault.
    pub line: Option<usize>,
    /// The key at fault and what was expected of it.
    pub message: String,
}

/// Reads a cut file.
///
/// # Errors
/// When the file cannot be read or is no cut file; the error names path, line and key.
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
/// When the text is no cut file; the error names label, line and key.
pub fn parse(text: &str, label: &str) -> Result<Design, CutFileError> {
    design(text).map_err(|fault| CutFileError {
        path: label.to_owned(),
        line: fault.line(text),
        message: fault.message,
    })
}

/// Returns the text of a cut file that reads back as the same design.
///
/// A design that [`Design::check`] refuses is written too, but does not read back.
pub fn write(design: &Design) -> String {
    // TOML has no form for maps without text keys and for integers beyond 64 bits; a cut file has neither.
    let mut text = toml::to_string(&DesignForm::of(design))
        .expect("a cut file's form is text, numbers, lists and tables");
    text.extend(design.cut.family().map(|family| family_form::written(family, &design.cut)));
    text
}

fn design(text: &str) -> Result<Design, Fault> {
    let most = if holds_mesh(text) { MAX_MESH_BYTES } else { MAX_BYTES };
    if text.len() as u64 > most {
        return Err(Fault::whole(text::too_large(most)));
    }
    let mut table = DeTable::parse(text).map_err(|error| Fault::syntax(text, &error))?;
    check_format(table.get_ref())?;
    let families = FamilyForm::take_all(table.get_mut())?;
    let form = DesignForm::deserialize(Deserializer::from(table));
    form.map_err(|error| Fault::form_beside(error, &FAMILIES.map(|family| family.key)))?.design(&families)
}

/// Returns whether the text has a table `[mesh]`, as far as its beginning shows.
fn holds_mesh(text: &str) -> bool {
    const BEGINNING: usize = 64 << 10;
    text.lines().take_while(|line| line.len() < BEGINNING).take(1000).any(|line| line.trim() == "[mesh]")
}

/// Checks the key `format`. It is read before all else, since another format may have other keys.
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
