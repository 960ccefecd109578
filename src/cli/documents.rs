//! Tests that the documents show commands, options, names and files that exist.

use super::{Arguments, parsed, spelt_out};
use brillianteer_cut::{Cut, FAMILIES, Family};
use brillianteer_files::library;
use brillianteer_picture::PictureName;
use clap::{Command, CommandFactory};
use shown_commands::{ShownCommand, commands, read};
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::path::Path;

#[path = "../../tests/common/shown_commands.rs"]
mod shown_commands;

/// The documents that show commands.
const DOCUMENTS: [&str; 7] = [
    "README.md",
    "docs/guide.md",
    "docs/cutting.md",
    "docs/editor.md",
    "docs/formats.md",
    "docs/gallery.md",
    "docs/performance.md",
];

/// Options of other programs that the documents name.
const FOREIGN_OPTIONS: [&str; 12] = [
    "--release",
    "--features",
    "--no-default-features",
    "--path",
    "--open",
    "--bin",
    "--example",
    "--locked",
    "--lib",
    "--test",
    "--ignored",
    "--nocapture",
];

/// Returns whether a word is the name of something that comes with the program or of a file of the repository. Files that a
/// reader has, such as design.asc or mine.toml, cannot be looked up.
fn exists(option: Option<&str>, word: &str) -> bool {
    let in_repository = ["docs/", "cuts/", "scenes/", "tests/"].iter().any(|folder| word.starts_with(folder));
    if in_repository {
        return Path::new(env!("CARGO_MANIFEST_DIR")).join(word).exists();
    }
    let is_file = word.contains('.') || word == "-";
    match option {
        Some("--material") => word.parse::<f64>().is_ok() || brillianteer_optics::material(word).is_ok(),
        Some("--light") => is_file || brillianteer_scene::light(word).is_some(),
        Some("--views") => word.split(',').all(|name| PictureName::of_key(name).is_some()),
        Some("--scope") => is_file || PictureName::of_key(word).is_some(),
        Some(_) => true,
        None => {
            is_file || library::cut(word).is_some() || library::scene(word).is_some() || word == "designs"
        }
    }
}

#[test]
fn commands_in_the_documents_are_understood_and_name_what_exists() {
    let mut count = 0;
    // The overview in the README has a test of its own.
    for ShownCommand { at, words, .. } in DOCUMENTS[1..].iter().flat_map(|document| commands(document)) {
        let line = words.join(" ");
        let given = std::iter::once("brillianteer").chain(words.iter().map(String::as_str));
        let given: Vec<OsString> = spelt_out(given.map(OsString::from).collect());
        if let Err(error) = parsed(&given) {
            panic!("{at}: {line}: {error}");
        }
        let lists_names =
            ["scopes", "lights", "scenes", "cuts", "families", "materials", "completions", "man", "help"];
        if !lists_names.contains(&words[0].as_str()) {
            let mut option: Option<&str> = None;
            for word in &words[1..] {
                let asked = option.filter(|option| takes_value(&words[0], option));
                let is_option = word.starts_with("--") || word.starts_with('-') && word.len() == 2;
                option = (asked.is_none() && is_option).then_some(word.as_str());
                assert!(option.is_some() || exists(asked, word), "{at}: {line}: there is no {word}");
            }
        }
        count += 1;
    }
    assert!(count > 60, "{count} commands");
}

/// Returns whether an option of a command is followed by a value.
fn takes_value(command: &str, option: &str) -> bool {
    let all = Arguments::command();
    let (Some(command), Some(long)) = (all.find_subcommand(command), option.strip_prefix("--")) else {
        return true;
    };
    let argument = command.get_arguments().find(|own| own.get_long() == Some(long));
    argument.is_none_or(|argument| argument.get_action().takes_values())
}

/// Returns the options of a command, and of those below it.
fn options(command: &Command) -> BTreeSet<String> {
    let own = command.get_arguments().filter_map(|own| own.get_long()).map(|long| format!("--{long}"));
    let mut all: BTreeSet<String> = own.collect();
    command.get_subcommands().for_each(|below| all.extend(options(below)));
    all
}

