//! Files that are either written whole or not at all.

use crate::trace::Stopped;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Why a file was not written. Nothing of it is left behind.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The file system refused.
    #[error("{path}: cannot write: {source}")]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The work was stopped.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

impl WriteError {
    /// The file system's refusal to write `path`.
    pub fn io(path: &Path, source: impl Into<io::Error>) -> Self {
        Self::Io { path: path.into(), source: source.into() }
    }
}

/// Writes a file under a temporary name beside it, and renames it when `fill` has filled it without error. Missing
/// folders are made.
///
/// # Errors
/// When the file system refuses, or with what `fill` answers.
pub fn write<E: From<WriteError>>(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<&mut NamedTempFile>) -> Result<(), E>,
) -> Result<(), E> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(|e| match e.kind() {
        io::ErrorKind::AlreadyExists | io::ErrorKind::NotADirectory => {
            WriteError::io(folder, io::Error::new(e.kind(), "this is a file, and a folder is needed"))
        }
        _ => WriteError::io(folder, e),
    })?;
    let mut temporary = new_file(folder).map_err(|e| WriteError::io(path, e.kind()))?;
    let mut buffer = BufWriter::with_capacity(1 << 16, &mut temporary);
    fill(&mut buffer)?;
    buffer.flush().map_err(|e| WriteError::io(path, e))?;
    drop(buffer);
    temporary.persist(path).map_err(|e| WriteError::io(path, e.error))?;
    Ok(())
}

fn new_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".brillianteer-");
    // Temporary files are private by default; these are to become ordinary ones.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_fails_half_way_leaves_the_old_one_and_no_trace() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/er/a.txt");
        write(&path, |w| w.write_all(b"old").map_err(|e| WriteError::io(&path, e))).unwrap();
        let failed = write(&path, |w| {
            w.write_all(b"half").map_err(|e| WriteError::io(&path, e))?;
            Err(WriteError::Stopped(Stopped))
        });
        assert!(matches!(failed, Err(WriteError::Stopped(_))));
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_in_the_way_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let error = write(folder.path(), |_| Ok::<(), WriteError>(())).unwrap_err().to_string();
        assert!(error.contains(folder.path().to_str().unwrap()), "{error}");
    }
}
