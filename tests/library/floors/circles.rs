//! Checks that no circle of imports holds more than three files.
//!
//! A file imports from the file in which the item lies: `pub use` is a second name, and no import.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The greatest number of files in a circle.
const MOST: usize = 3;

/// A module by its path from the crate, such as `["io", "export"]`.
type ModulePath = Vec<String>;

/// The imports of a file.
#[derive(Default)]
struct Imports {
    /// The paths that the file imports or names.
    used: Vec<ModulePath>,
    /// The second names that the file gives, with the paths that they stand for.
    names: BTreeMap<String, ModulePath>,
}

/// Returns the text without comments.
fn code(text: &str) -> String {
    super::untested(text)
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""))
        .collect::<Vec<_>>()
        .join("\n")
}

/// Returns the paths of a `use` tree such as `a::{b, c::{d, e}}`.
fn expanded(tree: &str) -> Vec<String> {
    let Some((before, body)) = tree.split_once('{') else {
        return vec![tree.split(" as ").next().unwrap_or("").trim().to_owned()];
    };
    let body = body.rsplit_once('}').map_or(body, |(body, _)| body);
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for letter in body.chars() {
        depth += i32::from(letter == '{') - i32::from(letter == '}');
        match parts.last_mut() {
            Some(part) if letter != ',' || depth > 0 => part.push(letter),
            _ => parts.push(String::new()),
        }
    }
    let parts = parts.iter().map(|part| part.trim()).filter(|part| !part.is_empty());
    parts.flat_map(|part| expanded(&format!("{}{part}", before.trim()))).collect()
}

/// Returns a path from the crate; `None` where it leads out of the crate.
fn absolute(module: &[String], path: &str, files: &BTreeSet<ModulePath>) -> Option<ModulePath> {
    let mut parts: Vec<String> = path.split("::").map(|part| part.trim().to_owned()).collect();
    let mut base = module.to_vec();
    match parts.first().map(String::as_str) {
        Some("crate") => base.clear(),
        Some("self") => {}
        Some("super") => {
            while parts.first().is_some_and(|part| part == "super") {
                base.pop();
                parts.remove(0);
            }
            base.extend(parts);
            return Some(base);
        }
        Some(first) if files.contains(&[module, &[first.to_owned()]].concat()) => {
            base.extend(parts);
            return Some(base);
        }
        _ => return None,
    }
    base.extend(parts.into_iter().skip(1));
    Some(base)
}

/// Returns the paths that a text names outside its `use` declarations.
fn named(text: &str) -> Vec<String> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let words = text.split(|c: char| !is_part(c)).map(|word| word.trim_matches(':'));
    words.filter(|word| word.contains("::")).map(str::to_owned).collect()
}

fn imports(module: &[String], text: &str, files: &BTreeSet<ModulePath>) -> Imports {
    let mut imports = Imports::default();
    let mut rest = String::new();
    for statement in code(text).split_inclusive(';') {
        let Some((before, tree)) = statement.rsplit_once("use ").filter(|(before, _)| {
            let line = before.rsplit('\n').next().unwrap_or("").trim();
            line.is_empty() || (line.starts_with("pub") && !line.contains(['{', '=']))
        }) else {
            rest.push_str(statement);
            continue;
        };
        rest.push_str(before);
        let is_public = before.rsplit('\n').next().unwrap_or("").contains("pub");
        for path in expanded(tree.trim_end_matches(';')) {
            let Some(path) = absolute(module, &path, files) else { continue };
            match path.last().cloned().filter(|_| is_public) {
                Some(name) => drop(imports.names.insert(name, path)),
                None => imports.used.push(path),
            }
        }
    }
    imports.used.extend(named(&rest).iter().filter_map(|path| absolute(module, path, files)));
    imports
}

/// Returns the file in which the item at the end of a path lies.
fn resolved(path: &[String], all: &BTreeMap<ModulePath, Imports>, steps: usize) -> ModulePath {
    let count = (0..=path.len()).rev().find(|&count| all.contains_key(&path[..count])).unwrap_or(0);
    let (module, rest) = path.split_at(count);
    let alias = rest.first().and_then(|name| all.get(module)?.names.get(name));
    match alias.filter(|_| steps > 0) {
        Some(other) => resolved(other, all, steps - 1),
        None => module.to_vec(),
    }
}

