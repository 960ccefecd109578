//! The error of a text that names no quality or overlay.

/// The reason why a text names no quality or overlay; the message lists the names.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NameError {
    /// The text names no quality of liquid glass.
    #[error("give high, medium or low")]
    Quality,
    /// The text names no overlay.
    #[error("no overlay '{}'; known: {known}", start(.asked))]
    Overlay {
        /// The text.
        asked: String,
        /// The known names.
        known: String,
    },
}

/// Returns a text, cut to a readable length.
fn start(text: &str) -> String {
    text.chars().take(30).collect()
}
