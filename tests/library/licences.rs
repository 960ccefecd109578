//! Checks that the list of crates in the editor's About window is that of the crates that the program is built of, each with an
//! accepted licence. `cargo run -p xtask -- crates` writes the list.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const LIST: &str = "assets/crates.tsv";

/// The accepted licences, which demand no more than to be named.
const ACCEPTED: [&str; 17] = [
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "MPL-2.0",
    "NCSA",
    "OFL-1.1",
    "Ubuntu-font-1.0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

fn read(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

/// The beginning of the names of the program's own crates.
const OWN: &str = "brillianteer";

/// Returns the names of the crates that one of the program's own crates names as dependencies, but not those of its tests.
fn named_by(own: &str) -> BTreeSet<String> {
    let folder = own.strip_prefix("brillianteer-").map_or(String::new(), |name| format!("crates/{name}/"));
    let manifest: toml::Table = read(&format!("{folder}Cargo.toml")).parse().unwrap();
    // Some dependencies are for one kind of system only.
    let systems = manifest.get("target").and_then(|t| t.as_table()).into_iter().flat_map(|t| t.values());
    let tables = systems.filter_map(|system| system.get("dependencies")).chain(manifest.get("dependencies"));
    tables.filter_map(|table| table.as_table()).flat_map(|table| table.keys().cloned()).collect()
}

/// Returns the names and versions of all crates that the program needs, whatever the platform and the features: those that
/// Cargo.lock reaches from its own crates, without those of tests.
fn needed() -> BTreeSet<(String, String)> {
    let lock: toml::Table = read("Cargo.lock").parse().unwrap();
    let text = |value: &toml::Value, key: &str| {
        value.get(key).and_then(|v| v.as_str()).unwrap_or_default().to_owned()
    };
    let mut known: BTreeMap<(String, String), Vec<String>> = BTreeMap::new();
    for package in lock["package"].as_array().unwrap() {
        let name = text(package, "name");
        let entries = package.get("dependencies").and_then(|d| d.as_array()).cloned().unwrap_or_default();
        let mut entries: Vec<String> =
            entries.iter().map(|entry| entry.as_str().unwrap().to_owned()).collect();
        if name.starts_with(OWN) {
            let direct = named_by(&name);
            entries.retain(|entry| direct.contains(entry.split(' ').next().unwrap()));
        }
        known.insert((name, text(package, "version")), entries);
    }
    let mut open = known.iter().find(|((name, _), _)| name == OWN).unwrap().1.clone();
    let mut found = BTreeSet::new();
    while let Some(entry) = open.pop() {
        // An entry has a version only where the crate occurs in several.
        let (name, version) = entry.split_once(' ').map_or((entry.as_str(), None), |(n, v)| (n, Some(v)));
        let crates = known.keys().filter(|(n, v)| n == name && version.is_none_or(|wanted| wanted == v));
        for key in crates.cloned().collect::<Vec<_>>() {
            if found.insert(key.clone()) {
                open.extend(known[&key].iter().cloned());
            }
        }
    }
    found.retain(|(name, _)| !name.starts_with(OWN));
    found
}

/// Returns the rows of the list: name, version, licence, link.
fn listed() -> Vec<[String; 4]> {
    let cells = |line: &str| line.split('\t').map(str::to_owned).collect::<Vec<_>>();
    read(LIST).lines().map(|line| cells(line).try_into().unwrap()).collect()
}

/// Returns whether a licence, or one of the licences of a choice, is accepted. Brackets stand only around choices.
fn is_accepted(expression: &str) -> bool {
    let parts = split(expression, " AND ");
    if parts.len() > 1 {
        return parts.iter().all(|part| is_accepted(part));
    }
    let parts = split(expression, " OR ");
    if parts.len() > 1 {
        return parts.iter().any(|part| is_accepted(part));
    }
    match expression.strip_prefix('(').and_then(|e| e.strip_suffix(')')) {
        Some(inner) => is_accepted(inner),
        None => ACCEPTED.contains(&expression),
    }
}

/// Splits an expression at a word, except inside brackets.
fn split<'a>(expression: &'a str, word: &str) -> Vec<&'a str> {
    let (mut parts, mut begin, mut depth) = (vec![], 0, 0);
    for (at, c) in expression.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ if depth == 0 && expression[at..].starts_with(word) => {
                parts.push(&expression[begin..at]);
                begin = at + word.len();
            }
            _ => {}
        }
    }
    parts.push(&expression[begin..]);
    parts
}

#[test]
fn the_list_of_licences_is_current() {
    let needed = needed();
    assert!(needed.len() > 200, "{} crates", needed.len());
    let listed: BTreeSet<(String, String)> =
        listed().into_iter().map(|[name, version, ..]| (name, version)).collect();
    let missing: Vec<_> = needed.difference(&listed).collect();
    let gone: Vec<_> = listed.difference(&needed).collect();
    let what = "run cargo run -p xtask -- crates";
    assert!(missing.is_empty() && gone.is_empty(), "missing: {missing:?}; not needed: {gone:?}; {what}");
}

#[test]
fn every_licence_lets_the_program_be_given_on() {
    for [name, version, licence, _] in listed() {
        assert!(is_accepted(&licence), "{name} {version}: {licence}");
    }
    assert!(
        is_accepted("(MIT OR GPL-3.0) AND Unicode-3.0")
            && !is_accepted("MIT AND GPL-3.0")
            && !is_accepted("")
    );
}
