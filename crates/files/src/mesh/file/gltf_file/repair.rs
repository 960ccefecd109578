//! Repairs the JSON of glTF files where it departs from the standard in a way that leaves its meaning clear.

use serde_json::{Map, Number, Value, json};

/// The greatest whole number up to which every f64 that is whole stands for one whole number.
const WHOLE: f64 = 9_007_199_254_740_992.0;

/// The keyword of the extension by which a primitive holds its corners and triangles in one compressed piece.
pub(super) const DRACO: &str = "KHR_draco_mesh_compression";

/// A repaired JSON.
pub(super) struct Repaired {
    pub root: Value,
    /// Warnings about content that was left out.
    pub warnings: Vec<String>,
}

/// Repairs JSON; `None` where it has no form that can be understood.
///
/// Numbers that are not finite become null, whole numbers that are written with a decimal point lose it, a scene may lack
/// its nodes, and a default scene that does not exist is left out.
pub(super) fn repaired(json: &[u8]) -> Option<Repaired> {
    let (json, warning) = with_finite_numbers(json);
    let mut root: Value = serde_json::from_slice(&json).ok()?;
    let mut warnings: Vec<String> = warning.into_iter().collect();
    whole_numbers(&mut root);
    let object = root.as_object_mut()?;
    for scene in list(object, "scenes").iter_mut().filter_map(Value::as_object_mut) {
        scene.entry("nodes").or_insert_with(|| json!([]));
    }
    let scenes = list(object, "scenes").len() as u64;
    if let Some(scene) =
        object.get("scene").filter(|scene| scene.as_u64().is_none_or(|scene| scene >= scenes))
    {
        warnings.push(format!("scene {scene} is to be shown, and there are {scenes}, counted from 0"));
        object.remove("scene");
    }
    Some(Repaired { root, warnings })
}

/// Gives accessors whose values lie in compressed pieces a buffer view, which the gltf crate demands and nothing reads;
/// returns whether there are any.
pub(super) fn with_views(root: &mut Value) -> bool {
    let Some(object) = root.as_object_mut() else { return false };
    let is_bare = |accessor: &Value| accessor.get("bufferView").is_none() && accessor.get("sparse").is_none();
    let packed =
        |primitive: &Value| primitive.get("extensions").is_some_and(|found| found.get(DRACO).is_some());
    let meshes = list(object, "meshes").iter().filter_map(|mesh| mesh.get("primitives")?.as_array());
    let any = meshes.flatten().any(packed);
    let accessors = list(object, "accessors").iter_mut().filter(|accessor| any && is_bare(accessor));
    accessors
        .filter_map(Value::as_object_mut)
        .for_each(|a| drop(a.insert("bufferView".to_owned(), json!(0))));
    any
}

/// Returns a list of an object; an empty list where the object has none.
pub(super) fn list<'a>(object: &'a mut Map<String, Value>, key: &str) -> &'a mut [Value] {
    object.get_mut(key).and_then(Value::as_array_mut).map_or(&mut [], Vec::as_mut_slice)
}

/// Writes whole numbers without a decimal point: in JSON, 25.0 is a whole number.
fn whole_numbers(value: &mut Value) {
    match value {
        Value::Number(number) if !number.is_i64() && !number.is_u64() => {
            let whole = number.as_f64().filter(|x| x.fract() == 0.0 && x.abs() < WHOLE);
            *number = whole.map_or_else(|| number.clone(), |x| Number::from(x as i64));
        }
        Value::Array(list) => list.iter_mut().for_each(whole_numbers),
        Value::Object(map) => map.values_mut().for_each(whole_numbers),
        _ => {}
    }
}

/// Replaces numbers that are not finite, which JSON does not have, by null, with a warning that names the first; writes other
/// numbers in the form of JSON.
fn with_finite_numbers(json: &[u8]) -> (Vec<u8>, Option<String>) {
    let mut out = Vec::with_capacity(json.len());
    let (mut rest, mut first) = (json, None);
    while let Some(&byte) = rest.first() {
        let length = match byte {
            b'"' => string_length(rest),
            b'+' | b'-' | b'.' | b'0'..=b'9' | b'A'..=b'Z' | b'a'..=b'z' => {
                let is_word = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'+' | b'-' | b'.');
                rest.iter().position(|b| !is_word(b)).unwrap_or(rest.len())
            }
            _ => 1,
        };
        let (piece, later) = rest.split_at(length);
        let word = if byte == b'"' || length == 0 { None } else { std::str::from_utf8(piece).ok() };
        match word
            .filter(|word| !matches!(*word, "true" | "false" | "null"))
            .map(|word| (word, word.parse::<f64>()))
        {
            Some((word, Ok(number))) if !number.is_finite() => {
                first.get_or_insert_with(|| (word.to_owned(), json.len() - rest.len()));
                out.extend(b"null");
            }
            // JSON has no plus sign, and digits on both sides of a point.
            Some((word, Ok(number))) if word.starts_with(['+', '.', '-']) || word.ends_with('.') => {
                out.extend(number.to_string().bytes());
            }
            _ => out.extend(piece),
        }
        rest = later;
    }
    let warning = first.map(|(word, at)| {
        let line = crate::text::line_after(&json[..at]);
        format!("line {line}: `{word}` is not a number of JSON and is left out")
    });
    (out, warning)
}

/// Returns the length of the string that a text begins with, in bytes with its quotes.
pub(super) fn string_length(text: &[u8]) -> usize {
    let mut escaped = false;
    let is_end = |byte: &u8| {
        let ends = *byte == b'"' && !escaped;
        escaped = *byte == b'\\' && !escaped;
        ends
    };
    text[1..].iter().position(is_end).map_or(text.len(), |at| at + 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_json_does_not_have_are_left_out_and_strings_stay() {
        let text = r#"{"a":[inf,-Infinity,NaN,1e999,25.0,-0.5,.5,+1],"b":"inf \" nan","c":true,"d":null}"#;
        let Repaired { root, warnings } = repaired(text.as_bytes()).unwrap();
        let expected = json!({ "a": [null, null, null, null, 25, -0.5, 0.5, 1], "b": "inf \" nan", "c": true, "d": null });
        assert_eq!(root, expected);
        assert_eq!(warnings, ["line 1: `inf` is not a number of JSON and is left out"]);
        for broken in ["", "{", "{\"a\":inf", "[1]", "{\"a\":\"b}", "{\"a\":fin}"] {
            assert!(repaired(broken.as_bytes()).is_none(), "{broken}");
        }
    }
}
