//! What is wrong with a text, and where: by its key's path, or by the span that the TOML parser gives.

use super::super::text::line_after;
use std::ops::Range;

use toml::de::{DeTable, DeValue, Error};

/// What the keys mean, for whoever left one out or wrote something else.
const MEANINGS: [(&str, &str); 21] = [
    ("name", "what the cut is called"),
    ("material", "a material's name, an index, or a table of its own"),
    ("diameter_mm", "girdle diameter in mm"),
    ("table", PERCENT),
    ("crown_angle", DEGREES),
    ("crown_height", PERCENT),
    ("pavilion_angle", DEGREES),
    ("pavilion_depth", PERCENT),
    ("star_length", "percent of the way from the table's edge to the girdle"),
    ("lower_half_length", "percent of the way from the girdle to the centre"),
    ("lower_half_length_vertical", "percent of the depth from the girdle to where the mains meet"),
    ("girdle_thickness", "percent of the girdle diameter, at the bezels"),
    ("girdle_facets", "16 to 128"),
    ("culet", "percent of the girdle diameter, 0 for a point"),
    ("normal", "outward, [x, y, z]"),
    ("offset", "n·x <= offset, with the girdle radius 1"),
    ("cauchy", "[A, B] of n = A + B / L², L in µm"),
    ("abbe", "[n_d, v_d]"),
    ("sellmeier", "[[B, C], ...], C in µm"),
    ("absorption", "a number per mm, or [[nm, per mm], ...]"),
    ("valid_nm", "[first, last]"),
];
const PERCENT: &str = "percent of the girdle diameter";
const DEGREES: &str = "degrees from the girdle plane";

/// How serde words what was expected, and what a person would say.
const WORDS: [(&str, &str); 8] = [
    ("expected f64", "expected a number"),
    ("expected i64", "expected a whole number"),
    ("expected a string", "expected text"),
    (" as i128", ""),
    ("expected a sequence", "expected a list"),
    ("invalid type: sequence", "invalid type: list"),
    ("invalid type: map", "invalid type: table"),
    ("floating point", "number"),
];

/// What is wrong, and where.
#[derive(Debug)]
pub(super) struct Fault {
    place: Place,
    pub message: String,
}

#[derive(Debug)]
enum Place {
    Whole,
    /// A byte offset in the text.
    Offset(usize),
    /// A key's path, as `plane/17/normal`.
    Path(String),
}

impl Fault {
    /// A fault of the file as a whole.
    pub fn whole(message: impl Into<String>) -> Self {
        Self { place: Place::Whole, message: message.into() }
    }

    /// Something missing at the top of the file.
    pub fn top(message: impl Into<String>) -> Self {
        Self { place: Place::Offset(0), message: message.into() }
    }

    /// A fault of the value at a path such as `plane/17/normal`, or of what encloses it where the value is missing.
    pub fn at(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self { place: Place::Path(path.into()), message: message.into() }
    }

    /// What the parser says of a text that is not TOML.
    pub fn syntax(text: &str, error: &Error) -> Self {
        let Some(span) = error.span() else {
            return Self::whole(format!("this is no TOML that can be read: {}", error.message()));
        };
        let start = span.start.min(text.len());
        let line = text.as_bytes()[..start].rsplit(|byte| *byte == b'\n').next().unwrap_or_default();
        let column = 1 + String::from_utf8_lossy(line).chars().count();
        let message = format!("column {column}: {}", error.message());
        Self { place: Place::Offset(start), message }
    }

    /// What serde says of a text that is not a cut file, in the words of this program.
    pub fn form(mut error: Error) -> Self {
        // Without its text the error shows the path of its key, on a line of its own: in `plane.normal`.
        error.set_input(None);
        let shown = error.to_string();
        let path = shown.trim_end().rsplit_once("\nin `").and_then(|(_, path)| path.strip_suffix('`'));
        let message = match path {
            Some(path) => format!("{path}: {}", reworded(error.message(), path)),
            None => reworded(error.message(), ""),
        };
        let place = error.span().map_or(Place::Whole, |span| Place::Offset(span.start));
        Self { place, message: shortened(message) }
    }

    /// The line at fault, from 1.
    pub fn line(&self, text: &str) -> Option<usize> {
        let offset = match &self.place {
            Place::Whole => None,
            Place::Offset(offset) => Some(*offset),
            Place::Path(path) => DeTable::parse(text).ok().and_then(|table| span(table.get_ref(), path)),
        }?;
        Some(line_after(&text.as_bytes()[..offset.min(text.len())]))
    }
}

/// Where the value at a path begins, or the nearest that encloses it; `None` if that is the whole text.
fn span(table: &DeTable<'_>, path: &str) -> Option<usize> {
    let mut steps = path.split('/');
    let mut value = table.get(steps.next()?)?;
    for step in steps {
        let inner = match value.get_ref() {
            DeValue::Table(table) => table.get(step),
            DeValue::Array(array) => step.parse().ok().and_then(|index: usize| array.get(index)),
            _ => None,
        };
        match inner {
            Some(inner) => value = inner,
            None => break,
        }
    }
    let Range { start, .. } = value.span();
    Some(start)
}

/// A message that quotes something endless, cut to what a person reads.
fn shortened(message: String) -> String {
    const LONGEST: usize = 600;
    match message.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} ...", &message[..end]),
        None => message,
    }
}

/// serde's message with keys for fields, numbers for f64, and what the key means.
fn reworded(message: &str, path: &str) -> String {
    if let Some(rest) = message.strip_prefix("unknown field ") {
        return format!("unknown key {}", rest.replace("expected one of", "known here are"));
    }
    if let Some(rest) = message.strip_prefix("missing field ") {
        return format!("the key {rest} is missing{}", meaning(rest.trim_matches('`')));
    }
    let plain = WORDS.iter().fold(message.to_owned(), |text, (serde, word)| text.replace(serde, word));
    plain + &meaning(path.rsplit('.').next().unwrap_or_default())
}

fn meaning(key: &str) -> String {
    let found = MEANINGS.iter().find(|(known, _)| *known == key);
    found.map(|(_, meaning)| format!(" ({meaning})")).unwrap_or_default()
}
