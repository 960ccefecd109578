//! The design that the present design is compared with.

use crate::model::document::Document;
use brillianteer_scene::{Specimen, SpecimenError};
use std::sync::Arc;

/// A design to compare with.
#[derive(Debug, Clone)]
pub struct Compared {
    /// The name of the design on the screen.
    pub name: String,
    /// True where this is the present design as it was last saved.
    pub is_saved: bool,
    /// The stone of the design.
    pub specimen: Arc<Specimen>,
}

impl Compared {
    /// Returns the document's design as it was last saved.
    ///
    /// # Errors
    /// Fails where that design makes no stone.
    pub fn of_saved(document: &Document) -> Result<Self, SpecimenError> {
        let specimen = Specimen::new(document.saved().clone())?;
        Ok(Self { name: "as saved".to_owned(), is_saved: true, specimen: Arc::new(specimen) })
    }

    /// Returns the design of another document.
    pub fn of(document: &Document) -> Self {
        Self { name: document.title(), is_saved: false, specimen: Arc::clone(document.specimen()) }
    }
}
