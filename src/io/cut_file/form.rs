//! The keys of a cut file: one declaration for reading and writing, in the order they are written.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::material_form::MaterialForm;
use super::{FORMAT, Fault};
use crate::cut::{
    Crown, Cut, DEFAULT_DIAMETER_MM, Design, DesignError, LowerHalf, MaterialRef, Pavilion, RoundBrilliant,
    girdle_facets,
};
use crate::math::Plane;

/// The whole file. Values come before tables, as TOML wants them written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DesignForm {
    format: i64,
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    source: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    notes: Option<String>,
    #[serde(default = "default_diameter")]
    diameter_mm: f64,
    material: MaterialForm,
    #[serde(skip_serializing_if = "Option::is_none")]
    round_brilliant: Option<RoundBrilliantForm>,
    #[serde(skip_serializing_if = "Option::is_none")]
    plane: Option<Vec<PlaneForm>>,
}

fn default_diameter() -> f64 {
    DEFAULT_DIAMETER_MM
}

/// `[round_brilliant]`
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RoundBrilliantForm {
    table: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    crown_angle: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    crown_height: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pavilion_angle: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pavilion_depth: Option<f64>,
    star_length: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    lower_half_length: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lower_half_length_vertical: Option<f64>,
    girdle_thickness: f64,
    girdle_facets: i64,
    culet: f64,
}

/// `[[plane]]`
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaneForm {
    #[serde(default = "nameless")]
    name: String,
    normal: Numbers<3>,
    offset: f64,
}

fn nameless() -> String {
    "facet".to_owned()
}

/// A list of exactly so many numbers; serde's own arrays let more pass.
#[derive(Clone, Copy)]
pub(super) struct Numbers<const N: usize>(pub [f64; N]);

impl<'de, const N: usize> Deserialize<'de> for Numbers<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let numbers = Vec::deserialize(deserializer)?;
        let wrong = |list: Vec<f64>| {
            D::Error::custom(format!("invalid length {}, expected a list of {N} numbers", list.len()))
        };
        numbers.try_into().map(Self).map_err(wrong)
    }
}

impl<const N: usize> Serialize for Numbers<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0)
    }
}

impl DesignForm {
    /// The form that a design is written in.
    pub fn of(design: &Design) -> Self {
        let (round_brilliant, plane) = match &design.cut {
            Cut::RoundBrilliant(given) => (Some(RoundBrilliantForm::of(given)), None),
            Cut::Planes(planes) => (None, Some(planes.iter().map(PlaneForm::of).collect())),
        };
        Self {
            format: FORMAT,
            name: design.name.clone(),
            source: design.source.clone(),
            notes: design.notes.clone(),
            diameter_mm: design.diameter_mm,
            material: MaterialForm::of(&design.material),
            round_brilliant,
            plane,
        }
    }

    /// The design that the form describes, checked.
    pub fn design(self) -> Result<Design, Fault> {
        let design = Design {
            name: self.name,
            source: self.source,
            notes: self.notes,
            material: self.material.material()?,
            diameter_mm: self.diameter_mm,
            cut: cut(self.round_brilliant, self.plane)?,
        };
        match design.check() {
            Ok(()) => Ok(design),
            Err(error) => Err(Fault::at(path(&error, &design.material), error.to_string())),
        }
    }
}

fn cut(round_brilliant: Option<RoundBrilliantForm>, plane: Option<Vec<PlaneForm>>) -> Result<Cut, Fault> {
    match (round_brilliant, plane) {
        (Some(form), None) => Ok(Cut::RoundBrilliant(form.proportions()?)),
        (None, Some(planes)) => Ok(Cut::Planes(planes.into_iter().map(PlaneForm::plane).collect())),
        (Some(_), Some(_)) => Err(Fault::at("plane", "plane: give [round_brilliant] or [[plane]], not both")),
        (None, None) => Err(Fault::whole("the cut is missing; give [round_brilliant] or a list of [[plane]]")),
    }
}

