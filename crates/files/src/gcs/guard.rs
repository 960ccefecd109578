//! Refuses XML that its parser would accept and not finish, before it is parsed, and restores texts as they stand in a file.

use super::MAX_BYTES;
use crate::encoding::{self, Decoded, is_padding};
use crate::text::{check_size, line_after};
use brillianteer_base::Fault;
use encoding_rs::{Encoding, UTF_8, WINDOWS_1252};
use std::borrow::Cow;

/// The most attributes of one element; the XML parser compares each with each.
const MOST_ATTRIBUTES: usize = 256;

/// The most declarations of namespaces; the XML parser copies them down the tree.
const MOST_NAMESPACES: usize = 16;

/// The bytes at the start of a file in which its encoding is declared.
const DECLARED_WITHIN: usize = 256;

/// Returns the text of a file of a sane size and structure, in the encoding of its mark or of its declaration, and a warning
/// where some of its characters are damaged or are not read as declared.
pub(super) fn text(bytes: &[u8]) -> Result<(Cow<'_, str>, Option<String>), Fault> {
    check_size(bytes.len(), MAX_BYTES as u64)?;
    let (text, warning) = decoded(bytes);
    let text = tidied(text);
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
    Ok((text, warning))
}

/// Returns text without the padding behind it. XML wants its declaration at the very start; where blank lines are above it,
/// it is left out, as it says nothing more once the text is decoded.
fn tidied(text: Cow<'_, str>) -> Cow<'_, str> {
    let is_filling = |c: char| is_padding(c) || c.is_whitespace();
    let whole = text.trim_end_matches(is_filling);
    let start = whole.trim_start();
    let above = &whole[..whole.len() - start.len()];
    match start.strip_prefix("<?xml").and_then(|rest| rest.split_once("?>")) {
        Some((_, rest)) if !above.is_empty() => Cow::Owned(format!("{above}{rest}")),
        _ if whole.len() < text.len() => Cow::Owned(whole.to_owned()),
        _ => text,
    }
}

fn decoded(bytes: &[u8]) -> (Cow<'_, str>, Option<String>) {
    let label = declared(bytes);
    let encoding = label.as_deref().and_then(|label| Encoding::for_label(label.as_bytes()));
    let Decoded { text, encoding, is_damaged } = encoding::decoded(bytes, Some(encoding.unwrap_or(UTF_8)));
    let warning = match label {
        _ if is_damaged && encoding == UTF_8.name() && !has_letters_beyond_ascii(&text) => {
            let text = WINDOWS_1252.decode_without_bom_handling(bytes).0;
            let warning = "characters that are not UTF-8 are read as Windows-1252; save the file as UTF-8";
            return (text, Some(warning.to_owned()));
        }
        _ if is_damaged => Some(format!("characters that are not {encoding} are read as '\u{fffd}'")),
        Some(label) if Encoding::for_label(label.as_bytes()).is_none() => {
            Some(format!("encoding: '{label:.40}' is not known; the file is read as {encoding}"))
        }
        _ => None,
    };
    (text, warning)
}

/// Returns whether some letters beyond ASCII are whole in a text whose damaged bytes stand as U+FFFD, so that it is in the
/// encoding by which it was decoded.
fn has_letters_beyond_ascii(text: &str) -> bool {
    text.chars().any(|c| !c.is_ascii() && c != '\u{fffd}')
}

/// Returns the encoding that a file declares in its first line.
fn declared(bytes: &[u8]) -> Option<String> {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(DECLARED_WITHIN)]);
    let declaration = start.trim_start_matches('\u{feff}').strip_prefix("<?xml")?.split("?>").next()?;
    let (_, rest) = declaration.split_once("encoding")?;
    let value = rest.trim_start().strip_prefix('=')?.trim_start();
    let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    value[1..].split(quote).next().map(str::to_owned)
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

    #[test]
    fn blanks_above_and_padding_below_are_no_part_of_a_text() {
        let plain = "<?xml version=\"1.0\"?>\n<x/>";
        assert_eq!(text(plain.as_bytes()).unwrap().0, plain);
        assert_eq!(text(format!("{plain}\r\n\u{1a}\0\0").as_bytes()).unwrap().0, plain);
        // Lines keep their numbers.
        assert_eq!(text(format!("\n \n{plain}").as_bytes()).unwrap().0, "\n \n\n<x/>");
    }
}
