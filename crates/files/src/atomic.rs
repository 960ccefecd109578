//! Writes files either whole or not at all.

use super::overwriting::{self, Existing};
use super::standard::is_standard;
use brillianteer_base::{Failure, Stopped};
use std::collections::BTreeSet;
use std::convert::Infallible;
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use tempfile::{NamedTempFile, SpooledTempFile};

/// The reason why a file was not written. No part of it is left behind.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The file system refused.
    #[error("{path}: cannot write: {source}")]
    Io {
        /// The path of the file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The work was stopped.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

impl WriteError {
    /// Makes the error of a file system that refuses to write `path`.
    pub fn io(path: &Path, source: impl Into<io::Error>) -> Self {
        Self::Io { path: path.into(), source: source.into() }
    }
}

impl From<Infallible> for WriteError {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}

/// A seekable writer that takes a file's content.
pub trait Sink: Write + Seek {}

impl<T: Write + Seek> Sink for T {}

/// The most symbolic links that are followed one after the other; Linux gives up at as many.
const MOST_LINKS: usize = 40;

/// Content for a pipe or a device is kept in memory up to this many bytes, and beyond that in a file without a name.
const KEPT: usize = 16 << 20;

/// The function that is told of each folder that is made.
static ON_FOLDER: OnceLock<fn(&Path)> = OnceLock::new();

/// Has `report` told of each missing folder that is made for a file, from now on, in every thread. Only the first call in a
/// process counts.
pub fn report_made_folders(report: fn(&Path)) {
    let _ = ON_FOLDER.set(report);
}

/// The temporary files of all writes that are under way.
static UNDER_WAY: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn under_way() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNDER_WAY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A guard that keeps all writes from beginning or ending while it lives; see [`abandon_writes`].
#[derive(Debug)]
pub struct Abandoned(
    #[expect(dead_code, reason = "the lock is held by it")] MutexGuard<'static, BTreeSet<PathBuf>>,
);

/// Removes the temporary files of all writes that are under way, in every thread, for a program that is about to end.
///
/// No file is begun or finished until the returned guard is dropped.
pub fn abandon_writes() -> Abandoned {
    let mut files = under_way();
    while let Some(file) = files.pop_first() {
        let _ = std::fs::remove_file(file);
    }
    Abandoned(files)
}

/// A file that is written whole or not at all: nothing is found at its path before [`finish`](Self::finish) has returned.
///
/// The content goes to a temporary file beside the path, which is renamed in the end. Missing folders are made and
/// [reported](report_made_folders). A file that is replaced keeps its permissions and its owner, and one that is
/// write-protected is refused. A symbolic link stays, and the file that it leads to is written; so do hard links, whose
/// file is overwritten in its place in the end. The path `-` is standard output; standard output, pipes and devices are
/// written to in the end.
pub struct WholeFile {
    path: PathBuf,
    content: Content,
}

/// The store of a file's content until the file is finished.
enum Content {
    /// A temporary file, which is renamed to the path.
    Beside(Temporary, PathBuf, Existing),
    /// A file without a name, which is copied to standard output.
    Standard(BufWriter<SpooledTempFile>),
    /// A file without a name, which is copied to a pipe or a device.
    Device(BufWriter<SpooledTempFile>, PathBuf),
}

impl WholeFile {
    /// Begins a file.
    ///
    /// # Errors
    /// Fails where the file system refuses.
    pub fn begin(path: &Path) -> Result<Self, WriteError> {
        let store = || BufWriter::new(SpooledTempFile::new(KEPT));
        let own = path.to_path_buf();
        if is_standard(path) {
            return Ok(Self { path: own, content: Content::Standard(store()) });
        }
        let target = destination(path).map_err(|e| WriteError::io(path, e))?;
        if target.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir()) {
            return Ok(Self { path: own, content: Content::Device(store(), target) });
        }
        let existing = Existing::at(&target).map_err(|e| WriteError::io(path, e))?;
        let temporary = Temporary::beside(path, &target)?;
        Ok(Self { path: own, content: Content::Beside(temporary, target, existing) })
    }

    /// Moves the finished file to its path.
    ///
    /// # Errors
    /// Fails where the file system refuses; then nothing of the file is left behind.
    pub fn finish(self) -> Result<(), WriteError> {
        self.finish_open().map(drop)
    }

    /// Moves the finished file to its path, and returns it open at its end, for a caller that adds more; `None` for
    /// standard output.
    ///
    /// # Errors
    /// Fails where the file system refuses; then nothing of the file is left behind.
    pub fn finish_open(self) -> Result<Option<File>, WriteError> {
        let Self { path, content } = self;
        let done = match content {
            Content::Beside(temporary, target, existing) => temporary.persist(&target, &existing).map(Some),
            Content::Standard(store) => match copied(store, || Ok(io::stdout().lock())) {
                // The reader of the pipe has closed it.
                Err(e) if e.kind() == io::ErrorKind::BrokenPipe => Ok(None),
                done => done.map(|_| None),
            },
            Content::Device(store, target) => {
                copied(store, || OpenOptions::new().write(true).open(&target)).map(Some)
            }
        };
        done.map_err(|e| WriteError::io(&path, e))
    }

    fn sink(&mut self) -> &mut dyn Sink {
        match &mut self.content {
            Content::Beside(temporary, ..) => &mut temporary.buffer,
            Content::Standard(store) | Content::Device(store, _) => store,
        }
    }
}

