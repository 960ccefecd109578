//! Files of designs, whatever their format: told by what is in them, and only where that says nothing by how they end.

use super::cut_file::{self, CutFileError};
use super::{Failure, asc, gcs, gem, write as write_whole};
use super::{WriteError, text};
use crate::cut::Design;
use crate::scene::Specimen;
use std::io::Write as _;
use std::path::Path;

/// The largest file taken, bytes.
pub const MAX_BYTES: u64 = 64 << 20;

/// A format of designs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// This program's own cut files, TOML.
    Toml,
    /// GemCad's text files.
    Asc,
    /// GemCad's binary files.
    Gem,
    /// Gem Cut Studio's files, XML.
    Gcs,
}

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

impl Format {
    /// All there are.
    pub const ALL: [Self; 4] = [Self::Toml, Self::Asc, Self::Gem, Self::Gcs];

    /// How its files end, without the dot.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Toml => "toml",
            Self::Asc => "asc",
            Self::Gem => "gem",
            Self::Gcs => "gcs",
        }
    }

    /// The format that a file's name asks for.
    pub fn of_name(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        Self::ALL.into_iter().find(|format| format.ending() == ending)
    }

    /// The format of a file of these bytes and this name.
    fn of(bytes: &[u8], path: &Path) -> Self {
        let known = [
            (Self::Gcs, gcs::looks_like as fn(&[u8]) -> bool),
            (Self::Gem, gem::looks_like),
            (Self::Asc, asc::looks_like),
        ];
        let told = known.into_iter().find(|(_, looks_like)| looks_like(bytes)).map(|(format, _)| format);
        told.or_else(|| Self::of_name(path)).unwrap_or(Self::Toml)
    }
}

/// Reads a design.
///
/// # Errors
/// What keeps the file from being one, with its path, and line where there is one.
pub fn read(path: &Path) -> Result<Brought, CutFileError> {
    let label = path.display().to_string();
    let fault = |error: text::TextError| CutFileError {
        path: label.clone(),
        line: error.line,
        message: error.message,
    };
    let bytes = text::read_bytes(path, MAX_BYTES).map_err(fault)?;
    match Format::of(&bytes, path) {
        Format::Asc => asc::read(&bytes, &label),
        Format::Gem => gem::read(&bytes, &label),
        Format::Gcs => gcs::read(&bytes, &label),
        Format::Toml => {
            let text = text::utf8(bytes).map_err(fault)?;
            cut_file::parse(&text, &label).map(|design| Brought { design, warnings: vec![] })
        }
    }
}

/// The file of a stone's design.
pub fn written(specimen: &Specimen, format: Format) -> Written {
    match format {
        Format::Toml => Written { bytes: cut_file::write(&specimen.design).into_bytes(), lost: vec![] },
        Format::Asc => asc::write(specimen),
        Format::Gem => gem::write(specimen),
        Format::Gcs => gcs::write(specimen),
    }
}

/// Writes a stone's design, whole or not at all; what the format could not hold, in words.
///
/// # Errors
/// Where the file system refuses.
pub fn write(specimen: &Specimen, format: Format, path: &Path) -> Result<Vec<String>, Failure> {
    let written = written(specimen, format);
    write_whole(path, |file| file.write_all(&written.bytes).map_err(|e| WriteError::io(path, e)))?;
    Ok(written.lost)
}
