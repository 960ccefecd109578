//! The methods that smooth the edges of renders, besides many samples of each pixel: `brillianteer-picture` carries them out.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// The method that smooths the edges of a render.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub enum Smoothing {
    /// No smoothing.
    #[default]
    None,
    /// FXAA on the finished picture.
    Fxaa,
    /// Temporal antialiasing: earlier pictures are moved along with the bodies and blended in.
    Temporal {
        /// The share of the newest picture, within [`Smoothing::NEWEST`].
        newest: f64,
    },
}

impl Smoothing {
    /// The range of the share of the newest picture.
    pub const NEWEST: RangeInclusive<f64> = 0.05..=1.0;

    /// The default share of the newest picture.
    pub const USUAL_NEWEST: f64 = 0.5;
}

/// The text is no smoothing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "'{0}': give none, fxaa, temporal, or temporal:PART, where PART is the share of the newest picture, 0.05 to 1"
)]
pub struct SmoothingError(String);

impl FromStr for Smoothing {
    type Err = SmoothingError;

    /// Parses `none`, `fxaa`, `temporal` or `temporal:PART`; upper and lower case are the same.
    fn from_str(text: &str) -> Result<Self, SmoothingError> {
        let (name, part) = text.split_once(':').map_or((text, None), |(name, part)| (name, Some(part)));
        let newest = part.map_or(Some(Self::USUAL_NEWEST), |part| part.trim().parse().ok());
        match (name.trim().to_ascii_lowercase().as_str(), part, newest) {
            ("none", None, _) => Ok(Self::None),
            ("fxaa", None, _) => Ok(Self::Fxaa),
            ("temporal", _, Some(newest)) if Self::NEWEST.contains(&newest) => Ok(Self::Temporal { newest }),
            _ => Err(SmoothingError(text.to_owned())),
        }
    }
}

impl fmt::Display for Smoothing {
    /// Writes a text that is parsed as the same smoothing.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("none"),
            Self::Fxaa => f.write_str("fxaa"),
            Self::Temporal { newest } if *newest == Self::USUAL_NEWEST => f.write_str("temporal"),
            Self::Temporal { newest } => write!(f, "temporal:{newest}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back_and_what_is_none_is_refused() {
        for text in ["none", "fxaa", "temporal", "temporal:0.05", "temporal:0.3", "temporal:1"] {
            assert_eq!(text.parse::<Smoothing>().unwrap().to_string(), text);
        }
        assert_eq!("FXAA".parse(), Ok(Smoothing::Fxaa));
        assert_eq!("temporal:0.5".parse(), Ok(Smoothing::Temporal { newest: 0.5 }));
        for text in ["", "taa", "none:1", "fxaa:0.5", "temporal:", "temporal:0", "temporal:2", "temporal:NaN"]
        {
            let error = text.parse::<Smoothing>().unwrap_err().to_string();
            assert!(error.starts_with(&format!("'{text}': give none, fxaa")), "{error}");
        }
    }
}
