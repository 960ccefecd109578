//! Faults of a TOML text: what is wrong, and where, by its key's path or by the span that the TOML parser gives.

use super::text::line_after;
use crate::cut::{FAMILIES, Family};
use std::ops::Range;

use toml::de::{DeTable, DeValue, Error};

/// The meanings of keys, for someone who left a key out or wrote something else. Those of proportions are in their
/// families' tables.
const MEANINGS: [(&str, &str); 48] = [
    ("name", "what it is called"),
    ("material", "a material's name, an index, or a table of its own"),
    ("diameter_mm", "girdle diameter in mm"),
    ("normal", "outward, [x, y, z]"),
    ("offset", "n·x <= offset, with the girdle radius 1"),
    ("gear", "teeth of the index gear"),
    ("angle", "degrees from the girdle plane, below 0 for the pavilion"),
    ("distance", "from the origin to the facet's plane"),
    ("indices", "teeth at which the tier is cut"),
    ("index", "the gear, a table [index]"),
    ("cauchy", "[A, B] of n = A + B / L², L in µm"),
    ("abbe", "[n_d, v_d]"),
    ("sellmeier", "[[B, C], ...], C in µm"),
    ("absorption", "a number per mm, or [[nm, per mm], ...]"),
    ("absorption_e", "of the extraordinary polarisation: a number per mm, or [[nm, per mm], ...]"),
    ("valid_nm", "[first, last]"),
    ("density", "g/cm³"),
    ("light", "a light's name, or a file"),
    ("layout", "row, ring or parcel"),
    ("gap_mm", "mm between the girdles of a layout"),
    ("strength", "of refraction, 0 to 1; 1 is physics"),
    ("background", "a colour, light, a pattern's name, or a photograph"),
    ("background_distance_mm", "mm behind the middle of the stones"),
    ("stone", "a table [[stone]] for each kind"),
    ("cut", "a cut's name, or a cut file"),
    ("count", "how many"),
    ("turn", "degrees about the stone's axis"),
    ("tilt", "degrees that the table leans toward the azimuth"),
    ("at", "[x, y, z] in mm"),
    ("from", "degrees of elevation at which it begins, -90 to 90"),
    ("colour", "[red, green, blue] of sRGB, 0 to 255 each"),
    ("spectrum", "D65, A, E, or daylight such as 5000 K"),
    ("head", "half angle of the observer's head, degrees, 0 for none"),
    ("dome", "belts of the sky, each a table [[dome]]"),
    ("box", "rectangles of light, each a table [[box]]"),
    ("lamp", "discs of light, each a table [[lamp]]"),
    ("field", "many lamps, each field a table [[field]]"),
    ("panorama", "a picture of the surroundings, a table [panorama]"),
    ("to", "degrees of elevation at which it ends, -90 to 90"),
    ("soft", "width of its edges, degrees"),
    ("radiance", RADIANCE),
    ("end", RADIANCE),
    ("azimuth", "degrees, counter-clockwise"),
    ("elevation", "degrees from the horizon, -90 to 90"),
    ("width", "degrees"),
    ("height", "degrees"),
    ("radius", "degrees from its middle to its edge"),
    ("file", "a picture: .hdr, .exr, .png or .jpg"),
];
const RADIANCE: &str = "0 to 1e6; 1 is a white sheet in full light";
/// How serde words what was expected, and the words of a person for it.
const WORDS: [(&str, &str); 12] = [
    ("expected f64", "expected a number"),
    ("expected u32", "expected a whole number, 0 or more"),
    ("expected u8", "expected a whole number from 0 to 255"),
    ("expected an array of length 3", "expected a list of 3 numbers"),
    ("expected i64", "expected a whole number"),
    ("expected a string", "expected text"),
    (" as i128", ""),
    (" as u128", ""),
    ("expected a sequence", "expected a list"),
    ("invalid type: sequence", "invalid type: list"),
    ("invalid type: map", "invalid type: table"),
    ("floating point", "number"),
];

/// What is wrong in a text, and where.
#[derive(Debug)]
pub(super) struct Fault {
    place: Place,
    pub(super) message: String,
}

#[derive(Debug)]
enum Place {
    Whole,
    /// A byte offset in the text.
    Offset(usize),
    /// The path of a key, such as `plane/17/normal`.
    Path(String),
}

impl Fault {
    /// Makes a fault of the file as a whole.
    pub(super) fn whole(message: impl Into<String>) -> Self {
        Self { place: Place::Whole, message: message.into() }
    }

    /// Makes a fault of something that is missing at the top of the file.
    pub(super) fn top(message: impl Into<String>) -> Self {
        Self { place: Place::Offset(0), message: message.into() }
    }

    /// Makes a fault of the value at a path such as `plane/17/normal`, or of what encloses it where the value is missing.
    pub(super) fn at(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self { place: Place::Path(path.into()), message: message.into() }
    }

    /// Returns the same fault for something that is part of another: `path` comes before its path, and `told` before its
    /// message.
    pub(super) fn within(self, path: &str, told: &str) -> Self {
        let place = match self.place {
            Place::Path(inner) => Place::Path(path.to_owned() + &inner),
            place => place,
        };
        Self { place, message: told.to_owned() + &self.message }
    }

