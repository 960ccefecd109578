//! Cut files: a design as TOML, format 1, read and written through one declaration of its keys (`form`), and the keys
//! of families of cuts by their tables of proportions (`family_form`).
//!
//! Numbers in a file are percent of the girdle diameter and degrees; [`Design`] keeps them unchanged, so that a
//! design that is written and read again is the same to the last bit. Every error names file, line and key, and says
//! what was expected.

use std::path::Path;

use super::text;
use super::toml_format::check_format;
use super::toml_text::{KeyLines, TomlText};
use brillianteer_base::{Fault, FileError};
use brillianteer_cut::{Cut, Design, FAMILIES};
use family_form::FamilyForm;
use form::DesignForm;

pub use super::toml_format::FORMAT;

mod family_form;
mod form;
pub(super) mod material_form;
mod meet_form;
mod tier_form;
pub(super) mod values;

#[cfg(test)]
mod tests;

/// The size of the largest file without a mesh that is read, in bytes.
pub const MAX_BYTES: u64 = 4 << 20;

/// The size of the largest file with a mesh that is read, in bytes: some millions of triangles.
pub const MAX_MESH_BYTES: u64 = 256 << 20;

/// Reads a cut file, without its warnings; `design_file::read` reads it with them.
///
/// # Errors
/// Fails where the file cannot be read or is no cut file; the error names path, line and key.
pub fn read(path: impl AsRef<Path>) -> Result<Design, FileError> {
    let path = path.as_ref();
    let read = text::read(path, MAX_MESH_BYTES).and_then(|text| design(&text));
    read.map(|(design, _)| design).map_err(|fault| fault.in_file(path.display()))
}

/// Reads a design from the text of a cut file; `label` stands for its path in errors.
///
/// # Errors
/// Fails where the text is no cut file; the error names label, line and key.
pub fn parse(text: &str, label: &str) -> Result<Design, FileError> {
    design(text).map(|(design, _)| design).map_err(|fault| fault.in_file(label))
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

/// Reads a design, and warnings about it with their lines, from the text of a cut file that is not named yet.
pub(super) fn design(text: &str) -> Result<(Design, Vec<String>), Fault> {
    let most = if holds_mesh(text) { MAX_MESH_BYTES } else { MAX_BYTES };
    text::check_size(text.len(), most)?;
    let toml = TomlText::parse(text)?;
    check_format(&toml)?;
    let families = FAMILIES.map(|family| ("", family.key));
    let (design, lines) =
        toml.read_beside(&families, FamilyForm::take_all, |form: DesignForm, families| {
            form.design(&families)
        })?;
    let warnings = odd_indices(&design, &lines);
    Ok((design, warnings))
}

/// Returns a warning for each tier with indices that its gear does not have.
fn odd_indices(design: &Design, lines: &KeyLines<'_>) -> Vec<String> {
    let Cut::Tiers(tiers) = &design.cut else { return vec![] };
    let place = |tier: usize| match lines.of(&format!("tier/{}/indices", tier - 1)) {
        Some(line) => format!("line {line}: "),
        None => String::new(),
    };
    tiers.beyond_gear().map(|beyond| place(beyond.tier) + &beyond.to_string()).collect()
}

/// Returns whether the text seems to have a table `[mesh]`, from the beginnings of its lines.
fn holds_mesh(text: &str) -> bool {
    const BEGINNING: usize = 64 << 10;
    text.lines().take_while(|line| line.len() < BEGINNING).take(1000).any(|line| line.trim() == "[mesh]")
}
