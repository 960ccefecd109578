//! Refuses XML that its parser would accept and not finish, before it is parsed, and restores texts as they stand in a file.

use super::MAX_BYTES;
use crate::io::file_error::Fault;
use crate::io::text::{check_size, line_after};
use std::borrow::Cow;

/// The most attributes of one element; the XML parser compares each with each.
const MOST_ATTRIBUTES: usize = 256;

/// The most declarations of namespaces; the XML parser copies them down the tree.
const MOST_NAMESPACES: usize = 16;

/// Returns the text of a file of a sane size and structure, UTF-8 or UTF-16 behind its mark, and whether some of its
/// characters are damaged.
pub(super) fn text(bytes: &[u8]) -> Result<(Cow<'_, str>, bool), Fault> {
    check_size(bytes.len(), MAX_BYTES as u64)?;
    let (text, _, spoilt) = encoding_rs::UTF_8.decode(bytes);
    if text.matches("xmlns").count() > MOST_NAMESPACES {
        return Err(format!("xmlns: more than {MOST_NAMESPACES} namespaces are declared").into());
    }
    // Values cannot hold a '<', so that no element is longer than from one '<' to the next.
    let mut begin = 0;
    for piece in text.split_inclusive('<') {
        if values(piece) > MOST_ATTRIBUTES {
            let line = line_after(&text.as_bytes()[..begin]);
            let problem = format!("an element has more than {MOST_ATTRIBUTES} attributes");
            return Err(Fault::line(line, problem));
        }
        begin += piece.len();
    }
    Ok((text, spoilt))
}

fn values(element: &str) -> usize {
    let behind = element.split('=').skip(1);
    behind.filter(|text| text.trim_start().starts_with(['"', '\''])).count()
}

/// Returns a value with its line breaks and tabs, which XML turns into blanks; `raw` is the value as it stands in the
/// file.
pub(super) fn unfolded(raw: &str, value: &str) -> String {
    if !raw.contains(['\n', '\r', '\t']) {
        return value.to_owned();
    }
    let raw = raw.replace("\r\n", "\n");
    let mut raw = raw.chars();
    // Both texts agree character by character, except that an entity stands for one character.
    let unfold = |character| match raw.next() {
        Some('&') => {
            raw.by_ref().find(|c| *c == ';');
            character
        }
        Some('\n' | '\r') => '\n',
        Some('\t') => '\t',
        _ => character,
    };
    value.chars().map(unfold).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_breaks_come_back_and_entities_stay() {
        assert_eq!(unfolded("a&#10;b\nc &amp;\r\nd\t", "a\nb c & d "), "a\nb\nc &\nd\t");
        assert_eq!(unfolded("plain", "plain"), "plain");
    }

    #[test]
    fn elements_without_end_are_refused() {
        let many: String = (0..300).map(|k| format!(" a{k} = '1'")).collect();
        let error = text(format!("\n<x{many}/>").as_bytes()).map(drop).unwrap_err();
        assert_eq!((error.line, error.problem.contains("256 attributes")), (Some(2), true));
        let lines = format!("<x a='{}'/>", "=".repeat(1000));
        assert!(text(lines.as_bytes()).is_ok());
        assert!(text("xmlns ".repeat(20).as_bytes()).is_err());
    }
}
