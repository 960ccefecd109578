//! The options by which a mesh is read, since its file states neither which way its table faces, nor whether its
//! triangles stand for flat facets, nor which of several solids is meant, nor, in most formats, how long its unit is.

use brillianteer_cut::Size;
use brillianteer_cut::from_mesh::{Evening, Up};
use serde::{Deserialize, Serialize};
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;
use std::sync::Arc;

/// The options by which a mesh is read as a stone. By default all are found from its shape and its format.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeshOptions {
    /// The direction in which the table faces, in the mesh's own frame.
    pub up: Up,
    /// The form of the stone: between planes, or within triangles.
    pub form: MeshForm,
    /// The unit of the file, from which the size of the stone follows.
    pub unit: MeshUnit,
    /// The solid that is read of a mesh that has several.
    pub part: MeshPart,
    /// Whether planes are given the symmetry that they have except for noise.
    pub evening: Evening,
}

impl MeshOptions {
    /// Returns the same options for a stone whose size is given elsewhere, if it is: the file's unit then matters no more.
    pub fn sized(self, size: Option<Size>) -> Self {
        if size.is_some() { self.of_any_size() } else { self }
    }

    /// Returns the same options for a stone of which only the shape matters; a unit that is given stays.
    pub fn of_any_size(self) -> Self {
        let unit = if self.unit == MeshUnit::Found { MeshUnit::Unneeded } else { self.unit };
        Self { unit, ..self }
    }

    /// Returns whether any option is given that only meshes have.
    pub fn is_given(&self) -> bool {
        let is_unit_given = matches!(self.unit, MeshUnit::Millimetres(_));
        Self { unit: MeshUnit::Found, ..self.clone() } != Self::default() || is_unit_given
    }
}

/// The solid that is read of a mesh that has several.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum MeshPart {
    /// The largest one that is more than a box.
    #[default]
    Found,
    /// All of them, as one stone.
    All,
    /// The one with this number, from 1, in the order of the file.
    Number(usize),
    /// The one with this name in the file.
    Named(Arc<str>),
}

impl From<&str> for MeshPart {
    /// Reads what a person writes: `all`, a number, or a name. An empty text stands for the one that is found.
    fn from(text: &str) -> Self {
        match (text.trim(), text.trim().parse()) {
            ("", _) => Self::Found,
            ("all", _) => Self::All,
            (_, Ok(number)) => Self::Number(number),
            (name, Err(_)) => Self::Named(name.into()),
        }
    }
}

impl Display for MeshPart {
    /// Writes the text that is read as this part.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Found => Ok(()),
            Self::All => f.write_str("all"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Named(name) => f.write_str(name),
        }
    }
}

/// The form in which the triangles of a mesh are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MeshForm {
    /// The shape decides: facets where the mesh means a convex stone, else triangles.
    #[default]
    Found,
    /// The flat facets of a convex stone, which exact beams, scopes and drawings need.
    Faceted,
    /// The triangles themselves, which rays trace.
    Triangles,
}

/// The number of millimetres in a metre.
pub const METRE: f64 = 1000.0;

/// The lengths in mm that one unit of a file may have: from beyond a nanometre to beyond a kilometre.
const UNITS_MM: std::ops::RangeInclusive<f64> = 1e-9..=1e9;

/// The length of a mesh file's unit.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MeshUnit {
    /// By the statement of the file, or else by its format: metres in glTF, millimetres in the others, where the stone then
    /// has a plausible size.
    #[default]
    Found,
    /// One unit is so many mm.
    Millimetres(f64),
    /// The size of the stone is given elsewhere, so that the unit does not matter.
    Unneeded,
}

impl MeshUnit {
    /// The units that have names: each with the symbol and the number of mm.
    pub const NAMED: [(&str, f64); 5] = [("mm", 1.0), ("cm", 10.0), ("m", METRE), ("in", 25.4), ("um", 1e-3)];
}

/// The error of a text that is no unit.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("'{text}' is not a unit; give mm, cm, m, in, um, or the length of one unit in mm, such as 0.5mm")]
pub struct MeshUnitError {
    /// The text as given, at most 80 characters of it.
    text: String,
}

impl FromStr for MeshUnit {
    type Err = MeshUnitError;

    fn from_str(text: &str) -> Result<Self, MeshUnitError> {
        let lower = text.trim().to_lowercase();
        let named = Self::NAMED.iter().find(|(name, _)| *name == lower).map(|(_, mm)| *mm);
        let length = || lower.strip_suffix("mm")?.trim_end().parse().ok();
        let mm = named.or_else(length).filter(|mm| UNITS_MM.contains(mm));
        mm.map(Self::Millimetres).ok_or_else(|| MeshUnitError { text: text.chars().take(80).collect() })
    }
}

impl fmt::Display for MeshUnit {
    /// Writes the unit as [`from_str`](Self::from_str) reads it; a unit that is not given is `automatic`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Millimetres(mm) = self else { return f.write_str("automatic") };
        match Self::NAMED.iter().find(|(_, named)| named == mm) {
            Some((name, _)) => f.write_str(name),
            None => write!(f, "{mm}mm"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_a_name_or_a_length_and_is_written_as_it_is_read() {
        for (text, mm) in
            [("mm", 1.0), ("CM", 10.0), (" m ", 1000.0), ("in", 25.4), ("um", 1e-3), ("0.5 mm", 0.5)]
        {
            let unit: MeshUnit = text.parse().unwrap();
            assert_eq!(unit, MeshUnit::Millimetres(mm), "{text}");
            assert_eq!(unit.to_string().parse(), Ok(unit));
        }
        for text in ["", "6.5", "feet", "0mm", "-1mm", "nanmm", "infmm", "1e99mm"] {
            let error = text.parse::<MeshUnit>().unwrap_err().to_string();
            assert!(error.starts_with(&format!("'{text}' is not a unit; give mm, cm")), "{error}");
        }
    }

    #[test]
    fn a_size_given_elsewhere_leaves_a_unit_that_is_given() {
        let size = Some(Size::Millimetres(7.0));
        let of = |unit| MeshOptions { unit, ..MeshOptions::default() };
        assert_eq!(of(MeshUnit::Found).sized(size).unit, MeshUnit::Unneeded);
        assert_eq!(of(MeshUnit::Found).sized(None).unit, MeshUnit::Found);
        let inch = MeshUnit::Millimetres(25.4);
        assert_eq!(of(inch).sized(size).unit, inch);
        assert!(of(inch).is_given() && !of(MeshUnit::Found).sized(size).is_given());
    }

    #[test]
    fn a_part_is_read_as_it_is_written() {
        for (text, part) in [
            ("", MeshPart::Found),
            ("all", MeshPart::All),
            (" 12 ", MeshPart::Number(12)),
            ("Stone 2", MeshPart::Named("Stone 2".into())),
            ("-1", MeshPart::Named("-1".into())),
        ] {
            assert_eq!(MeshPart::from(text), part);
            assert_eq!(MeshPart::from(part.to_string().as_str()), part);
        }
    }
}