/// Returns the long options that a text names.
fn named_options(text: &str) -> impl Iterator<Item = &str> {
    text.match_indices("--").filter_map(|(at, _)| {
        let before = text[..at].chars().next_back();
        let name = text[at + 2..].split(|c: char| !c.is_ascii_lowercase() && c != '-').next()?;
        let is_begun = before.is_none_or(|c| matches!(c, '`' | ' ' | '('));
        (is_begun && name.starts_with(|c: char| c.is_ascii_lowercase()))
            .then(|| &text[at..at + 2 + name.len()])
    })
}

/// Returns the name by which a link finds a heading, as GitHub makes it.
fn anchor(heading: &str) -> String {
    let kept = |c: char| match c {
        ' ' => Some('-'),
        c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c.to_ascii_lowercase()),
        _ => None,
    };
    heading.trim_start_matches('#').trim().chars().filter_map(kept).collect()
}

/// Returns the places within the documents that a text links to.
fn links(text: &str) -> impl Iterator<Item = &str> {
    let after = text.match_indices("](").map(|(at, _)| &text[at + 2..]);
    let inside = after.filter_map(|rest| rest.split(')').next()).filter(|link| !link.is_empty());
    inside.filter(|link| !link.contains("://") && !link.contains(char::is_whitespace))
}

#[test]
fn links_in_the_documents_lead_to_files_and_headings_that_exist() {
    let further = ["architecture", "notes", "optics", "words"].map(|name| format!("docs/{name}.md"));
    let mut count = 0;
    for document in DOCUMENTS.map(str::to_owned).iter().chain(&further) {
        let text = read(document);
        let folder = document.rsplit_once('/').map_or("", |(folder, _)| folder);
        for link in links(&text) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let path = if file.is_empty() { document.clone() } else { format!("{folder}/{file}") };
            let path = path.trim_start_matches('/').trim_start_matches("docs/../").to_owned();
            let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join(&path);
            assert!(whole.exists(), "{document} links to {link}: there is no {path}");
            let is_there =
                |text: &str| text.lines().any(|line| line.starts_with('#') && anchor(line) == heading);
            assert!(
                heading.is_empty() || is_there(&read(&path)),
                "{document} links to {link}: no such heading"
            );
            count += 1;
        }
    }
    assert!(count > 200, "{count} links");
    assert_eq!(anchor("### GemCad text, `.asc`"), "gemcad-text-asc");
}

#[test]
fn options_that_the_documents_name_exist() {
    let mut known = options(&Arguments::command());
    known.extend(FOREIGN_OPTIONS.map(str::to_owned));
    known.extend(["--help", "--version"].map(str::to_owned));
    let mut count = 0;
    for document in DOCUMENTS {
        let text = read(document);
        for option in named_options(&text) {
            assert!(known.contains(option), "{document} names {option}, which no command takes");
            count += 1;
        }
    }
    assert!(count > 150, "{count} options");
}

#[test]
fn the_overview_in_the_readme_names_every_command_and_options_that_it_takes() {
    let all = Arguments::command();
    let text = read("README.md");
    let block = text.split("```").find(|block| block.contains("brillianteer [FILE]")).unwrap();
    let mut named = BTreeSet::new();
    for entry in block.split("\nbrillianteer ").skip(2) {
        let (synopsis, _) = entry.split_once("  ").unwrap_or((entry, ""));
        let names = synopsis.lines().next().unwrap_or_default().split(" | ");
        for name in names.filter_map(|part| part.split_whitespace().next()) {
            let command = all.find_subcommand(name).unwrap_or_else(|| panic!("no command {name}"));
            let options = options(command);
            named_options(entry).for_each(|option| assert!(options.contains(option), "{name} {option}"));
            named.insert(name.to_owned());
        }
    }
    let own = all.get_subcommands().filter(|command| !command.is_hide_set()).map(Command::get_name);
    let missing: Vec<&str> =
        own.filter(|name| !named.contains(*name) && !["edit", "man", "help"].contains(name)).collect();
    assert!(missing.is_empty(), "the README does not name {missing:?}");
}

#[test]
fn the_readme_counts_the_families_and_materials_that_there_are() {
    let text = read("README.md").split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("Twenty-three families") && text.contains("30 gem materials and 12 glasses"));
    assert_eq!(brillianteer_optics::materials().len(), 30 + 12);
    // Shapes of glass are families too, but no cuts of gems.
    let is_glass = |family: &&&Family| matches!(family.first, Cut::Glass(_));
    assert_eq!(FAMILIES.iter().filter(|family| !is_glass(family)).count(), 23);
}