    /// Makes a fault of what the parser says of a text that is not TOML.
    pub(super) fn syntax(text: &str, error: &Error) -> Self {
        let Some(span) = error.span() else {
            return Self::whole(format!("this is no TOML that can be read: {}", error.message()));
        };
        let start = span.start.min(text.len());
        let line = text.as_bytes()[..start].rsplit(|byte| *byte == b'\n').next().unwrap_or_default();
        let column = 1 + String::from_utf8_lossy(line).chars().count();
        let whole = text[start - line.len()..].lines().next().unwrap_or_default();
        let key = whole.split_once('=').map_or(String::new(), |(key, _)| format!("{}: ", key.trim()));
        let message = shortened(format!("{key}column {column}: {}{}", error.message(), hint(whole)));
        Self { place: Place::Offset(start), message }
    }

    /// Makes a fault of what serde says of a text that has not the form of its file, in the words of this program.
    pub(super) fn form(error: Error) -> Self {
        Self::form_beside(error, &[])
    }

    /// Does the same for a file whose top may have further keys, which something else has read.
    pub(super) fn form_beside(mut error: Error, further: &[&str]) -> Self {
        // Without its text the error shows the path of its key on a line of its own: in `plane.normal`.
        error.set_input(None);
        let shown = error.to_string();
        let path = shown.trim_end().rsplit_once("\nin `").and_then(|(_, path)| path.strip_suffix('`'));
        let message = match path {
            Some(path) => format!("{path}: {}", reworded(error.message(), path, &[])),
            None => reworded(error.message(), "", further),
        };
        let place = error.span().map_or(Place::Whole, |span| Place::Offset(span.start));
        Self { place, message: shortened(message) }
    }

    /// Returns the line at fault, from 1; `None` where that is not known or the file as a whole is at fault.
    pub(super) fn line(&self, text: &str) -> Option<usize> {
        let offset = match &self.place {
            Place::Whole => None,
            Place::Offset(offset) => Some(*offset),
            Place::Path(path) => DeTable::parse(text).ok().and_then(|table| span(table.get_ref(), path)),
        }?;
        Some(line_after(&text.as_bytes()[..offset.min(text.len())]))
    }
}

/// Returns the byte offset of the value at a path, or of the nearest value that encloses it; `None` if that is the whole
/// text.
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

/// Cuts a message that quotes something very long to what a person reads.
fn shortened(message: String) -> String {
    const LONGEST: usize = 600;
    match message.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} ...", &message[..end]),
        None => message,
    }
}

/// Returns a hint at what someone may have meant by a line that is no TOML.
fn hint(line: &str) -> &'static str {
    let value = line.split_once('=').map_or(line, |(_, value)| value).trim_start();
    let number: String = value.chars().take_while(|c| c.is_ascii_digit() || "+-.,".contains(*c)).collect();
    let rest = value[number.len()..].trim_start();
    if number.contains(',') {
        "; numbers have a decimal point, as in 34.5"
    } else if !number.is_empty() && rest.starts_with(['%', '°']) {
        "; leave the unit out: percent and degrees are understood"
    } else {
        ""
    }
}

/// Returns a hint at an unknown key: the known key that is most like it, or the table that it belongs to.
pub(super) fn meant(asked: &str, known: &[&str]) -> String {
    let is_at_top = FAMILIES.iter().any(|family| known.contains(&family.key));
    let mut families = FAMILIES.iter().filter(|_| is_at_top);
    if let Some(family) = families.find(|family| family.proportion(asked).is_some()) {
        return format!("; it belongs below a line [{}]", family.key);
    }
    let slips = |key: &&&str| strsim::damerau_levenshtein(asked, key);
    let near = known.iter().min_by_key(slips).filter(|key| slips(key) <= 3);
    near.map_or(String::new(), |key| format!("; did you mean `{key}`?"))
}

/// Returns serde's message with keys for fields, numbers for f64, and the meaning of the key. `further` are known keys of
/// which serde does not know.
fn reworded(message: &str, path: &str, further: &[&str]) -> String {
    if let Some(rest) = message.strip_prefix("unknown field ") {
        let mut keys = rest.split('`').skip(1).step_by(2);
        let asked = keys.next().unwrap_or_default();
        let known: Vec<&str> = keys.chain(further.iter().copied()).collect();
        let further: String = further.iter().map(|key| format!(", `{key}`")).collect();
        let rest = rest.replace("expected one of", "known here are");
        return format!("unknown key {rest}{further}{}", meant(asked, &known));
    }
    let table = path.split('.').next().unwrap_or_default();
    if let Some(rest) = message.strip_prefix("missing field ") {
        return format!("the key {rest} is missing{}", meaning(table, rest.trim_matches('`')));
    }
    let plain = WORDS.iter().fold(message.to_owned(), |text, (serde, word)| text.replace(serde, word));
    plain + &meaning(table, path.rsplit('.').next().unwrap_or_default())
}

/// Returns the meaning of a key in brackets, where it is known; `table` is the table at the top of the file that it is in.
fn meaning(table: &str, key: &str) -> String {
    let row = Family::of_key(table).and_then(|family| family.proportion(key));
    let found = MEANINGS.iter().find(|(known, _)| *known == key).map(|(_, meaning)| (*meaning).to_owned());
    let found = row.map(|row| row.hint()).or(found);
    found.map(|meaning| format!(" ({meaning})")).unwrap_or_default()
}
