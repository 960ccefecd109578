//! The reasons why work that produces files was not done.

use super::atomic::WriteError;
use brillianteer_base::Stopped;
use brillianteer_base::{FileError, NameOrFileError};
use brillianteer_render::{RenderError, Unfit};

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

impl Failure {
    /// Makes the error of a job that its tracer cannot do; it names the file where the file is at fault.
    pub fn of_unfit(why: &Unfit, file: &str) -> Self {
        match why {
            Unfit::Eye => Self::Input(format!("{file}: {why}")),
            Unfit::NotConvex(_) => Self::Usage(format!("{file}: {why}")),
            _ => Self::Usage(why.to_string()),
        }
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        match error {
            WriteError::Stopped(_) => Self::Stopped,
            error @ WriteError::Io { .. } => Self::Output(error.to_string()),
        }
    }
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

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Stopped(stopped) => stopped.into(),
            #[cfg(feature = "gpu")]
            RenderError::Card(error) => Self::Output(error.to_string()),
            RenderError::Unfit(_) | RenderError::Pane(_) | RenderError::OtherProduct => {
                Self::Usage(error.to_string())
            }
        }
    }
}
