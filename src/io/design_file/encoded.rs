//! A design as the writer of any format returns it.

/// The bytes of a design's file, and what the format could not keep.
#[derive(Debug, Clone, PartialEq)]
pub struct EncodedDesign {
    /// The content of the file.
    pub bytes: Vec<u8>,
    /// What the format cannot hold of the design, in words.
    pub lost: Vec<String>,
}
