//! The background: the colour of a picture where no stone covers it.

use brillianteer_optics::{encoded_from_linear, linear_from_encoded};
use std::fmt;
use std::str::FromStr;

/// The background behind the stones; colours are linear sRGB.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Background {
    /// No background: the picture keeps its cover as transparency.
    #[default]
    Transparent,
    /// A single colour.
    Plain([f32; 3]),
    /// A gradient from one colour to another, even in linear light.
    Gradient {
        /// The colour at the upper border.
        top: [f32; 3],
        /// The colour at the lower border.
        bottom: [f32; 3],
    },
}

impl Background {
    /// Returns the colour at the middle of row `y` out of `height`; `None` where the background is transparent.
    pub fn row(&self, y: u32, height: u32) -> Option<[f32; 3]> {
        match *self {
            Self::Transparent => None,
            Self::Plain(colour) => Some(colour),
            Self::Gradient { top, bottom } => {
                let down = (y as f32 + 0.5) / height.max(1) as f32;
                Some(std::array::from_fn(|c| top[c] + (bottom[c] - top[c]) * down))
            }
        }
    }
}

/// A text that names no colour, and no gradient of two; cut to a readable length.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "background '{0}': give transparent, black, white, grey, a colour such as #20262e, or two, top-bottom, such as \
     #404850-#101215"
)]
pub struct UnknownColour(pub String);

impl FromStr for Background {
    type Err = UnknownColour;

    fn from_str(text: &str) -> Result<Self, UnknownColour> {
        let text = text.trim().to_ascii_lowercase();
        match text.split_once('-') {
            None if text == "transparent" => Ok(Self::Transparent),
            None => colour(&text).map(Self::Plain),
            Some((top, bottom)) => {
                Ok(Self::Gradient { top: colour(top.trim())?, bottom: colour(bottom.trim())? })
            }
        }
    }
}

impl fmt::Display for Background {
    /// Writes text that parses back to the same background, each colour rounded to 8 bits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let byte = |c: f32| (encoded_from_linear(f64::from(c)).clamp(0.0, 1.0) * 255.0).round() as u8;
        let code = |colour: &[f32; 3]| {
            let [red, green, blue] = colour.map(byte);
            format!("#{red:02x}{green:02x}{blue:02x}")
        };
        match self {
            Self::Transparent => f.write_str("transparent"),
            Self::Plain(colour) => f.write_str(&code(colour)),
            Self::Gradient { top, bottom } => write!(f, "{}-{}", code(top), code(bottom)),
        }
    }
}

/// Middle grey: half of the sRGB code range.
const GREY: &str = "#808080";

/// Reads one colour from its name or its `#rrggbb` code.
fn colour(text: &str) -> Result<[f32; 3], UnknownColour> {
    let code = match text {
        "black" => "#000000",
        "white" => "#ffffff",
        "grey" | "gray" => GREY,
        other => other,
    };
    let wrong = || UnknownColour(text.chars().take(30).collect());
    let digits = code.strip_prefix('#').filter(|d| d.len() == 6 && d.bytes().all(|b| b.is_ascii_hexdigit()));
    let number = u32::from_str_radix(digits.ok_or_else(wrong)?, 16).map_err(|_| wrong())?;
    let linear = |shift: u32| linear_from_encoded(f64::from((number >> shift) & 255) / 255.0) as f32;
    Ok([linear(16), linear(8), linear(0)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_codes_and_gradients_are_read() {
        let read = |text: &str| text.parse::<Background>();
        assert_eq!(read("transparent"), Ok(Background::Transparent));
        assert_eq!(read(" White "), Ok(Background::Plain([1.0; 3])));
        assert_eq!(read("#000000"), read("black"));
        assert_eq!(read("white - #000000"), Ok(Background::Gradient { top: [1.0; 3], bottom: [0.0; 3] }));
        let Ok(Background::Plain([r, g, b])) = read("#ff8000") else { panic!("no colour") };
        assert!(r == 1.0 && (g - 0.215_86).abs() < 1e-4 && b == 0.0);
    }

    #[test]
    fn what_is_no_background_is_named() {
        for text in [
            "",
            "#",
            "#12345",
            "#1234567",
            "#12345g",
            "#+12345",
            "mauve",
            "black-",
            "-",
            "white-x-y",
            "#é234",
        ] {
            let error = text.parse::<Background>().unwrap_err().to_string();
            assert!(error.contains("#20262e"), "{text}: {error}");
        }
    }

    #[test]
    fn a_gradient_runs_down() {
        let gradient = Background::Gradient { top: [1.0; 3], bottom: [0.0; 3] };
        let column: Vec<f32> = (0..4).filter_map(|y| gradient.row(y, 4)).map(|c| c[0]).collect();
        assert_eq!(column, [0.875, 0.625, 0.375, 0.125]);
    }
}