/// Checks that a file can be written, before long work begins. Missing folders are made, and nothing else is left.
///
/// # Errors
/// Fails where the file system refuses.
pub fn check_writable(path: &Path) -> Result<(), WriteError> {
    WholeFile::begin(path).map(drop)
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.sink().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.sink().flush()
    }
}

impl Seek for WholeFile {
    fn seek(&mut self, to: io::SeekFrom) -> io::Result<u64> {
        self.sink().seek(to)
    }
}

/// Copies a store to the file that `open` opens, and returns that file.
fn copied<W: Write>(
    store: BufWriter<SpooledTempFile>,
    open: impl FnOnce() -> io::Result<W>,
) -> io::Result<W> {
    let mut store = store.into_inner()?;
    store.rewind()?;
    let mut output = open()?;
    io::copy(&mut store, &mut output)?;
    output.flush()?;
    Ok(output)
}

/// Writes a file whole or not at all: `fill` writes its content; see [`WholeFile`].
///
/// # Errors
/// Fails where the file system refuses, or `fill` returns an error.
pub fn write<E: From<WriteError>>(
    path: &Path,
    fill: impl FnOnce(&mut dyn Sink) -> Result<(), E>,
) -> Result<(), E> {
    let mut file = WholeFile::begin(path)?;
    fill(&mut file)?;
    Ok(file.finish()?)
}

/// Follows symbolic links to the path where they end, whether a file exists there or not.
fn destination(path: &Path) -> io::Result<PathBuf> {
    let mut target = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        // A path that is no link, or does not exist, cannot be read as a link.
        let Ok(next) = std::fs::read_link(&target) else { return Ok(target) };
        target = target.parent().unwrap_or(Path::new("")).join(next);
    }
    Err(io::Error::other("too many symbolic links lead from one to another"))
}

/// A temporary file, which is removed with its owner unless it is renamed.
struct Temporary {
    buffer: BufWriter<NamedTempFile>,
    entry: Entry,
}

/// A temporary file's entry in `UNDER_WAY`, which is removed when this is dropped.
struct Entry(PathBuf);

impl Drop for Entry {
    fn drop(&mut self) {
        under_way().remove(&self.0);
    }
}

