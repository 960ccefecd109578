//! A design in the form that the writers of all formats return.

/// The bytes of a design's file, and the properties that the format cannot hold.
#[derive(Debug, Clone, PartialEq)]
pub struct EncodedDesign {
    /// The content of the file.
    pub bytes: Vec<u8>,
    /// The properties of the design that the format cannot hold, in words.
    pub lost: Vec<String>,
}
