//! Scopes as TOML: a name, and bands of colour with the elevation at which each begins.

use crate::scene::Scope;
use std::path::Path;

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
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if scope.name.ends_with("-strongest") {
        return Err(format!(
            "{}: names ending in -strongest are kept for maps of strongest exits",
            path.display()
        ));
    }
    if scope.name.is_empty() || !scope.name.chars().all(plain) {
        let name = &scope.name;
        return Err(format!(
            "{}: name '{name}' becomes a file's name: use letters, digits, - and _",
            path.display()
        ));
    }
    Ok(scope)
}

/// Writes a scope in the form that [`read`] takes.
///
/// # Errors
/// Never for a scope that is valid.
pub fn text(scope: &Scope) -> Result<String, toml::ser::Error> {
    toml::to_string(scope)
}
