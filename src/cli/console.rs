//! The program's output: results on standard output; notes, warnings and errors on standard error.

use brillianteer_base::Failure;
use brillianteer_files::is_standard;
use brillianteer_paper::export::Event;
use serde::Serialize;
use std::borrow::Cow;
use std::path::Path;

/// The name of standard output, with which the message begins where it cannot be written.
pub const STANDARD_OUTPUT: &str = "standard output";

/// Prints a line to standard error. Failures to write are ignored.
pub fn say(text: &str) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr().lock(), "{}", harmless(text));
}

/// Returns text without control characters but line breaks and tabs: a message may quote a file, and a terminal would obey
/// what the file says.
fn harmless(text: &str) -> Cow<'_, str> {
    let is_command = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    if text.contains(is_command) { text.replace(is_command, "\u{fffd}").into() } else { text.into() }
}

/// Prints an event of long work: the paths of written files to standard output, notes and warnings to standard error.
pub fn report(event: Event) -> Result<(), Failure> {
    match event {
        Event::Begun(_) => {}
        Event::Written(path) => return written(path),
        Event::Note(text) => say(&format!("note: {text}")),
        Event::Warning(text) => say(&format!("warning: {text}")),
    }
    Ok(())
}

/// Prints the path of a file that was written. Prints nothing for standard output, which got the content itself.
pub fn written(path: &Path) -> Result<(), Failure> {
    if is_standard(path) { Ok(()) } else { print(&path.display().to_string()) }
}

/// Says on standard error that a file was written: where standard output has JSON (`is_json`), a path would break it. Otherwise
/// prints the path as [`written`] does.
pub fn written_beside(is_json: bool, path: &Path) -> Result<(), Failure> {
    if is_json {
        if !is_standard(path) {
            say(&format!("wrote {}", path.display()));
        }
        Ok(())
    } else {
        written(path)
    }
}

/// Prints a note that a folder was missing and has been made.
pub fn made_folder(folder: &Path) {
    say(&format!("note: the folder {} was missing and has been made", folder.display()));
}

/// Prints text and a line break to standard output. A reader that has closed the pipe (`| head`) is not an error.
pub fn print(text: &str) -> Result<(), Failure> {
    use std::io::{ErrorKind, Write};
    match writeln!(std::io::stdout().lock(), "{text}") {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Output(format!("{STANDARD_OUTPUT}: {e}")))
        }
        _ => Ok(()),
    }
}

/// A result of one file: an object that begins with the key `file`.
#[derive(Debug, Serialize)]
pub struct OfFile<'a, T> {
    pub file: &'a str,
    #[serde(flatten)]
    pub result: T,
}

/// Prints a result as indented JSON.
pub fn print_json(result: &impl Serialize) -> Result<(), Failure> {
    print(&serde_json::to_string_pretty(result).map_err(no_json)?)
}

/// Prints a result as JSON on one line.
pub fn print_json_line(result: &impl Serialize) -> Result<(), Failure> {
    print(&json_line(result)?)
}

/// Returns a result as JSON on one line, without its line break.
pub fn json_line(result: &impl Serialize) -> Result<String, Failure> {
    serde_json::to_string(result).map_err(no_json)
}

fn no_json(error: serde_json::Error) -> Failure {
    Failure::Output(format!("{STANDARD_OUTPUT}: {error}"))
}

#[cfg(test)]
mod tests {
    use super::harmless;

    #[test]
    fn a_message_that_quotes_a_file_gives_a_terminal_no_commands() {
        assert_eq!(harmless("a\u{1b}[2Jb\u{9b}0m\0\r c"), "a\u{fffd}[2Jb\u{fffd}0m\u{fffd}\u{fffd} c");
        assert!(matches!(harmless("Brücke: 1\t2\n3"), std::borrow::Cow::Borrowed(_)));
    }
}
