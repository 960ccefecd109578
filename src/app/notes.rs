//! What the window has to say: what went wrong, what deserves attention, and what is done.

/// What is said, and how grave it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// In words that say what happened and what to do.
    pub text: String,
    /// Whether it is an error, by which something was not done.
    pub is_error: bool,
}

/// The last things said.
#[derive(Debug, Default)]
pub struct Notes {
    said: Option<String>,
    troubles: Vec<Problem>,
    /// Whether all troubles are listed, and not the last alone.
    pub is_open: bool,
}

/// The most troubles kept.
const MOST: usize = 50;

impl Notes {
    /// Says something that asks for nothing.
    pub fn say(&mut self, what: &str) {
        self.said = Some(what.to_owned());
    }

    /// Says what went wrong; it stays until it is dismissed.
    pub fn trouble(&mut self, what: String) {
        self.add(what, true);
    }

    /// Says what is done, though not as may have been meant; it stays until it is dismissed.
    pub fn warn(&mut self, what: String) {
        self.add(what, false);
    }

    fn add(&mut self, text: String, is_error: bool) {
        // What is said again is the last again.
        self.troubles.retain(|trouble| trouble.text != text);
        self.troubles.push(Problem { text, is_error });
        if self.troubles.len() > MOST {
            self.troubles.remove(0);
        }
    }

    /// The last thing said.
    pub fn said(&self) -> Option<&str> {
        self.said.as_deref()
    }

    /// What went wrong and what deserves attention, the oldest first.
    pub fn troubles(&self) -> &[Problem] {
        &self.troubles
    }

    /// Forgets one of the troubles.
    pub fn dismiss(&mut self, which: usize) {
        if which < self.troubles.len() {
            self.troubles.remove(which);
        }
        self.is_open &= !self.troubles.is_empty();
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        *self = Self::default();
    }
}
