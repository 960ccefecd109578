//! Puts a new file in the place of an old one: the old file's permissions, owner and hard links stay, and a file that is
//! write-protected is refused.

use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, Read, Seek, Write};
use std::path::Path;
use tempfile::{NamedTempFile, SpooledTempFile};

/// The old content of a file that is overwritten is kept in memory up to this many bytes, and beyond that in a file without
/// a name.
const KEPT: usize = 16 << 20;

/// The file that is to be replaced; `None` where there is none.
pub(super) struct Existing(Option<Metadata>);

impl Existing {
    /// Looks at the file of a path.
    ///
    /// # Errors
    /// Fails where there is a file that may not be written to.
    pub fn at(target: &Path) -> io::Result<Self> {
        let Ok(metadata) = target.metadata() else { return Ok(Self(None)) };
        if !metadata.is_file() {
            return Ok(Self(None));
        }
        // A file may be renamed over a protected one, and the superuser may write to it, so the protection is looked at
        // as well.
        let protected = || {
            let why = "the file there is write-protected; allow writing to it, or give another name";
            io::Error::new(io::ErrorKind::PermissionDenied, why)
        };
        if metadata.permissions().readonly() {
            return Err(protected());
        }
        match OpenOptions::new().write(true).open(target) {
            Err(error) if error.kind() == io::ErrorKind::PermissionDenied => Err(protected()),
            Err(error) if error.kind() == io::ErrorKind::ReadOnlyFilesystem => Err(error),
            _ => Ok(Self(Some(metadata))),
        }
    }

    /// Returns whether other names stand for the same file.
    #[cfg(unix)]
    fn has_hard_links(&self) -> bool {
        use std::os::unix::fs::MetadataExt;
        self.0.as_ref().is_some_and(|file| file.nlink() > 1)
    }

    #[cfg(not(unix))]
    fn has_hard_links(&self) -> bool {
        false
    }
}

/// Renames a temporary file to `target`, where it takes over what the file there had; or, where that file has other names
/// or cannot be replaced, writes the content into it. Returns the file, open at its end.
///
/// # Errors
/// Fails where the file system refuses; then the old file is as it was.
pub(super) fn replace(mut file: NamedTempFile, target: &Path, existing: &Existing) -> io::Result<File> {
    if existing.has_hard_links() || !takes_over(file.as_file(), existing) {
        return overwrite(file.as_file_mut(), target);
    }
    match file.persist(target) {
        Ok(file) => Ok(file),
        // A file that is itself mounted, as into a container, cannot be replaced.
        Err(error) if existing.0.is_some() && error.error.kind() == io::ErrorKind::ResourceBusy => {
            let mut file = error.file;
            overwrite(file.as_file_mut(), target)
        }
        Err(error) => Err(error.error),
    }
}

/// Gives a new file the owner and the permissions of the old one; returns whether it has both.
fn takes_over(file: &File, existing: &Existing) -> bool {
    let Some(old) = &existing.0 else { return true };
    // A change of owner takes away permissions, so it comes first.
    has_owner(file, old) && file.set_permissions(old.permissions()).is_ok()
}

#[cfg(unix)]
fn has_owner(file: &File, old: &Metadata) -> bool {
    use std::os::unix::fs::{MetadataExt, fchown};
    let is_same = |new: Metadata| (new.uid(), new.gid()) == (old.uid(), old.gid());
    file.metadata().is_ok_and(is_same) || fchown(file, Some(old.uid()), Some(old.gid())).is_ok()
}

#[cfg(not(unix))]
fn has_owner(_: &File, _: &Metadata) -> bool {
    true
}

/// Writes a file's content into the file at `target`. Where that fails, the old content is put back, for which there is
/// room: the file is shortened in the end alone.
fn overwrite(new: &mut File, target: &Path) -> io::Result<File> {
    let mut file = OpenOptions::new().read(true).write(true).open(target)?;
    let mut before = SpooledTempFile::new(KEPT);
    io::copy(&mut file, &mut before)?;
    if let Err(error) = put(new, &mut file) {
        // Nothing more can be done where this fails as well.
        let _ = put(&mut before, &mut file);
        return Err(error);
    }
    Ok(file)
}

/// Makes the content of one file that of another.
fn put(content: &mut (impl Read + Seek), file: &mut File) -> io::Result<()> {
    content.rewind()?;
    file.rewind()?;
    let length = io::copy(content, file)?;
    file.set_len(length)?;
    file.flush()
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;
    use crate::atomic::{WriteError, write};
    use std::os::unix::fs::{MetadataExt, PermissionsExt};

    fn put_text(path: &Path, text: &str) -> Result<(), WriteError> {
        write(path, |file| file.write_all(text.as_bytes()).map_err(|e| WriteError::io(path, e)))
    }

    fn set_mode(path: &Path, mode: u32) {
        std::fs::set_permissions(path, std::fs::Permissions::from_mode(mode)).unwrap();
    }

    #[test]
    fn a_file_that_is_replaced_keeps_its_permissions_and_owner() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        std::fs::write(&path, "old").unwrap();
        set_mode(&path, 0o640);
        // The superuser alone can give a file away.
        let is_given = std::os::unix::fs::chown(&path, Some(12), Some(34)).is_ok();
        put_text(&path, "new").unwrap();
        let metadata = path.metadata().unwrap();
        assert_eq!(
            (std::fs::read_to_string(&path).unwrap().as_str(), metadata.mode() & 0o777),
            ("new", 0o640)
        );
        assert!(!is_given || (metadata.uid(), metadata.gid()) == (12, 34));
    }

    #[test]
    fn what_is_write_protected_is_refused_and_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        std::fs::write(&path, "old").unwrap();
        set_mode(&path, 0o444);
        let error = put_text(&path, "new").unwrap_err().to_string();
        assert!(error.contains("a.txt: cannot write: the file there is write-protected"), "{error}");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
        set_mode(&path, 0o644);
        set_mode(folder.path(), 0o555);
        for name in ["a.txt", "b.txt"] {
            let error = put_text(&folder.path().join(name), "new").unwrap_err().to_string();
            assert!(error.contains(name) && error.contains("folder"), "{error}");
        }
        set_mode(folder.path(), 0o755);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn all_names_of_a_file_stand_for_the_new_content() {
        let folder = tempfile::tempdir().unwrap();
        let [path, other] = ["a.txt", "b.txt"].map(|name| folder.path().join(name));
        std::fs::write(&path, "the old content, which is longer").unwrap();
        std::fs::hard_link(&path, &other).unwrap();
        for text in ["new", "new again, and longer than what was there before"] {
            put_text(&path, text).unwrap();
            assert_eq!(std::fs::read_to_string(&other).unwrap(), text);
        }
        let failed = write(&path, |file| {
            file.write_all(b"half").map_err(|e| WriteError::io(&path, e))?;
            Err(WriteError::Stopped(brillianteer_base::Stopped))
        });
        assert!(failed.is_err() && std::fs::read_to_string(&other).unwrap().starts_with("new again"));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}
