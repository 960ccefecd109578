//! Checks the structure of the source: a room imports only from floors below its own.
#![allow(clippy::unwrap_used, reason = "a test fails by it")]

#[path = "floors/circles.rs"]
mod circles;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

const FLOORS: [(&str, u32); 11] = [
    ("math", 0),
    ("optics", 0),
    ("cut", 1),
    ("scene", 2),
    ("trace", 3),
    ("picture", 4),
    ("measure", 4),
    ("render", 5),
    ("io", 6),
    ("cli", 7),
    ("app", 7),
];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    entries
        .flat_map(|p| if p.is_dir() { sources(&p) } else { vec![p] })
        .filter(|p| p.extension().is_some_and(|e| e == "rs"))
        .collect()
}

/// Returns the rooms that a text imports from by `crate::room`, outside its comments.
fn imports(text: &str) -> Vec<&str> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or(""));
    let after = code.flat_map(|line| line.split("crate::").skip(1));
    after.map(|t| t.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("")).collect()
}

/// Whether a text that lies `steps` modules deep in its room leaves the room by `super`.
fn climbs_out(text: &str, steps: usize) -> bool {
    // Inside a file's `mod tests` one more step is needed to leave the room.
    let code = text.split("#[cfg(test)]").next().unwrap_or("");
    code.contains(&"super::".repeat(steps + 1))
}

fn floor(room: &str) -> Option<u32> {
    FLOORS.iter().find(|(name, _)| *name == room).map(|(_, floor)| *floor)
}

#[test]
fn no_floor_imports_from_its_own_or_a_higher_one() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut checked = 0;
    for path in sources(&src) {
        let inside = path.strip_prefix(&src).unwrap();
        let room = inside.iter().next().unwrap().to_string_lossy().replace(".rs", "");
        let Some(own) = floor(&room) else { continue };
        let text = std::fs::read_to_string(&path).unwrap();
        let steps = inside.iter().count() - 1 - usize::from(inside.ends_with("mod.rs"));
        assert!(!climbs_out(&text, steps), "{}: leaves its room by super::, not crate::", path.display());
        for other in imports(&text).into_iter().filter(|r| *r != room) {
            let Some(other_floor) = floor(other) else {
                panic!("{}: imports '{other}', no room", path.display())
            };
            assert!(
                other_floor < own,
                "{}: floor {own} imports {other}, floor {other_floor}",
                path.display()
            );
            checked += 1;
        }
    }
    assert!(checked > 30, "only {checked} imports were seen: the check has lost its eyes");
}

/// Returns the public types that a text declares outside its test modules.
fn public_types(text: &str) -> Vec<&str> {
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or("");
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
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut places = BTreeMap::<String, Vec<PathBuf>>::new();
    for path in sources(&src).into_iter().filter(|path| !path.iter().any(|part| part == "tests")) {
        let text = std::fs::read_to_string(&path).unwrap();
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

#[test]
fn an_import_that_runs_up_would_be_seen() {
    assert_eq!(imports("use crate::picture::Film; use crate::io; // and crate::cli"), ["picture", "io"]);
    assert!(climbs_out("use super::super::io::write;", 1) && !climbs_out("use super::Film;", 1));
    assert!(floor("picture") > floor("trace"));
    assert_eq!(floor("main"), None);
}

/// Returns what a text of the editor's model names that no model may: the window, or what threads share.
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
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/app/model");
    let paths = sources(&model);
    assert!(paths.len() > 20, "only {} files were seen: the check has lost its eyes", paths.len());
    for path in paths {
        let named = windows(&std::fs::read_to_string(&path).unwrap());
        assert!(named.is_empty(), "{}: names {named:?}", path.display());
    }
    assert_eq!(windows("use egui::Ui; struct A(Arc<Mutex<u8>>);"), ["egui", "Arc<Mutex"]);
    assert!(windows("regui(); // as egui does").is_empty());
}
