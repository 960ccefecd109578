//! The design that the present one is compared with.

use super::document::Document;
use super::pose_cache::PoseCache;
use crate::scene::Specimen;
use std::sync::Arc;

/// Another design.
pub struct Compared {
    /// What it is called.
    pub name: String,
    /// Whether it is the present one as it was saved.
    pub is_saved: bool,
    /// Its stone, as the design has it.
    pub specimen: Arc<Specimen>,
    posed: PoseCache,
}

impl Compared {
    /// The design as it was saved.
    ///
    /// # Errors
    /// Where that made no stone.
    pub fn of_saved(document: &Document) -> Result<Self, String> {
        let specimen = Specimen::new(document.saved().clone()).map_err(|e| e.to_string())?;
        Ok(Self::new("as saved".to_owned(), true, Arc::new(specimen)))
    }

    /// Another file's design.
    pub fn of(document: &Document) -> Self {
        Self::new(document.title(), false, Arc::clone(document.specimen()))
    }

    fn new(name: String, is_saved: bool, specimen: Arc<Specimen>) -> Self {
        Self { name, is_saved, specimen, posed: PoseCache::default() }
    }

    /// Its stone, turned as it is seen.
    pub fn posed(&mut self, turn: f64) -> Arc<Specimen> {
        self.posed.of(&self.specimen, turn)
    }
}
