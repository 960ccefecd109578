//! Reads numbers and texts from bytes, one after the other.

use brillianteer_base::Fault;
use std::fmt::Display;

/// Makes a fault of the bytes at an offset.
pub(super) fn fault(at: usize, problem: impl Display) -> Fault {
    Fault::part(format!("offset {at:#x}"), problem)
}

/// Returns the beginning of a message about this offset.
pub(super) fn place(at: usize) -> String {
    format!("offset {at:#x}: ")
}

/// Decodes Windows-1252, in which every byte is a character.
pub(super) fn decoded(bytes: &[u8]) -> String {
    encoding_rs::WINDOWS_1252.decode_without_bom_handling(bytes).0.into_owned()
}

pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    pub fn at(&self) -> usize {
        self.at
    }

    pub fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], Fault> {
        let taken = self.bytes.get(self.at..self.at + count).ok_or_else(|| {
            let problem =
                format!("the file ends in the middle of {what}; it is truncated or not a .gem file");
            fault(self.bytes.len(), problem)
        })?;
        self.at += count;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self, what: &str) -> Result<[u8; N], Fault> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N, what)?);
        Ok(array)
    }

    pub fn f64(&mut self, what: &str) -> Result<f64, Fault> {
        self.array(what).map(f64::from_le_bytes)
    }

    pub fn i32(&mut self, what: &str) -> Result<i32, Fault> {
        self.array(what).map(i32::from_le_bytes)
    }

    /// Reads a text that follows its length, a byte.
    pub fn text(&mut self, what: &str) -> Result<&'a [u8], Fault> {
        let [length] = self.array(what)?;
        self.take(usize::from(length), what)
    }
}
