//! Files of designs, whatever their format.

use crate::cut::Design;

/// What a file has brought in.
#[derive(Debug, Clone, PartialEq)]
pub struct Brought {
    /// The design that it tells of.
    pub design: Design,
    /// What is odd about the file, in words, each with its line or offset where it has one.
    pub warnings: Vec<String>,
}

/// A design as a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// The file.
    pub bytes: Vec<u8>,
    /// What its format cannot hold, in words.
    pub lost: Vec<String>,
}
