//! The design that the present one is compared with.

use super::document::Document;
use super::editor::turned;
use crate::scene::Specimen;
use std::path::Path;
use std::sync::Arc;

/// Another design.
pub struct Compared {
    /// What it is called.
    pub name: String,
    /// Whether it is the present one as it was saved.
    pub is_saved: bool,
    specimen: Arc<Specimen>,
    posed: (f64, Arc<Specimen>),
}

impl Compared {
    /// The design as it was saved.
    ///
    /// # Errors
    /// Where that made no stone.
    pub fn of_saved(document: &Document) -> Result<Self, String> {
        let specimen = Specimen::new(document.saved().clone()).map_err(|e| e.to_string())?;
        Ok(Self::new("as saved".to_owned(), true, specimen))
    }

    /// Another file's design.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn of_file(path: &Path) -> Result<Self, String> {
        let document = Document::open(path)?;
        let specimen = Arc::clone(document.specimen());
        Ok(Self { name: document.title(), is_saved: false, posed: (0.0, Arc::clone(&specimen)), specimen })
    }

    fn new(name: String, is_saved: bool, specimen: Specimen) -> Self {
        let specimen = Arc::new(specimen);
        Self { name, is_saved, posed: (0.0, Arc::clone(&specimen)), specimen }
    }

    /// Its stone, turned as it is seen.
    pub fn posed(&mut self, turn: f64) -> Arc<Specimen> {
        if self.posed.0 != turn {
            self.posed = (turn, turned(&self.specimen, turn));
        }
        Arc::clone(&self.posed.1)
    }
}
