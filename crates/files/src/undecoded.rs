//! Says in plain words why the decoder of a picture gave up on a file.

use image::ImageError;
use image::error::ImageFormatHint;
use std::error::Error;
use std::io::{self, ErrorKind};

/// The reason for data that a decoder does not expect.
const DAMAGED: &str = "its data are damaged";

/// An error of a decoder.
pub trait Undecoded {
    /// Returns the reason in plain words, as a part of a sentence.
    fn reason(&self) -> String;
}

impl Undecoded for &str {
    fn reason(&self) -> String {
        (*self).to_owned()
    }
}

impl Undecoded for io::Error {
    fn reason(&self) -> String {
        match self.kind() {
            ErrorKind::UnexpectedEof => "it ends too soon: it has been cut off".to_owned(),
            ErrorKind::InvalidData | ErrorKind::InvalidInput | ErrorKind::Other => DAMAGED.to_owned(),
            _ => format!("the file system refuses: {self}"),
        }
    }
}

impl Undecoded for ImageError {
    fn reason(&self) -> String {
        match self {
            Self::IoError(error) => error.reason(),
            Self::Limits(_) => "it needs more memory than a picture may; scale it down".to_owned(),
            Self::Unsupported(error) => match error.format_hint() {
                ImageFormatHint::Exact(format) => {
                    format!("this kind of {} is not read", named(&format!("{format:?}")))
                }
                _ => "this kind of picture is not read".to_owned(),
            },
            Self::Decoding(error) => match io_cause(error) {
                Some(cause) => cause.reason(),
                None => match error.format_hint() {
                    ImageFormatHint::Exact(format) => {
                        format!("its {} data are damaged", named(&format!("{format:?}")))
                    }
                    _ => DAMAGED.to_owned(),
                },
            },
            Self::Encoding(_) | Self::Parameter(_) => DAMAGED.to_owned(),
        }
    }
}

impl Undecoded for png::DecodingError {
    fn reason(&self) -> String {
        match self {
            Self::IoError(error) => error.reason(),
            Self::LimitsExceeded => "it needs more memory than a picture may; scale it down".to_owned(),
            Self::Format(_) | Self::Parameter(_) => "its PNG data are damaged".to_owned(),
        }
    }
}

#[cfg(feature = "exr")]
impl Undecoded for exr::error::Error {
    fn reason(&self) -> String {
        match self {
            Self::NotSupported(what) => {
                let kinds = [
                    ("deep", "it holds deep data, several samples a pixel, which are not read; save it flat"),
                    ("DWA", "its compression, DWA of this kind, is not read; save it with ZIP compression"),
                    ("compression", "its compression is not read; save it with ZIP compression"),
                    ("version", "its version of OpenEXR is not read; save it as version 2"),
                ];
                let kind = kinds.iter().find(|(word, _)| what.contains(word));
                kind.map_or("this kind of OpenEXR is not read", |(_, reason)| reason).to_owned()
            }
            Self::Io(error) => error.reason(),
            Self::Invalid(what) if what.contains("missing bytes") => {
                "it ends too soon: it has been cut off".to_owned()
            }
            Self::Invalid(_) | Self::Aborted => "its OpenEXR data are damaged".to_owned(),
        }
    }
}

/// Returns the name by which people call a format.
fn named(format: &str) -> String {
    match format {
        "Hdr" => "Radiance HDR".to_owned(),
        other => other.to_ascii_uppercase(),
    }
}

/// Returns the fault of the file system that is the cause of an error.
fn io_cause(error: &dyn Error) -> Option<&io::Error> {
    let mut cause = error.source();
    while let Some(error) = cause {
        if let Some(found) = error.downcast_ref::<io::Error>() {
            return Some(found);
        }
        cause = error.source();
    }
    None
}
