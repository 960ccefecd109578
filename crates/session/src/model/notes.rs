//! The messages of the window: errors, warnings, and notes about completed work.

use std::fmt::Display;

/// An error or a warning.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// The text, which says what happened and what to do.
    pub text: String,
    /// True for an error, by which something was not done; false for a warning.
    pub is_error: bool,
}

/// The last messages.
#[derive(Debug, Clone, Default)]
pub struct Notes {
    said: Option<String>,
    /// True where the note belongs to what was done last.
    is_fresh: bool,
    troubles: Vec<Problem>,
    /// True where all errors and warnings are listed, and not only the last.
    pub is_open: bool,
}

/// The greatest number of errors and warnings that are kept.
const MOST: usize = 50;

impl Notes {
    /// Shows a note that the user need not dismiss.
    pub fn say(&mut self, what: &str) {
        (self.said, self.is_fresh) = (Some(what.to_owned()), true);
    }

    /// Ends what was done last: a note of what was done before it is no longer true where the work has `changed` since.
    pub fn settle(&mut self, changed: bool) {
        if changed && !self.is_fresh {
            self.said = None;
        }
        self.is_fresh = false;
    }

    /// Reports an error; it stays until it is dismissed.
    pub fn trouble(&mut self, what: impl Display) {
        self.add(what.to_string(), true);
    }

    /// Returns the value of a result, or reports its error and returns `None`.
    pub fn ok_or_report<T>(&mut self, result: Result<T, impl Display>) -> Option<T> {
        result.map_err(|why| self.trouble(why)).ok()
    }

    /// Adds a warning about work that was done, but perhaps not as the user meant; it stays until it is dismissed.
    pub fn warn(&mut self, what: String) {
        self.add(what, false);
    }

    fn add(&mut self, text: String, is_error: bool) {
        // A message that is repeated becomes the last one.
        self.troubles.retain(|trouble| trouble.text != text);
        self.troubles.push(Problem { text, is_error });
        if self.troubles.len() > MOST {
            self.troubles.remove(0);
        }
    }

    /// Returns the last note.
    pub fn said(&self) -> Option<&str> {
        self.said.as_deref()
    }

    /// Returns the errors and warnings, the oldest first.
    pub fn troubles(&self) -> &[Problem] {
        &self.troubles
    }

    /// Removes one of the errors and warnings.
    pub fn dismiss(&mut self, which: usize) {
        if which < self.troubles.len() {
            self.troubles.remove(which);
        }
        self.is_open &= !self.troubles.is_empty();
    }

    /// Removes all messages.
    pub fn clear(&mut self) {
        *self = Self::default();
    }
}
