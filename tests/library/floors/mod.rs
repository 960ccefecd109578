//! Checks rules of the source that no compiler holds. Which crate may use which is said by their manifests.

mod circles;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    entries
        .flat_map(|p| if p.is_dir() { sources(&p) } else { vec![p] })
        .filter(|p| p.extension().is_some_and(|e| e == "rs"))
        .collect()
}

/// Returns the folders of the sources of the program and of all crates.
fn crates() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = std::fs::read_dir(root.join("crates")).unwrap().map(|entry| entry.unwrap().path());
    crates.chain([root.to_path_buf()]).map(|folder| folder.join("src")).collect()
}

/// Returns the files of the program and of all crates, without those of tests, benches and examples.
fn all_sources() -> Vec<PathBuf> {
    crates().iter().flat_map(|folder| sources(folder)).collect()
}

/// Returns a text without its tests. Where they lie in a file of their own, the code goes on behind the line that names it.
fn untested(text: &str) -> String {
    let mut parts = text.split("#[cfg(test)]\nmod ");
    let before = parts.next().unwrap_or("");
    let behind = parts.map_while(|part| part.split_once(";\n").filter(|(name, _)| !name.contains('{')));
    std::iter::once(before).chain(behind.map(|(_, rest)| rest)).collect()
}

#[test]
fn code_behind_tests_in_a_file_of_their_own_is_seen() {
    let text = "a;\n#[cfg(test)]\nmod tests;\nb;\n#[cfg(test)]\nmod others {\n    c;\n}\nd;\n";
    assert_eq!(untested(text), "a;\nb;\n");
}

/// Returns the lines of a text that name a tracer, outside comments and test modules.
fn naming_a_tracer(code: &str) -> Vec<&str> {
    let names = ["Backend::Beams", "Backend::Rays", "Backend::Card", "by_gpu::trace", "by_rays::trace"];
    let lines = code.lines();
    lines
        .filter(|line| !line.trim_start().starts_with("//") && names.iter().any(|name| line.contains(name)))
        .collect()
}

#[test]
fn only_the_renderer_names_a_tracer() {
    assert_eq!(naming_a_tracer("let x = 1;\n// Backend::Rays\nBackend::Rays\n"), ["Backend::Rays"]);
    let renderer = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/render");
    let mut inside = 0;
    for path in all_sources() {
        let text = untested(&std::fs::read_to_string(&path).unwrap());
        let lines = naming_a_tracer(&text);
        if path.starts_with(&renderer) {
            inside += lines.len();
        } else {
            assert!(lines.is_empty(), "{}: {lines:?}: only crates/render decides who traces", path.display());
        }
    }
    assert!(inside > 10, "the renderer names only {inside}: the check has lost its eyes");
}

/// Returns the public types that a text declares outside its test modules.
fn public_types(code: &str) -> Vec<&str> {
    let public = code.lines().filter_map(|line| {
        let line = line.trim_start().strip_prefix("pub")?;
        let after = if line.starts_with('(') { line.split_once(')')?.1 } else { line };
        let mut words = after.split_whitespace();
        let kind = words.next()?;
        ["struct", "enum", "trait", "type"].contains(&kind).then(|| words.next()).flatten()
    });
    public.map(|name| name.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("")).collect()
}

#[test]
fn no_two_public_types_have_one_name() {
    let mut places = BTreeMap::<String, Vec<PathBuf>>::new();
    for path in all_sources().into_iter().filter(|path| !path.iter().any(|part| part == "tests")) {
        let text = untested(&std::fs::read_to_string(&path).unwrap());
        for name in public_types(&text) {
            places.entry(name.to_owned()).or_default().push(path.clone());
        }
    }
    assert!(places.len() > 200, "only {} types were seen: the check has lost its eyes", places.len());
    let shared: Vec<_> = places.iter().filter(|(_, paths)| paths.len() > 1).collect();
    assert!(shared.is_empty(), "one name, several types: {shared:#?}");
    let seen = public_types(
        "pub(super) struct A<T>;\n  pub enum B {\nstruct C;\npub fn d() {}\n// pub type E = u8;",
    );
    assert_eq!(seen, ["A", "B"]);
}

/// Returns the characters of a text with their places and the number of brackets that are open behind them.
fn depths(text: &str) -> impl Iterator<Item = (usize, char, i32)> {
    text.char_indices().scan(0, |depth, (at, c)| {
        *depth += match c {
            '<' | '(' | '[' => 1,
            // An arrow closes nothing.
            '>' if text[..at].ends_with('-') => 0,
            '>' | ')' | ']' => -1,
            _ => 0,
        };
        Some((at, c, *depth))
    })
}

/// Returns the text from a bracket on to the one that closes it.
fn bracketed(text: &str) -> &str {
    depths(text).find(|(.., depth)| *depth == 0).map_or(text, |(at, ..)| &text[..at])
}

/// Returns the part of an item that other files see: a function's signature, a type, or a field.
fn seen_from_outside(item: &str) -> &str {
    let end = depths(item).find(|(_, c, depth)| *depth <= 0 && "{};,".contains(*c));
    end.map_or(item, |(at, ..)| &item[..at])
}

