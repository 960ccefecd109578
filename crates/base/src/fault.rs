//! Errors in files that a person wrote or chose: the file, the place of the fault in it, and the remedy; and the reasons why work that
//! produces files was not done.

use crate::Stopped;
use std::fmt::Display;

/// The most characters of a message; a longer one, which quotes a long text, is cut.
const LONGEST: usize = 600;

/// An error in a file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{path}{}: {fault}", .fault.line.map(|line| format!(":{line}")).unwrap_or_default())]
pub struct FileError {
    /// The path of the file as the caller gave it, or the name of a file that comes with the program.
    pub path: String,
    /// The fault in the file, with its place.
    pub fault: Fault,
}

/// A fault in the content of a file, with its place.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{problem}")]
pub struct Fault {
    /// The line at fault, from 1; `None` where the file as a whole is at fault or has no lines.
    pub line: Option<usize>,
    /// The key at fault as a path, such as `plane/17/normal`, or a part of a file without keys, such as `triangle 5`.
    pub key: Option<String>,
    /// The description of the fault, which names the key or part, and says what to do.
    pub problem: String,
}

impl FileError {
    /// Makes the error of a file as a whole.
    pub fn new(path: impl Display, problem: impl Display) -> Self {
        Fault::whole(problem).in_file(path)
    }
}

/// The reason why a light or a background, which has a name or a file, could not be loaded.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NameOrFileError {
    /// The text is neither a known name nor a file; the message lists the known names.
    #[error("{0}")]
    Unknown(String),
    /// The file is at fault.
    #[error(transparent)]
    File(#[from] FileError),
}

impl From<String> for Fault {
    fn from(problem: String) -> Self {
        Self::whole(problem)
    }
}

impl From<&str> for Fault {
    fn from(problem: &str) -> Self {
        Self::whole(problem)
    }
}

impl Fault {
    /// Makes a fault of the file as a whole.
    pub fn whole(problem: impl Display) -> Self {
        Self { line: None, key: None, problem: problem.to_string() }
    }

    /// Makes a fault of a line.
    pub fn line(line: usize, problem: impl Display) -> Self {
        Self { line: Some(line), ..Self::whole(problem) }
    }

    /// Makes a fault of the value at a key's path, or of the enclosing value where that value is missing. The problem
    /// names the key in a person's words.
    pub fn key(key: impl Display, problem: impl Display) -> Self {
        Self { key: Some(key.to_string()), ..Self::whole(problem) }
    }

    /// Makes a fault of a part of a file without keys, such as a triangle or a byte's offset.
    pub fn part(part: impl Display, problem: impl Display) -> Self {
        Self::key(&part, format!("{part}: {problem}"))
    }

    /// Returns the same fault for a part of something else: `path` comes before its key, and `words` before its
    /// problem.
    pub fn within(self, path: &str, words: &str) -> Self {
        let key = self.key.map(|key| path.to_owned() + &key);
        Self { key, problem: words.to_owned() + &self.problem, ..self }
    }

    /// Adds the name of the file. The message becomes one line, cut to a readable length.
    pub fn in_file(self, path: impl Display) -> FileError {
        let mut problem = self.problem;
        if problem.contains(['\n', '\r']) {
            problem = problem.split_whitespace().collect::<Vec<_>>().join(" ");
        }
        if let Some((end, _)) = problem.char_indices().nth(LONGEST) {
            problem = format!("{} ...", &problem[..end]);
        }
        FileError { path: path.to_string(), fault: Self { problem, ..self } }
    }
}

/// The reason why a request was not carried out in full. Files that were finished before stay.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// The input is at fault; the message names it.
    #[error("{0}")]
    Input(String),
    /// The request cannot be carried out, whatever the input.
    #[error("{0}")]
    Usage(String),
    /// The output could not be written.
    #[error("{0}")]
    Output(String),
    /// No window could be opened, because there is no screen or no painter for it; the message says which.
    #[error("{0}")]
    NoWindow(String),
    /// The caller's watch has stopped the work.
    #[error("stopped")]
    Stopped,
}

impl From<NameOrFileError> for Failure {
    fn from(error: NameOrFileError) -> Self {
        match error {
            NameOrFileError::Unknown(message) => Self::Usage(message),
            NameOrFileError::File(error) => error.into(),
        }
    }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<Stopped> for Failure {
    fn from(_: Stopped) -> Self {
        Self::Stopped
    }
}
