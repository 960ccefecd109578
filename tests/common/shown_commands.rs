//! The commands in the blocks of documents.
#![allow(dead_code, reason = "each test uses its part")]

use std::path::Path;

/// A command in a block of a document.
pub struct ShownCommand {
    /// The document and the line.
    pub at: String,
    /// The words behind the program's name, without what a shell would make of its end.
    pub words: Vec<String>,
    /// The file that standard output goes to.
    pub to: Option<String>,
    /// The file that standard input comes from.
    pub from: Option<String>,
}

/// Returns the text of a document of the repository.
pub fn read(document: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(document);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Returns the commands in the blocks of a document.
pub fn commands(document: &str) -> Vec<ShownCommand> {
    let text = read(document).replace("\\\n", " ");
    let mut found = vec![];
    let mut in_block = false;
    for (number, line) in (1..).zip(text.lines()) {
        in_block ^= line.starts_with("```");
        let rest = line.trim_start().strip_prefix("brillianteer ").filter(|_| in_block);
        found.extend(rest.map(|rest| shown(rest, format!("{document}, near line {number}"))));
    }
    found
}

/// Divides a command into words, up to a comment or a pipe. A pair of quotes makes one word.
pub fn shown(line: &str, at: String) -> ShownCommand {
    let mut words = vec![];
    for (number, part) in line.split('"').enumerate() {
        match number % 2 {
            0 => words.extend(part.split_whitespace().map(str::to_owned)),
            _ => words.push(part.to_owned()),
        }
    }
    let (mut kept, mut to, mut from) = (vec![], None, None);
    let mut words = words.into_iter();
    while let Some(word) = words.next() {
        match word.as_str() {
            "#" | "|" => break,
            ">" => to = words.next(),
            "<" => from = words.next(),
            _ => kept.push(word),
        }
    }
    ShownCommand { at, words: kept, to, from }
}
