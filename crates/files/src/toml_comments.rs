//! Finds comments in TOML texts, which the parser drops.

use super::cut_file::MAX_MESH_BYTES;
use super::text;
use std::path::Path;

/// Returns whether a file is a TOML text with a comment. What cannot be read as text, such as a mesh, has none.
pub fn has_comments(path: &Path) -> bool {
    text::read(path, MAX_MESH_BYTES).is_ok_and(|text| is_commented(&text))
}

/// Returns whether a TOML text has a comment: a `#` outside of its strings.
///
/// Source: TOML 1.0.0, *Comment* and *String*.
fn is_commented(text: &str) -> bool {
    let mut rest = text;
    while let Some(at) = rest.find(['#', '"', '\'']) {
        rest = &rest[at..];
        if rest.starts_with('#') {
            return true;
        }
        let quote = &rest[..1];
        let long = quote.repeat(3);
        let is_long = rest.starts_with(&long);
        let quote = if is_long { long.as_str() } else { quote };
        rest = behind(&rest[quote.len()..], quote);
    }
    false
}

/// Returns what follows the end of a string whose content begins here; nothing where it has none. A string of one line ends
/// with its line.
fn behind<'t>(text: &'t str, quote: &str) -> &'t str {
    let has_escapes = quote.starts_with('"');
    let mut at = 0;
    while let Some(letter) = text[at..].chars().next() {
        if text[at..].starts_with(quote) {
            return &text[at + quote.len()..];
        }
        if letter == '\n' && quote.len() == 1 {
            break;
        }
        at += letter.len_utf8();
        if letter == '\\' && has_escapes {
            at += text[at..].chars().next().map_or(0, char::len_utf8);
        }
    }
    &text[at..]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_is_seen_and_a_sign_of_numbers_in_a_string_is_none() {
        for text in
            ["# a", "a = 1 # b", "a = 'b' # c", "a = \"\\\"\" # b", "a = '\\' # b", "a = '''\n''' # b"]
        {
            assert!(is_commented(text), "{text}");
        }
        for text in [
            "",
            "a = '#1'",
            "a = \"#1\"",
            "a = \"\\\"# b\"",
            "a = '''\n# b\n'''",
            "a = \"\"\"\n# \\\" b\"\"\"",
            "a = \"é # ",
        ] {
            assert!(!is_commented(text), "{text}");
        }
    }
}
