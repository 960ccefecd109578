//! The size of a stone, given by its girdle or by its weight.

use super::design::DIAMETERS_MM;
use brillianteer_optics::Material;
use std::fmt;
use std::str::FromStr;

/// The size of a stone, in the unit that the user gave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Size {
    /// The girdle diameter, mm; 0.1 to 1000.
    Millimetres(f64),
    /// The weight, in carats of 0.2 g; above 0.
    Carats(f64),
}

/// The fault in a size.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SizeError {
    /// A number without a unit.
    #[error(
        "'{number}' has no unit; write {number}mm for the girdle's diameter or {number}ct for the weight"
    )]
    NoUnit {
        /// The number as given.
        number: String,
    },
    /// A text that is not a number with a unit.
    #[error("'{text}' is not a size; write a number and mm or ct, as in 6.5mm or 1.25ct")]
    NoSize {
        /// The text as given, at most 80 characters of it.
        text: String,
    },
    /// A weight that is not above 0, or not finite.
    #[error("{carats} ct is not a weight; give more than 0")]
    Weight {
        /// The weight as given, carats.
        carats: f64,
    },
    /// A girdle diameter outside 0.1 to 1000 mm.
    #[error("{size} must be from {} to {} mm across", DIAMETERS_MM.start(), DIAMETERS_MM.end())]
    Diameter {
        /// The size as given, and, if it is a weight, the diameter that follows from it.
        size: String,
    },
    /// A weight, but of a material whose density is not known.
    #[error(
        "a weight in ct needs a density, which {material} lacks; give the size in mm, or a material by its name, such as quartz"
    )]
    NoDensity {
        /// The material's name.
        material: String,
    },
}

impl Size {
    /// Returns the girdle diameter in mm of a stone of this size and material. `unit` is the stone's volume where its girdle
    /// radius is 1.
    ///
    /// # Errors
    /// Fails where the diameter is out of range, and for a weight that is not above 0, or of a material without a density.
    pub fn diameter_mm(self, unit: f64, material: &Material) -> Result<f64, SizeError> {
        let Self::Carats(carats) = self.checked()? else { return Ok(self.number()) };
        let no_density = || SizeError::NoDensity { material: material.name.clone() };
        let volume_mm3 = material.volume_mm3(carats).ok_or_else(no_density)?;
        let diameter = 2.0 * (volume_mm3 / unit).cbrt();
        let size = || format!("{self} of {}, {diameter:.3} mm,", material.name);
        if DIAMETERS_MM.contains(&diameter) {
            Ok(diameter)
        } else {
            Err(SizeError::Diameter { size: size() })
        }
    }

    fn number(self) -> f64 {
        let (Self::Millimetres(number) | Self::Carats(number)) = self;
        number
    }

    fn checked(self) -> Result<Self, SizeError> {
        match self {
            Self::Millimetres(mm) if !DIAMETERS_MM.contains(&mm) => {
                Err(SizeError::Diameter { size: self.to_string() })
            }
            Self::Carats(carats) if !(carats > 0.0 && carats.is_finite()) => {
                Err(SizeError::Weight { carats })
            }
            size => Ok(size),
        }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = if matches!(self, Self::Carats(_)) { "ct" } else { "mm" };
        write!(f, "{} {unit}", self.number())
    }
}

impl FromStr for Size {
    type Err = SizeError;

    fn from_str(text: &str) -> Result<Self, SizeError> {
        let text = text.trim();
        let number = text.trim_end_matches(char::is_alphabetic);
        let no_size = || SizeError::NoSize { text: text.chars().take(80).collect() };
        let value: f64 = number.trim_end().parse().map_err(|_| no_size())?;
        match text[number.len()..].to_lowercase().as_str() {
            "mm" => Self::Millimetres(value).checked(),
            "ct" | "carat" | "carats" => Self::Carats(value).checked(),
            "" => Err(SizeError::NoUnit { number: number.to_owned() }),
            _ => Err(no_size()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::MODERN;
    use super::*;
    use brillianteer_math::{Plane, Polytope};
    use brillianteer_optics::material;

    fn brilliant() -> Polytope {
        let planes: Vec<Plane> = MODERN.facets().unwrap().into_iter().map(|(_, plane)| plane).collect();
        Polytope::from_planes(&planes).unwrap()
    }

    #[test]
    fn sizes_are_read_in_mm_and_carats_however_they_are_spaced() {
        for text in ["6.5mm", "6.5 mm", " 6.5 MM "] {
            assert_eq!(text.parse(), Ok(Size::Millimetres(6.5)), "{text}");
        }
        for text in ["1.25ct", "1.25 ct", "1.25 carat", "1.25 carats", "125e-2ct"] {
            assert_eq!(text.parse(), Ok(Size::Carats(1.25)), "{text}");
        }
    }

    #[test]
    fn what_is_no_size_is_told_with_what_to_write() {
        for (text, told) in [
            ("6.5", "'6.5' has no unit; write 6.5mm for the girdle's diameter or 6.5ct for the weight"),
            ("big", "'big' is not a size; write a number and mm or ct, as in 6.5mm or 1.25ct"),
            ("", "'' is not a size"),
            ("1,5mm", "'1,5mm' is not a size"),
            ("3 inches", "'3 inches' is not a size"),
            ("0.05mm", "0.05 mm must be from 0.1 to 1000 mm across"),
            ("0ct", "0 ct is not a weight; give more than 0"),
            ("-1ct", "-1 ct is not a weight"),
        ] {
            let error = text.parse::<Size>().unwrap_err().to_string();
            assert!(error.starts_with(told), "{text}: {error}");
        }
    }

    #[test]
    fn a_weight_gives_the_diameter_of_a_stone_that_weighs_it() {
        let (unit, diamond) = (brilliant(), material("diamond").unwrap());
        let size: Size = "1ct".parse().unwrap();
        let diameter = size.diameter_mm(unit.volume(), diamond).unwrap();
        assert!((6.4..6.6).contains(&diameter), "{diameter}");
        let weight = diamond.carats(unit.volume() * (diameter / 2.0).powi(3)).unwrap();
        assert!((weight - 1.0).abs() < 1e-12);
        assert_eq!(Size::Millimetres(6.5).diameter_mm(unit.volume(), diamond), Ok(6.5));
    }

    #[test]
    fn a_weight_without_a_density_or_beyond_all_sizes_is_refused() {
        let (unit, glass) = (brilliant(), Material::from_index("index 2.42", 2.42).unwrap());
        let told = Size::Carats(1.0).diameter_mm(unit.volume(), &glass).unwrap_err().to_string();
        assert!(told.contains("which index 2.42 lacks; give the size in mm"), "{told}");
        let told =
            Size::Carats(1e9).diameter_mm(unit.volume(), material("ruby").unwrap()).unwrap_err().to_string();
        assert!(
            told.starts_with("1000000000 ct of ruby, ") && told.contains("from 0.1 to 1000 mm"),
            "{told}"
        );
        assert!(Size::Millimetres(f64::NAN).diameter_mm(unit.volume(), &glass).is_err());
    }
}
