//! Joins a shader from its parts. A WGSL file of `shaders` names the files and the structs of [`gpu_types`] that it needs
//! in one line, `// Imports: optics, Frame.` Functions that differ from shader to shader, as `next_facet`, come from the
//! files that [`shaders`](super::shaders) chooses; the file that calls them names them at its head.

use super::gpu_types;

/// The mark of the line that names imports.
const MARK: &str = "// Imports: ";

/// Lists files of `shaders` by their names.
macro_rules! files {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../../../../shaders/", $name, ".wgsl")))),*]
    };
}

/// The files, each by its name.
const FILES: [(&str, &str); 26] = files![
    "angles",
    "basis",
    "branching",
    "bvh",
    "camera",
    "clusters",
    "convex",
    "environment",
    "flat",
    "implicit",
    "jets",
    "leaving",
    "light",
    "liquid_glass",
    "metal",
    "microfacets",
    "no_metal",
    "optics",
    "planes",
    "pose",
    "random",
    "ray",
    "scope",
    "tiles",
    "trace",
    "triangles",
];

/// The structs, each by its name.
const STRUCTS: [(&str, &str); 15] = [
    ("Frame", gpu_types::FRAME_WGSL),
    ("Bands", gpu_types::BANDS_WGSL),
    ("Body", gpu_types::BODY_WGSL),
    ("Medium", gpu_types::MEDIUM_WGSL),
    ("Finish", gpu_types::FINISH_WGSL),
    ("Environment", gpu_types::ENVIRONMENT_WGSL),
    ("Lamp", gpu_types::LAMP_WGSL),
    ("Response", gpu_types::RESPONSE_WGSL),
    ("RadiancePixel", gpu_types::RADIANCE_PIXEL_WGSL),
    ("ScopePixel", gpu_types::SCOPE_PIXEL_WGSL),
    ("Cluster", gpu_types::CLUSTER_WGSL),
    ("Triangle", gpu_types::TRIANGLE_WGSL),
    ("ImplicitSurface", gpu_types::IMPLICIT_SURFACE_WGSL),
    ("PaneData", gpu_types::PANE_DATA_WGSL),
    ("BvhNode", gpu_types::BVH_NODE_WGSL),
];

/// Returns the texts of some parts and of all that they import, each once. A name that no part has is left out, and the
/// shader is then not valid.
pub(super) fn joined(names: &[&str]) -> String {
    let mut parts: Vec<(&str, &str)> = vec![];
    names.iter().for_each(|name| add(name, &mut parts));
    parts.into_iter().map(|(_, text)| text).collect()
}

/// Adds a part, and what it imports, to those that are joined so far.
fn add(name: &str, parts: &mut Vec<(&'static str, &'static str)>) {
    let Some(&part) = FILES.iter().chain(&STRUCTS).find(|(own, _)| *own == name) else { return };
    if !parts.contains(&part) {
        parts.push(part);
        imports(part.1).for_each(|name| add(name, parts));
    }
}

/// Returns the names that a text imports.
fn imports(text: &str) -> impl Iterator<Item = &str> {
    let lines = text.lines().filter_map(|line| line.strip_prefix(MARK));
    lines.flat_map(|names| names.trim_end_matches('.').split(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_import_names_a_part_and_brings_it_once() {
        let mut count = 0;
        for (file, text) in FILES {
            for name in imports(text) {
                let is_there = FILES.iter().chain(&STRUCTS).any(|(own, _)| *own == name);
                assert!(is_there, "{file} imports {name}, which is no part");
                count += 1;
            }
            let joined = joined(&[file, file]);
            for line in joined.lines().filter(|line| line.starts_with("fn ") || line.starts_with("struct ")) {
                assert_eq!(joined.matches(line).count(), 1, "{file}: {line}");
            }
        }
        assert!(count > 40, "{count}");
        assert_eq!(imports("// Imports: a, B.\nfn c() {}\n").collect::<Vec<_>>(), ["a", "B"]);
        assert!(joined(&["trace"]).contains("struct Frame {") && joined(&["trace"]).contains("fn fresnel("));
    }

    /// Returns the names of the structs and constants that a text declares; all of them begin with a capital.
    fn declared(text: &str) -> impl Iterator<Item = &str> {
        let names =
            text.lines().filter_map(|line| line.strip_prefix("struct ").or(line.strip_prefix("const ")));
        names.filter_map(|rest| rest.split(|c: char| !c.is_alphanumeric() && c != '_').next())
    }

    #[test]
    fn every_file_imports_the_structs_and_constants_that_it_names() {
        let all: Vec<&str> = FILES.iter().chain(&STRUCTS).flat_map(|(_, text)| declared(text)).collect();
        let mut count = 0;
        for (file, text) in FILES {
            let own = joined(&[file]);
            let known: Vec<&str> = declared(&own).collect();
            let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
            let words = code.flat_map(|line| line.split(|c: char| !c.is_alphanumeric() && c != '_'));
            // These differ from shader to shader.
            let is_chosen = |word: &str| ["IS_CURVED", "Chances"].contains(&word);
            for word in words.filter(|word| all.contains(word) && !is_chosen(word)) {
                assert!(known.contains(&word), "{file} names {word} and does not import it");
                count += 1;
            }
        }
        assert!(count > 300, "{count}");
    }
}
