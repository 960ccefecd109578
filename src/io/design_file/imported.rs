//! A design as the reader of any format returns it.

use crate::cut::Design;

/// A design that was read from a file, with notes and warnings.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedDesign {
    /// The design.
    pub design: Design,
    /// How the file was understood, in words, where it could be understood otherwise.
    pub notes: Vec<String>,
    /// What is unusual about the file, in words, each with its line or offset where it has one.
    pub warnings: Vec<String>,
    /// For a mesh, whether its shape leaves a doubt which way its table faces; `None` for other designs.
    pub doubt: Option<bool>,
}

impl ImportedDesign {
    /// Wraps a design without notes and warnings.
    pub fn of(design: Design) -> Self {
        Self { design, notes: vec![], warnings: vec![], doubt: None }
    }
}
