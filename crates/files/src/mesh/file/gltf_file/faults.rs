//! Says in plain words what is wrong with a glTF file that the gltf crate gives up on, and where.

use super::repair::string_length;
use crate::toml_text::in_plain_words;
use brillianteer_base::Fault;
use gltf::binary::Error as BinaryError;
use gltf::json::Error as JsonError;
use gltf::json::validation::Error as Invalid;
use serde_json::error::Category;

/// The beginning of the message about a file that is no glTF.
pub(super) const UNREADABLE: &str = "this glTF 2.0 cannot be read: ";

/// Makes the fault of JSON that is broken, or that has not the form of glTF.
pub(super) fn broken(json: &[u8], error: &JsonError) -> Fault {
    let full = error.to_string();
    let said = full.rsplit_once(" at line ").map_or(full.as_str(), |(said, _)| said);
    let problem = match error.classify() {
        Category::Eof => "its JSON ends too soon; the file has been cut off, get it again".to_owned(),
        Category::Data => {
            let path = path_at(json, offset(json, error));
            let place = if path.is_empty() { path } else { path + ": " };
            format!("{place}{}; save the file again", in_plain_words(said))
        }
        Category::Syntax | Category::Io => {
            format!("column {}: its JSON is broken ({said}); save the file again", error.column())
        }
    };
    Fault::line(error.line(), format!("{UNREADABLE}{problem}"))
}

/// Makes the fault of a file whose parts do not fit together.
pub(super) fn unfit(error: gltf::Error) -> Fault {
    let problem = match error {
        gltf::Error::Validation(faults) => faults.first().map_or_else(String::new, |(path, error)| {
            let what = match error {
                Invalid::IndexOutOfBounds => "refers to a part that is not in the file",
                Invalid::Invalid => "has a value that glTF 2.0 does not have",
                Invalid::Missing => "is missing",
                Invalid::Oversize => "is too large",
                Invalid::Unsupported => "is needed and is not read",
            };
            format!("{path} {what}")
        }),
        gltf::Error::Binary(BinaryError::ChunkLength { length, length_read, .. }) => {
            format!(
                "a chunk of {length} bytes is announced, and {length_read} are there: it has been cut off"
            )
        }
        gltf::Error::Binary(_) => {
            "its chunks are not those of a binary glTF file, a JSON chunk and behind it a binary one"
                .to_owned()
        }
        other => other.to_string(),
    };
    Fault::whole(format!("{UNREADABLE}{problem}; save the file again"))
}

/// Returns the place of an error in the bytes of its text.
fn offset(json: &[u8], error: &JsonError) -> usize {
    let lines = json.split_inclusive(|byte| *byte == b'\n');
    let above: usize = lines.take(error.line().saturating_sub(1)).map(<[u8]>::len).sum();
    (above + error.column()).min(json.len())
}

/// A step into JSON.
enum Step {
    /// The last key of an object, as it is written, and whether its value has begun.
    Key(String, bool),
    /// The number of a list's entry, from 0.
    Place(usize),
}

/// Returns the path, such as `nodes/0/matrix`, of the value that ends at an offset of JSON.
fn path_at(json: &[u8], end: usize) -> String {
    let mut path: Vec<Step> = vec![];
    let mut rest = &json[..end.saturating_sub(1)];
    while let Some(&byte) = rest.first() {
        let length = if byte == b'"' { string_length(rest) } else { 1 };
        match (byte, path.last_mut()) {
            (b'"', Some(Step::Key(key, false))) => {
                *key = String::from_utf8_lossy(rest[..length].trim_ascii()).trim_matches('"').to_owned();
            }
            (b':', Some(Step::Key(_, begun))) => *begun = true,
            (b',', Some(Step::Key(_, begun))) => *begun = false,
            (b',', Some(Step::Place(place))) => *place += 1,
            (b'{', _) => path.push(Step::Key(String::new(), false)),
            (b'[', _) => path.push(Step::Place(0)),
            (b'}' | b']', _) => drop(path.pop()),
            _ => {}
        }
        rest = &rest[length.min(rest.len())..];
    }
    // The fault of a list or an object is found at its end.
    if matches!(json.get(end.saturating_sub(1)), Some(b'}' | b']')) {
        path.pop();
    }
    let step = |step: &Step| match step {
        Step::Key(key, _) => format!("{key:.60}"),
        Step::Place(place) => place.to_string(),
    };
    path.iter().map(step).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_path_of_a_value_is_found_by_its_end() {
        let json = br#"{"a":[{"b":"x,\"{[","c":-3},{"d":[1,2]}],"e":{}}"#;
        for (value, path) in
            [("-3", "a/0/c"), ("-3}", "a/0"), ("1", "a/1/d/0"), ("1,2]", "a/1/d"), ("{}", "e")]
        {
            let end =
                json.windows(value.len()).position(|part| part == value.as_bytes()).unwrap() + value.len();
            assert_eq!(path_at(json, end), path, "{value}");
        }
        assert_eq!((path_at(b"", 0), path_at(b"[", 1), path_at(b"\"", 1)), Default::default());
    }
}