/// Where a file says what the design's check refuses.
fn path(error: &DesignError, material: &MaterialRef) -> String {
    match error {
        DesignError::Name => "name".to_owned(),
        DesignError::Diameter { .. } => "diameter_mm".to_owned(),
        DesignError::Material(error) => match material {
            MaterialRef::Custom(_) => format!("material/{}", error.key()),
            MaterialRef::Name(_) | MaterialRef::Index(_) => "material".to_owned(),
        },
        DesignError::Proportion(error) => format!("round_brilliant/{}", error.key()),
        DesignError::PlaneCount { .. } => "plane".to_owned(),
        DesignError::Plane { number, fault } => format!("plane/{}/{}", number - 1, fault.key()),
    }
}

impl RoundBrilliantForm {
    fn of(given: &RoundBrilliant) -> Self {
        let (crown_angle, crown_height) = match given.crown {
            Crown::Angle(degrees) => (Some(degrees), None),
            Crown::Height(percent) => (None, Some(percent)),
        };
        let (pavilion_angle, pavilion_depth) = match given.pavilion {
            Pavilion::Angle(degrees) => (Some(degrees), None),
            Pavilion::Depth(percent) => (None, Some(percent)),
        };
        let (lower_half_length, lower_half_length_vertical) = match given.lower_half {
            LowerHalf::Radial(percent) => (Some(percent), None),
            LowerHalf::Vertical(percent) => (None, Some(percent)),
        };
        Self {
            table: given.table,
            crown_angle,
            crown_height,
            pavilion_angle,
            pavilion_depth,
            star_length: given.star_length,
            lower_half_length,
            lower_half_length_vertical,
            girdle_thickness: given.girdle_thickness,
            girdle_facets: i64::from(given.girdle_facets),
            culet: given.culet,
        }
    }

    fn proportions(&self) -> Result<RoundBrilliant, Fault> {
        Ok(RoundBrilliant {
            table: self.table,
            crown: either(
                ("crown_angle", self.crown_angle, Crown::Angle),
                ("crown_height", self.crown_height, Crown::Height),
            )?,
            pavilion: either(
                ("pavilion_angle", self.pavilion_angle, Pavilion::Angle),
                ("pavilion_depth", self.pavilion_depth, Pavilion::Depth),
            )?,
            star_length: self.star_length,
            lower_half: either(
                ("lower_half_length", self.lower_half_length, LowerHalf::Radial),
                ("lower_half_length_vertical", self.lower_half_length_vertical, LowerHalf::Vertical),
            )?,
            girdle_thickness: self.girdle_thickness,
            girdle_facets: girdle_facets(self.girdle_facets)
                .map_err(|error| Fault::at("round_brilliant/girdle_facets", error.to_string()))?,
            culet: self.culet,
        })
    }
}

/// One of a pair of keys, each with what it makes of its number; both or neither is a fault.
fn either<T>(
    (first, a, of_first): (&str, Option<f64>, fn(f64) -> T),
    (second, b, of_second): (&str, Option<f64>, fn(f64) -> T),
) -> Result<T, Fault> {
    match (a, b) {
        (Some(number), None) => Ok(of_first(number)),
        (None, Some(number)) => Ok(of_second(number)),
        (Some(_), Some(_)) => Err(Fault::at(
            format!("round_brilliant/{second}"),
            format!("{second}: give {first} or {second}, not both"),
        )),
        (None, None) => {
            Err(Fault::at("round_brilliant", format!("round_brilliant: {first} or {second} is missing; give one")))
        }
    }
}

impl PlaneForm {
    fn of((name, plane): &(String, Plane)) -> Self {
        Self { name: name.clone(), normal: Numbers(plane.normal.to_array()), offset: plane.offset }
    }

    fn plane(self) -> (String, Plane) {
        (self.name, Plane::new(self.normal.0.into(), self.offset))
    }
}
