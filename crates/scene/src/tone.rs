//! Names of tone curves, which compress light of any brightness to the range of a screen; `brillianteer-picture` has the
//! curves.

use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// The curve that brings bright light below 1. Every curve begins at 0 and rises.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Tone {
    /// Light that a screen can show stays as it is, and brighter light is cut at 1: for tests and comparisons.
    Linear,
    /// Light up to 0.8 stays as it is. Brighter light keeps its hue and turns white as it nears 1.
    #[default]
    Neutral,
    /// The curve of film: deep shadows, soft highlights, and a little more contrast between them.
    Filmic,
}

impl Tone {
    /// All curves, each with its name in files and on the command line.
    pub const NAMES: [(&str, Self); 3] =
        [("neutral", Self::Neutral), ("filmic", Self::Filmic), ("linear", Self::Linear)];

    /// Returns the curve's name.
    pub fn name(self) -> &'static str {
        Self::NAMES.into_iter().find(|(_, tone)| *tone == self).map_or("neutral", |(name, _)| name)
    }
}

/// The text names no tone curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("tone '{0}': give neutral, filmic or linear")]
pub struct UnknownTone(String);

impl FromStr for Tone {
    type Err = UnknownTone;

    fn from_str(text: &str) -> Result<Self, UnknownTone> {
        let found = Self::NAMES.into_iter().find(|(name, _)| *name == text).map(|(_, tone)| tone);
        found.ok_or_else(|| UnknownTone(text.chars().take(30).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tones_have_names() {
        for (name, tone) in Tone::NAMES {
            assert_eq!((name.parse(), tone.name()), (Ok(tone), name));
        }
        assert!("Vivid".parse::<Tone>().unwrap_err().to_string().contains("neutral"));
    }
}