/// Returns the circles of a graph that hold more than [`MOST`] files.
fn circles(graph: &BTreeMap<ModulePath, BTreeSet<ModulePath>>) -> Vec<BTreeSet<ModulePath>> {
    let reached = |from: &ModulePath| {
        let (mut seen, mut next) = (BTreeSet::new(), vec![from]);
        while let Some(file) = next.pop() {
            let others = graph.get(file).into_iter().flatten();
            next.extend(others.filter(|other| seen.insert((*other).clone())));
        }
        seen
    };
    let all: BTreeMap<_, _> = graph.keys().map(|file| (file, reached(file))).collect();
    let circle = |file: &ModulePath| -> BTreeSet<ModulePath> {
        all[file]
            .iter()
            .filter(|other| all.get(other).is_some_and(|back| back.contains(file)))
            .cloned()
            .collect()
    };
    let circles: BTreeSet<_> = graph.keys().map(circle).filter(|circle| circle.len() > MOST).collect();
    circles.into_iter().collect()
}

/// Returns the graph of files by their imports, of texts by their modules.
fn graph(texts: &BTreeMap<ModulePath, String>) -> BTreeMap<ModulePath, BTreeSet<ModulePath>> {
    let files: BTreeSet<ModulePath> = texts.keys().cloned().collect();
    let all: BTreeMap<ModulePath, Imports> =
        texts.iter().map(|(module, text)| (module.clone(), imports(module, text, &files))).collect();
    let others = |(module, imports): (&ModulePath, &Imports)| {
        let others = imports.used.iter().map(|path| resolved(path, &all, 8));
        (module.clone(), others.filter(|other| other != module && !other.is_empty()).collect())
    };
    all.iter().map(others).collect()
}

fn module(inside: &Path) -> ModulePath {
    let mut parts: ModulePath =
        inside.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
    parts.pop_if(|last| last == "mod" || last == "lib");
    parts
}

/// Returns the circles of more than [`MOST`] files in a crate, in words, and the number of imports that were seen.
fn circles_of(src: &Path) -> (Vec<String>, usize) {
    let paths = super::sources(src).into_iter().filter(|path| !path.iter().any(|part| part == "tests"));
    let texts = paths.filter(|path| !path.ends_with("tests.rs") && !path.ends_with("main.rs")).map(|path| {
        let text = std::fs::read_to_string(&path).unwrap();
        (module(path.strip_prefix(src).unwrap()), text)
    });
    let graph = graph(&texts.collect());
    let listed = |circle: &BTreeSet<ModulePath>| {
        let lines = circle.iter().map(|file| {
            let others: Vec<String> = graph[file]
                .iter()
                .filter(|other| circle.contains(*other))
                .map(|other| other.join("::"))
                .collect();
            format!("  {} imports {}\n", file.join("::"), others.join(", "))
        });
        format!(
            "{}: {} files import one another:\n{}",
            src.display(),
            circle.len(),
            lines.collect::<String>()
        )
    };
    let count = graph.values().map(BTreeSet::len).sum();
    (circles(&graph).iter().map(listed).collect(), count)
}

#[test]
fn no_circle_of_imports_holds_more_than_three_files() {
    let found: Vec<(Vec<String>, usize)> = super::crates().iter().map(|folder| circles_of(folder)).collect();
    let count: usize = found.iter().map(|(_, count)| count).sum();
    assert!(count > 500, "only {count} imports were seen: the check overlooks most of them");
    let circles: String = found.into_iter().flat_map(|(circles, _)| circles).collect();
    assert!(circles.is_empty(), "{circles}");
}

#[test]
fn a_circle_of_four_would_be_seen_and_second_names_are_seen_through() {
    let texts = |last: &str| -> BTreeMap<ModulePath, String> {
        [
            ("a", "use crate::b::{B, c};\nmod d;"),
            ("b", "pub use c::C;\nmod c;\nuse super::a::A as Other;"),
            ("b/c", "use std::fs; fn f() -> crate::a::d::D {}"),
            ("a/d", last),
        ]
        .map(|(path, text)| (module(Path::new(path)), text.to_owned()))
        .into()
    };
    let four = circles(&graph(&texts("use crate::{b::{C, B}, other};")));
    assert_eq!(four.iter().map(BTreeSet::len).collect::<Vec<_>>(), [4]);
    // By its second name `c::C` is all that `d` imports, which leads back to nobody but `d`.
    assert!(circles(&graph(&texts("use crate::b::C;"))).is_empty());
    assert!(circles(&graph(&texts("#[cfg(test)]\nmod tests { use crate::b::B; }"))).is_empty());
}
