//! Cut files: a design as TOML, format 1, read and written through one declaration of its keys (`form`).
//!
//! Written numbers are percent of the girdle diameter and degrees; [`Design`] keeps them as written, so that
//! reading what was written gives the same design to the last bit. Every error names file, line and key, and says
//! what was expected.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

use serde::Deserialize;
use toml::de::{DeTable, Deserializer};

use crate::cut::Design;
use fault::Fault;
use form::DesignForm;

mod fault;
mod form;
mod material_form;
mod values;

#[cfg(test)]
mod tests;

/// The format that this program reads and writes.
pub const FORMAT: i64 = 1;

/// The largest file taken, bytes.
pub const MAX_BYTES: u64 = 4 << 20;

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
pub fn read(path: impl AsRef<Path>) -> Result<Design, CutFileError> {
    let path = path.as_ref();
    let label = path.display().to_string();
    let bytes = bytes(path).map_err(|message| CutFileError { path: label.clone(), line: None, message })?;
    match String::from_utf8(bytes) {
        Ok(text) => parse(&text, &label),
        Err(error) => {
            let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let message = "this is not UTF-8 text; save the file as UTF-8".to_owned();
            Err(CutFileError { path: label, line: Some(fault::line_after(valid)), message })
        }
    }
}

/// Reads a design from the text of a cut file; `label` stands for its path in errors.
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
    if text.len() as u64 > MAX_BYTES {
        return Err(Fault::whole(too_large()));
    }
    let table = DeTable::parse(text).map_err(|error| Fault::syntax(text, &error))?;
    check_format(table.get_ref())?;
    DesignForm::deserialize(Deserializer::from(table)).map_err(Fault::form)?.design()
}

/// Read before all else, since another format may have other keys.
fn check_format(table: &DeTable<'_>) -> Result<(), Fault> {
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

/// What a path holds, up to the limit, which also binds what grows or has no size of its own.
fn bytes(path: &Path) -> Result<Vec<u8>, String> {
    let unreadable = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => "there is no such file".to_owned(),
        _ => format!("cannot be read: {error}"),
    };
    if path.metadata().map_err(unreadable)?.is_dir() {
        return Err("this is a directory; a cut file is expected".to_owned());
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(MAX_BYTES + 1).read_to_end(&mut bytes)).map_err(unreadable)?;
    if bytes.len() as u64 > MAX_BYTES { Err(too_large()) } else { Ok(bytes) }
}

fn too_large() -> String {
    format!("this is larger than {} MiB, so hardly a cut file", MAX_BYTES >> 20)
}
