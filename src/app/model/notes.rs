//! The messages of the window: errors, warnings, and notes on what is done.

use std::fmt::Display;

/// An error or a warning.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// The text, which says what happened and what to do.
    pub text: String,
    /// Whether this is an error: something was not done.
    pub is_error: bool,
}

/// The last messages.
#[derive(Debug, Clone, Default)]
pub struct Notes {
    said: Option<String>,
    troubles: Vec<Problem>,
    /// Whether all errors and warnings are listed, and not the last alone.
    pub is_open: bool,
}

/// The greatest number of errors and warnings that are kept.
const MOST: usize = 50;

impl Notes {
    /// Shows a note that needs no answer.
    pub fn say(&mut self, what: &str) {
        self.said = Some(what.to_owned());
    }

    /// Reports an error; it stays until it is dismissed.
    pub fn trouble(&mut self, what: impl Display) {
        self.add(what.to_string(), true);
    }

    /// Returns the value of a result; reports its error instead.
    pub fn ok_or_report<T>(&mut self, result: Result<T, impl Display>) -> Option<T> {
        result.map_err(|why| self.trouble(why)).ok()
    }

    /// Warns that something is done, but perhaps not as it was meant; the warning stays until it is dismissed.
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