impl Temporary {
    /// Makes a temporary file in the folder of `target`; errors name `path`, or the folder.
    fn beside(path: &Path, target: &Path) -> Result<Self, WriteError> {
        let folder = target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let is_missing = !folder.exists();
        std::fs::create_dir_all(folder).map_err(|e| match e.kind() {
            io::ErrorKind::AlreadyExists | io::ErrorKind::NotADirectory => {
                WriteError::io(folder, io::Error::new(e.kind(), "this is a file, and a folder is needed"))
            }
            _ => WriteError::io(folder, e),
        })?;
        if let Some(report) = ON_FOLDER.get().filter(|_| is_missing) {
            report(folder);
        }
        let mut files = under_way();
        let file = allowed(folder).and_then(|()| new_file(folder)).map_err(|e| {
            let why = format!("no file can be made in its folder ({})", e.kind());
            WriteError::io(path, io::Error::new(e.kind(), why))
        })?;
        let entry = Entry(file.path().to_path_buf());
        files.insert(entry.0.clone());
        Ok(Self { buffer: BufWriter::with_capacity(1 << 16, file), entry })
    }

    /// Renames the temporary file to `target`, or writes its content into the file there, and returns the file.
    fn persist(self, target: &Path, existing: &Existing) -> io::Result<File> {
        let Self { buffer, entry } = self;
        let file = buffer.into_inner()?;
        // A signal that ends the program waits for the lock, and so for a file that is overwritten in its place.
        let files = under_way();
        let written = overwriting::replace(file, target, existing);
        drop(files);
        drop(entry);
        written
    }
}

/// Refuses a folder that is write-protected, also for the superuser, whom the system does not hinder.
#[cfg(unix)]
fn allowed(folder: &Path) -> io::Result<()> {
    if folder.metadata()?.permissions().readonly() {
        Err(io::ErrorKind::PermissionDenied.into())
    } else {
        Ok(())
    }
}

/// Elsewhere a folder's mark says nothing of the files in it.
#[cfg(not(unix))]
fn allowed(_: &Path) -> io::Result<()> {
    Ok(())
}

fn new_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".brillianteer-");
    // Temporary files are private by default; these become ordinary files.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        match error {
            WriteError::Stopped(_) => Self::Stopped,
            error @ WriteError::Io { .. } => Self::Output(error.to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn put(path: &Path, text: &str) -> Result<(), WriteError> {
        write(path, |w| w.write_all(text.as_bytes()).map_err(|e| WriteError::io(path, e)))
    }

    #[test]
    fn a_file_that_fails_half_way_leaves_the_old_one_and_no_trace() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/er/a.txt");
        put(&path, "old").unwrap();
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
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    #[cfg(unix)]
    fn links_stay_and_the_file_that_they_lead_to_is_written() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("far")).unwrap();
        symlink("far/real.txt", at("near.txt")).unwrap();
        symlink(at("near.txt"), at("nearer.txt")).unwrap();
        for text in ["made through links that led nowhere", "written again"] {
            put(&at("nearer.txt"), text).unwrap();
            assert_eq!(std::fs::read_to_string(at("far/real.txt")).unwrap(), text);
        }
        assert!(at("near.txt").is_symlink() && at("nearer.txt").is_symlink());
        assert_eq!(std::fs::read_dir(at("far")).unwrap().count(), 1);
        symlink("round.txt", at("round.txt")).unwrap();
        let error = put(&at("round.txt"), "").unwrap_err().to_string();
        assert!(error.contains("too many symbolic links"), "{error}");
    }

    #[test]
    #[cfg(unix)]
    fn a_device_is_written_to_and_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        std::os::unix::fs::symlink("/dev/null", folder.path().join("null")).unwrap();
        put(&folder.path().join("null"), "gone").unwrap();
        assert!(!Path::new("/dev/null").metadata().unwrap().is_file());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        if Path::new("/dev/full").exists() {
            assert!(put(Path::new("/dev/full"), "no room").is_err());
        }
    }
}
