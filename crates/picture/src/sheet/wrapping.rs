//! Breaks texts into lines that fit a width.

use super::super::drawing::text_width;

/// Breaks a text of words into lines no wider than `room`; a word that is wider alone is broken anywhere.
pub(crate) fn words(text: &str, size: f64, room: f64) -> Vec<String> {
    packed(text.split_whitespace().map(str::to_owned), " ", size, room)
}

/// Breaks items that are joined by dashes into lines no wider than `room`. A line that goes on ends with a dash.
pub(super) fn dashed(items: &[String], size: f64, room: f64) -> Vec<String> {
    let last = items.len().saturating_sub(1);
    let dashed = items.iter().enumerate();
    let pieces = dashed.map(|(k, item)| if k < last { format!("{item}-") } else { item.clone() });
    packed(pieces, "", size, room)
}

fn packed(pieces: impl Iterator<Item = String>, between: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    for piece in pieces.flat_map(|piece| broken(&piece, size, room)) {
        match lines.last_mut() {
            Some(line) if text_width(&format!("{line}{between}{piece}"), size) <= room => {
                line.push_str(between);
                line.push_str(&piece);
            }
            _ => lines.push(piece),
        }
    }
    lines
}

/// Returns a piece whole, or in parts that fit where it is wider than `room`.
fn broken(piece: &str, size: f64, room: f64) -> Vec<String> {
    let mut parts = vec![String::new()];
    for letter in piece.chars() {
        let wider = |part: &String| text_width(&format!("{part}{letter}"), size) > room;
        if parts.last().is_some_and(|part| !part.is_empty() && wider(part)) {
            parts.push(String::new());
        }
        parts.iter_mut().last().into_iter().for_each(|part| part.push(letter));
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_fit_and_nothing_is_lost() {
        let text = "Meet 1-2-G1 at the girdle, thenCutOnUntilNothingIsLeftOfThePreform, slowly";
        for room in [30.0, 60.0, 200.0, 900.0] {
            let lines = words(text, 15.0, room);
            assert!(lines.iter().all(|line| text_width(line, 15.0) <= room), "{lines:?}");
            let letters = |text: &str| text.split_whitespace().collect::<String>();
            assert_eq!(letters(&lines.concat()), letters(text));
        }
        assert_eq!(words("one two", 15.0, 900.0), ["one two"]);
        assert_eq!(words("  ", 15.0, 100.0), [""; 0]);
    }

    #[test]
    fn indices_go_on_behind_a_dash() {
        let items: Vec<String> = (1..=32).map(|k| (3 * k).to_string()).collect();
        let lines = dashed(&items, 15.0, 200.0);
        assert!(lines.len() > 2 && lines.iter().all(|line| text_width(line, 15.0) <= 200.0));
        assert_eq!(lines.concat(), items.join("-"));
        let (last, others) = lines.split_last().unwrap();
        assert!(others.iter().all(|line| line.ends_with('-')) && !last.ends_with('-'));
    }
}
