//! What the window has to say: what went wrong, and what is done.

/// The last things said.
#[derive(Debug, Default)]
pub struct Notes {
    said: Option<String>,
    trouble: Vec<String>,
}

/// The most troubles shown at once.
const MOST: usize = 4;

impl Notes {
    /// Says something that asks for nothing.
    pub fn say(&mut self, what: &str) {
        self.said = Some(what.to_owned());
    }

    /// Says what went wrong; it stays until it is dismissed.
    pub fn trouble(&mut self, what: String) {
        if !self.trouble.contains(&what) {
            self.trouble.push(what);
        }
        if self.trouble.len() > MOST {
            self.trouble.remove(0);
        }
    }

    /// The last thing said.
    pub fn said(&self) -> Option<&str> {
        self.said.as_deref()
    }

    /// What went wrong, the oldest first.
    pub fn troubles(&self) -> &[String] {
        &self.trouble
    }

    /// Forgets one of the troubles.
    pub fn dismiss(&mut self, which: usize) {
        if which < self.trouble.len() {
            self.trouble.remove(which);
        }
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        *self = Self::default();
    }
}
