//! Reads and writes scope files: TOML with a name, and bands of colour with the elevation at which each begins.

use super::text;
use super::toml_text::TomlText;
use brillianteer_base::{Fault, FileError};
use brillianteer_scene::{Scope, ScopeError};
use std::path::Path;

/// The size of the largest file that is read, in bytes.
const MAX_BYTES: u64 = 1 << 20;

/// The longest name of a scope or band, in bytes: names are parts of files' names.
const LONGEST_NAME: usize = 60;

/// The names of values in pictures and figures besides the bands, which no band may have.
const RESERVED: [&str; 5] = ["absorbed", "cover", "head", "undecided", "unresolved"];

/// Reads a scope file.
///
/// # Errors
/// Fails where the file cannot be read or is no scope; the error names path and, where possible, the line.
pub fn read(path: &Path) -> Result<Scope, FileError> {
    let scope = text::read(path, MAX_BYTES).and_then(|text| scope(&text));
    scope.map_err(|fault| fault.in_file(path.display()))
}

fn scope(text: &str) -> Result<Scope, Fault> {
    TomlText::parse(text)?.read(|scope: Scope| {
        scope.validate().map_err(|error| Fault::key(path_of(&error, &scope), error))?;
        check_names(&scope)?;
        Ok(scope)
    })
}

/// Returns the text of a scope file that [`read`] reads as the same scope.
///
/// # Errors
/// Never fails for a valid scope.
pub fn text(scope: &Scope) -> Result<String, toml::ser::Error> {
    toml::to_string(scope)
}

/// Returns the path of the key at fault in the file.
fn path_of(error: &ScopeError, scope: &Scope) -> String {
    let place = |name: &str| scope.bands.iter().rposition(|band| band.name == name).unwrap_or_default();
    match error {
        ScopeError::NotFromNadir { .. } => "band/0/from".to_owned(),
        ScopeError::Twice { band, .. } => format!("band/{}/name", place(band)),
        ScopeError::TooMany { .. } => "band".to_owned(),
        ScopeError::OutOfOrder { band, .. } => format!("band/{}/from", place(band)),
    }
}

/// Checks names, which become parts of file names, keys of JSON and channels of EXR.
fn check_names(scope: &Scope) -> Result<(), Fault> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    let own = ("name".to_owned(), &scope.name);
    let bands =
        scope.bands.iter().enumerate().map(|(place, band)| (format!("band/{place}/name"), &band.name));
    for (key, name) in bands.chain([own]) {
        let problem = if !(1..=LONGEST_NAME).contains(&name.len()) || !name.chars().all(plain) {
            let start: String = name.chars().take(LONGEST_NAME).collect();
            format!("name '{start}': give 1 to {LONGEST_NAME} letters, digits, - or _")
        } else if key == "name" && name.ends_with("-strongest") {
            "names ending in -strongest are kept for maps of strongest exits".to_owned()
        } else if key != "name" && RESERVED.contains(&name.as_str()) {
            format!("band '{name}': that name is kept for a picture's other channels")
        } else {
            continue;
        };
        return Err(Fault::key(key, problem));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wrong_in_a_scope_is_told_with_its_line() {
        let bands = "[[band]]\nname = \"a\"\nfrom = -90\ncolour = [0, 0, 0]\n\
            [[band]]\nname = \"b\"\nfrom = 10\ncolour = [9, 9, 9]\n";
        let text = format!("name = \"x\"\n{bands}");
        assert!(scope(&text).is_ok());
        for (from, to, line, words) in [
            ("\"x\"", "\"x y\"", 1, "name 'x y': give 1 to 60 letters"),
            ("\"x\"", "\"x-strongest\"", 1, "names ending in -strongest"),
            ("from = -90", "from = -80", 4, "the first band must begin at -90"),
            ("\"b\"", "\"absorbed\"", 7, "band 'absorbed': that name is kept"),
            ("\"b\"", "\"a\"", 7, "two bands are called 'a'"),
            ("from = 10", "from = 90", 8, "band 'b' begins at 90"),
        ] {
            let fault = scope(&text.replace(from, to)).unwrap_err();
            assert!(fault.line == Some(line) && fault.problem.contains(words), "{to}: {fault:?}");
        }
    }
}