/// Returns the signatures in a text that other files can see and whose error is a bare text.
fn texts_as_errors(text: &str) -> Vec<String> {
    let code = untested(text);
    let lines: Vec<&str> = code.lines().map(|line| line.split("//").next().unwrap_or("").trim()).collect();
    let is_text = |error: &str| ["String", "&str", "&'static str"].contains(&error.trim());
    let is_error_type = |line: &&&str| {
        let alias = line.strip_prefix("type Err").and_then(|rest| rest.trim_end_matches(';').split_once('='));
        alias.is_some_and(|(_, error)| is_text(error))
    };
    let of_traits = lines.iter().filter(is_error_type).map(|line| (*line).to_owned());
    let whole = lines.join(" ");
    let items = whole.split(" pub").skip(1).map(seen_from_outside);
    let has_text = |item: &&str| {
        let results = item.match_indices("Result<").map(|(at, _)| bracketed(&item[at + "Result".len()..]));
        results.into_iter().any(|result| result.rsplit_once(',').is_some_and(|(_, error)| is_text(error)))
    };
    of_traits.chain(items.filter(has_text).map(str::to_owned)).collect()
}

#[test]
fn no_error_that_other_files_see_is_a_bare_text() {
    let mut results = 0;
    let mut bare = vec![];
    for path in all_sources().into_iter().filter(|path| !path.iter().any(|part| part == "tests")) {
        let text = std::fs::read_to_string(&path).unwrap();
        results += text.matches("Result<").count();
        bare.extend(texts_as_errors(&text).into_iter().map(|item| format!("{}: {item}", path.display())));
    }
    assert!(bare.is_empty(), "give these errors a type: {bare:#?}");
    assert!(results > 300, "only {results} results were seen: the check has lost its eyes");
    let seen = texts_as_errors(
        "\npub fn a(b: &str) -> Result<Vec<u8>, String> {\npub(super) fn c(\n    d: u8,\n) -> Result<(), String>\n\
         where X: Y {\npub type E = Arc<dyn Fn(&str) -> Result<(), String>>;\nstruct F {\n    \
         pub g: Option<Result<u8, &'static str>>,\n    h: Result<u8, String>,\n}\nfn i() -> Result<u8, String> {\n\
         type Err = String;\npub fn j() -> Result<String, Fault> {\n// pub fn k() -> Result<u8, String>\n",
    );
    assert_eq!(seen.len(), 5, "{seen:#?}");
}

/// Returns the texts of code that name a flag of the command line.
fn flags(text: &str) -> Vec<String> {
    let code = untested(text);
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    let flag = |line: &str| {
        let mut pieces = line.split("--").skip(1);
        pieces.any(|rest| rest.starts_with(|c: char| c.is_ascii_lowercase()))
    };
    lines.filter(|line| flag(line)).map(|line| line.trim().to_owned()).collect()
}

#[test]
fn a_text_that_names_a_flag_would_be_seen() {
    assert_eq!(
        flags("let a = \"leave out --moment\";\n// --up\nb - -c;\n"),
        ["let a = \"leave out --moment\";"]
    );
    assert!(flags("a;\n#[cfg(test)]\nmod tests {\n    \"--up\";\n}\n").is_empty());
}

#[test]
fn no_text_of_the_library_names_a_flag() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let is_of_program = |path: &Path| {
        path.starts_with(&src)
            || path.components().any(|part| part.as_os_str().to_string_lossy().starts_with("tests"))
    };
    let files: Vec<PathBuf> = all_sources().into_iter().filter(|path| !is_of_program(path)).collect();
    assert!(files.len() > 100);
    let found: Vec<String> = files
        .iter()
        .flat_map(|path| {
            let named = flags(&std::fs::read_to_string(path).unwrap());
            named.into_iter().map(move |text| format!("{}: {text}", path.display()))
        })
        .collect();
    assert!(found.is_empty(), "the program adds flags to what the library says: {found:#?}");
}

/// Returns the forbidden names in a text of the editor's model: those of the window, and those of data that threads
/// share.
fn windows(text: &str) -> Vec<&'static str> {
    let code: String = text.lines().map(|line| line.split("//").next().unwrap_or("")).collect();
    let is_word = |name: &str| {
        let mut found = code.match_indices(name);
        found.any(|(at, _)| !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
    };
    ["egui", "eframe", "Arc<Mutex", "mpsc", "JoinHandle"].into_iter().filter(|name| is_word(name)).collect()
}

#[test]
fn the_editors_model_knows_no_window_and_no_thread() {
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/session/src/model");
    let paths = sources(&model);
    assert!(paths.len() > 20, "only {} files were seen: the check has lost its eyes", paths.len());
    for path in paths {
        let named = windows(&std::fs::read_to_string(&path).unwrap());
        assert!(named.is_empty(), "{}: names {named:?}", path.display());
    }
    assert_eq!(windows("use egui::Ui; struct A(Arc<Mutex<u8>>);"), ["egui", "Arc<Mutex"]);
    assert!(windows("regui(); // as egui does").is_empty());
}

/// Returns the places in a text where a format writes a number with its sign, without `math::signed`.
fn signs_of_their_own(text: &str) -> Vec<&str> {
    let specs =
        text.match_indices('{').filter_map(|(at, _)| text[at..].split_once('}').map(|(spec, _)| spec));
    let is_signed = |spec: &&str| {
        let Some((name, format)) = spec[1..].split_once(':') else { return false };
        name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '.'))
            && format.trim_start_matches(['<', '>', '^']).starts_with('+')
    };
    specs.filter(is_signed).collect()
}

#[test]
fn differences_are_written_by_one_function_that_knows_no_negative_zero() {
    assert_eq!(
        signs_of_their_own(r#"format!("{by:+.2} {:>+9.3} {x:.2} {{ a: b }}")"#),
        ["{by:+.2", "{:>+9.3"]
    );
    for path in all_sources() {
        let text = std::fs::read_to_string(&path).unwrap();
        let is_home = path.ends_with("crates/math/src/decimals.rs");
        let found = signs_of_their_own(&text);
        assert!(is_home || found.is_empty(), "{}: {found:?}: use math::signed", path.display());
    }
}
