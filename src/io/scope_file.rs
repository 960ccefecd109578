//! Scopes as TOML: a name, and bands of colour with the elevation at which each begins.

use crate::scene::Scope;
use std::path::Path;

/// The longest name of a scope or band, in bytes: part of a file's name.
const LONGEST_NAME: usize = 60;

/// What pictures and figures hold beside the bands.
const RESERVED: [&str; 4] = ["absorbed", "cover", "undecided", "unresolved"];

/// Reads a scope.
///
/// # Errors
/// Text that names the file and, where it is known, the line, and says what was expected.
pub fn read(path: &Path) -> Result<Scope, String> {
    let text = std::fs::read_to_string(path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
    let scope: Scope = toml::from_str(&text).map_err(|e| {
        let line =
            e.span().map_or(String::new(), |s| format!(":{}", 1 + text[..s.start].matches('\n').count()));
        format!("{}{line}: {}", path.display(), e.message())
    })?;
    scope.validate().map_err(|e| format!("{}: {e}", path.display()))?;
    check_names(&scope).map_err(|e| format!("{}: {e}", path.display()))?;
    Ok(scope)
}

/// Writes a scope in the form that [`read`] takes.
///
/// # Errors
/// Never for a scope that is valid.
pub fn text(scope: &Scope) -> Result<String, toml::ser::Error> {
    toml::to_string(scope)
}

/// Names become parts of file names, keys of JSON and channels of EXR.
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
