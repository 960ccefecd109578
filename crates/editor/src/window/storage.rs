//! Keeps the window's state between starts, in the file and format of eframe, so that it does not matter which painter ran
//! last.

use brillianteer_files::{WriteError, write};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Texts by key, kept in a file.
pub struct FileStorage {
    file: PathBuf,
    texts: BTreeMap<String, String>,
    is_changed: bool,
}

impl FileStorage {
    /// Reads the file in a folder; a file that is missing or broken counts as empty.
    pub fn read(folder: &Path) -> Self {
        let file = folder.join("app.ron");
        let texts = std::fs::read_to_string(&file).ok().and_then(|text| ron::from_str(&text).ok());
        Self { file, texts: texts.unwrap_or_default(), is_changed: false }
    }

    /// Writes the file whole or not at all.
    fn write(&self) -> Result<(), WriteError> {
        let file = &self.file;
        let text = ron::ser::to_string_pretty(&self.texts, ron::ser::PrettyConfig::default())
            .map_err(|e| WriteError::io(file, std::io::Error::other(e)))?;
        write(file, |sink| sink.write_all(text.as_bytes()).map_err(|e| WriteError::io(file, e)))
    }
}

impl eframe::Storage for FileStorage {
    fn get_string(&self, key: &str) -> Option<String> {
        self.texts.get(key).cloned()
    }

    fn set_string(&mut self, key: &str, value: String) {
        if self.texts.get(key) != Some(&value) {
            self.texts.insert(key.to_owned(), value);
            self.is_changed = true;
        }
    }

    fn remove_string(&mut self, key: &str) {
        self.is_changed |= self.texts.remove(key).is_some();
    }

    fn flush(&mut self) {
        // A failure costs no more than the window's layout, and is tried again at the next flush.
        if self.is_changed && self.write().is_ok() {
            self.is_changed = false;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::Storage;

    #[test]
    fn texts_come_back_and_a_broken_file_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let inside = folder.path().join("made when it is needed");
        let mut kept = FileStorage::read(&inside);
        kept.set_string("desk", "{\"a\": \"b\\n\"}".to_owned());
        kept.set_string("gone", "soon".to_owned());
        kept.remove_string("gone");
        kept.flush();
        let again = FileStorage::read(&inside);
        assert_eq!(again.get_string("desk").as_deref(), Some("{\"a\": \"b\\n\"}"));
        assert_eq!(again.get_string("gone"), None);
        std::fs::write(inside.join("app.ron"), "{\"desk\": ").unwrap();
        assert_eq!(FileStorage::read(&inside).get_string("desk"), None);
    }

    #[test]
    fn what_eframe_has_written_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let written = "{\n    \"window\": \"(normal:())\",\n    \"desk\": \"{}\",\n}";
        std::fs::write(folder.path().join("app.ron"), written).unwrap();
        let kept = FileStorage::read(folder.path());
        assert_eq!(kept.get_string("window").as_deref(), Some("(normal:())"));
        assert_eq!(kept.get_string("desk").as_deref(), Some("{}"));
    }
}
