//! Why a text names nothing of what pictures have.

/// Why a text names no tone, quality, overlay or background; the message says what does.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NameError {
    /// The text names no tone.
    #[error("tone '{}': give neutral, filmic or linear", start(.0))]
    Tone(String),
    /// The text names no quality of liquid glass.
    #[error("give high, medium or low")]
    Quality,
    /// The text names no overlay.
    #[error("no overlay '{}'; known: {known}", start(.asked))]
    Overlay {
        /// The text.
        asked: String,
        /// The names that are known.
        known: String,
    },
    /// The text names no colour, and no gradient of two.
    #[error(
        "background '{}': give transparent, black, white, grey, a colour such as #20262e, or two, top-bottom, such as \
         #404850-#101215",
        start(.0)
    )]
    Background(String),
}

/// Returns as much of a text as a person reads.
fn start(text: &str) -> String {
    text.chars().take(30).collect()
}
