//! Reads and writes scope files: TOML with a name, and bands of colour with the elevation at which each begins.

use super::fault::Fault;
use super::text::{self, TextError};
use crate::scene::Scope;
use serde::Deserialize;
use std::path::Path;
use toml::de::{DeTable, Deserializer};

/// The size of the largest file that is read, in bytes.
const MAX_BYTES: u64 = 1 << 20;

/// The longest name of a scope or band, in bytes: names are parts of files' names.
const LONGEST_NAME: usize = 60;

/// The names of what pictures and figures hold besides the bands, which no band may have.
const RESERVED: [&str; 5] = ["absorbed", "cover", "head", "undecided", "unresolved"];

/// Reads a scope file.
///
/// # Errors
/// A message that names the file and, where it is known, the line, and says what was expected.
pub fn read(path: &Path) -> Result<Scope, String> {
    let label = path.display();
    let at = |line: Option<usize>| line.map_or(String::new(), |line| format!(":{line}"));
    let text = text::read(path, MAX_BYTES)
        .map_err(|TextError { line, message }| format!("{label}{}: {message}", at(line)))?;
    scope(&text).map_err(|fault| format!("{label}{}: {}", at(fault.line(&text)), fault.message))
}

fn scope(text: &str) -> Result<Scope, Fault> {
    let table = DeTable::parse(text).map_err(|e| Fault::syntax(text, &e))?;
    let scope = Scope::deserialize(Deserializer::from(table)).map_err(Fault::form)?;
    scope.validate().map_err(|e| Fault::whole(e.to_string()))?;
    check_names(&scope).map_err(Fault::whole)?;
    Ok(scope)
}

/// Returns the text of a scope file that [`read`] reads as the same scope.
///
/// # Errors
/// Never for a scope that is valid.
pub fn text(scope: &Scope) -> Result<String, toml::ser::Error> {
    toml::to_string(scope)
}

/// Checks names, which become parts of file names, keys of JSON and channels of EXR.
fn check_names(scope: &Scope) -> Result<(), String> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    for name in scope.bands.iter().map(|b| &b.name).chain([&scope.name]) {
        if !(1..=LONGEST_NAME).contains(&name.len()) || !name.chars().all(plain) {
            let start: String = name.chars().take(LONGEST_NAME).collect();
            return Err(format!("name '{start}': give 1 to {LONGEST_NAME} letters, digits, - or _"));
        }
    }
    if scope.name.ends_with("-strongest") {
        return Err("names ending in -strongest are kept for maps of strongest exits".into());
    }
    match scope.bands.iter().find(|b| RESERVED.contains(&b.name.as_str())) {
        Some(band) => Err(format!("band '{}': that name is kept for a picture's other channels", band.name)),
        None => Ok(()),
    }
}
