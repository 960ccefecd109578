//! The reasons why work that produces files was not done.

use crate::{FileError, NameOrFileError, Stopped};

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
