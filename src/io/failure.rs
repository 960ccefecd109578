//! Why work that ends in files was not done.

use super::atomic::WriteError;
use super::lighting::LightingError;
use crate::trace::Stopped;

/// Why not all that was asked for was done. Files that were finished before stay.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The input is at fault; in words that name it.
    #[error("{0}")]
    Input(String),
    /// What is asked for cannot be, whatever the input.
    #[error("{0}")]
    Usage(String),
    /// The output could not be written.
    #[error("{0}")]
    Output(String),
    /// No window could be opened: there is no screen, or nothing that draws on it; in words that say which.
    #[error("{0}")]
    NoWindow(String),
    /// The graphics card failed; the processor can do the same work.
    #[cfg(feature = "gpu")]
    #[error(transparent)]
    Card(#[from] crate::trace::gpu::GpuError),
    /// Stopped by who watches the work.
    #[error("stopped")]
    Stopped,
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        match error {
            WriteError::Stopped(_) => Self::Stopped,
            error @ WriteError::Io { .. } => Self::Output(error.to_string()),
        }
    }
}

impl From<LightingError> for Failure {
    fn from(error: LightingError) -> Self {
        match error {
            LightingError::Unknown(message) => Self::Usage(message),
            LightingError::File(message) => Self::Input(message),
        }
    }
}

impl From<Stopped> for Failure {
    fn from(_: Stopped) -> Self {
        Self::Stopped
    }
}
