//! The keys of a cut file, in the order in which they are written.

use serde::{Deserialize, Serialize};

use super::material_form::MaterialForm;
use super::tier_form::{IndexForm, TierForm};
use super::values::{Numbers, TomlTable};
use super::{FORMAT, Fault};
use crate::cut::{
    Crown, Cut, DEFAULT_DIAMETER_MM, Design, DesignError, Glass, LowerHalf, MAX_PLANES, MaterialRef,
    MeshShape, Pavilion, Plate, RoundBrilliant, Sides, girdle_facets,
};
use crate::math::{Plane, Surface, TriangleMesh};
use glam::{DQuat, DVec3};
use std::collections::HashSet;

/// A whole cut file. `B` is its round brilliant, which has another form when read than when written. Values come before
/// tables, since TOML must be written so.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DesignForm<B = TomlTable<RoundBrilliantForm>> {
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
    round_brilliant: Option<B>,
    #[serde(skip_serializing_if = "Option::is_none")]
    index: Option<TomlTable<IndexForm>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tier: Option<Vec<TomlTable<TierForm>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    plane: Option<Vec<TomlTable<PlaneForm>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mesh: Option<TomlTable<MeshForm>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pill: Option<TomlTable<Sides>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cube: Option<TomlTable<Sides>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    prism: Option<TomlTable<Sides>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    plate: Option<TomlTable<Plate>>,
}

fn default_diameter() -> f64 {
    DEFAULT_DIAMETER_MM
}

/// The table `[round_brilliant]` as it is read, with both keys of each pair; [`RoundBrilliant`] itself is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RoundBrilliantForm {
    table: f64,
    crown_angle: Option<f64>,
    crown_height: Option<f64>,
    pavilion_angle: Option<f64>,
    pavilion_depth: Option<f64>,
    star_length: f64,
    lower_half_length: Option<f64>,
    lower_half_length_vertical: Option<f64>,
    girdle_thickness: f64,
    girdle_facets: i64,
    culet: f64,
}

/// A table `[[plane]]`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaneForm {
    #[serde(default = "nameless")]
    name: String,
    normal: Numbers<3>,
    offset: f64,
}

/// The table `[mesh]`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct MeshForm {
    vertices: Vec<Numbers<3>>,
    triangles: Vec<[u32; 3]>,
}

fn nameless() -> String {
    "facet".to_owned()
}

impl DesignForm<RoundBrilliant> {
    /// Returns the form in which a design is written.
    pub fn of(design: &Design) -> Self {
        let form = Self {
            format: FORMAT,
            name: design.name.clone(),
            source: design.source.clone(),
            notes: design.notes.clone(),
            diameter_mm: design.diameter_mm,
            material: MaterialForm::of(&design.material),
            round_brilliant: None,
            index: None,
            tier: None,
            plane: None,
            mesh: None,
            pill: None,
            cube: None,
            prism: None,
            plate: None,
        };
        match &design.cut {
            Cut::RoundBrilliant(given) => Self { round_brilliant: Some(*given), ..form },
            Cut::Tiers(tiers) => Self {
                index: Some(TomlTable(IndexForm::of(tiers))),
                tier: Some(tiers.tiers.iter().map(|tier| TomlTable(TierForm::of(tier))).collect()),
                ..form
            },
            Cut::Planes(planes) => Self {
                plane: Some(planes.iter().map(|plane| TomlTable(PlaneForm::of(plane))).collect()),
                ..form
            },
            Cut::Mesh(shape) => Self { mesh: Some(TomlTable(MeshForm::of(shape))), ..form },
            Cut::Glass(Glass::Pill(sides)) => Self { pill: Some(TomlTable(*sides)), ..form },
            Cut::Glass(Glass::Cube(sides)) => Self { cube: Some(TomlTable(*sides)), ..form },
            Cut::Glass(Glass::Prism(sides)) => Self { prism: Some(TomlTable(*sides)), ..form },
            Cut::Glass(Glass::Plate(plate)) => Self { plate: Some(TomlTable(*plate)), ..form },
        }
    }
}

impl DesignForm {
    /// Returns the design that the form describes, checked.
    pub fn design(self) -> Result<Design, Fault> {
        let Self { round_brilliant, index, tier, plane, mesh, pill, cube, prism, plate, .. } = self;
        let glass = [
            pill.map(|TomlTable(s)| ("pill", Glass::Pill(s))),
            cube.map(|TomlTable(s)| ("cube", Glass::Cube(s))),
            prism.map(|TomlTable(s)| ("prism", Glass::Prism(s))),
            plate.map(|TomlTable(p)| ("plate", Glass::Plate(p))),
        ];
        let mut glass = glass.into_iter().flatten();
        let (first, second) = (glass.next(), glass.next());
        if let (Some((one, _)), Some((other, _))) = (first, second) {
            return Err(Fault::key(other, format!("{other}: give [{one}] or [{other}], not both")));
        }
        let glass = first;
        let design = Design {
            name: self.name,
            source: self.source,
            notes: self.notes,
            material: self.material.material()?,
            diameter_mm: self.diameter_mm,
            cut: cut(Cuts { round_brilliant, index, tier, plane, mesh, glass })?,
        };
        match design.check() {
            Ok(()) => Ok(design),
            Err(error) => Err(Fault::key(path(&error, &design), error)),
        }
    }
}

/// The tables by which a file may give its cut.
struct Cuts {
    round_brilliant: Option<TomlTable<RoundBrilliantForm>>,
    index: Option<TomlTable<IndexForm>>,
    tier: Option<Vec<TomlTable<TierForm>>>,
    plane: Option<Vec<TomlTable<PlaneForm>>>,
    mesh: Option<TomlTable<MeshForm>>,
    /// A glass shape and the key of its table.
    glass: Option<(&'static str, Glass)>,
}

/// Returns the one cut that a file gives.
fn cut(form: Cuts) -> Result<Cut, Fault> {
    let Cuts { round_brilliant, index, tier, plane, mesh, glass } = form;
    let glass_key = glass.map_or("glass", |(key, _)| key);
    let glass_form = format!("[{glass_key}]");
    let given = [
        ("round_brilliant", "[round_brilliant]", round_brilliant.is_some()),
        ("tier", "[[tier]]", tier.is_some() || index.is_some()),
        ("plane", "[[plane]]", plane.is_some()),
        ("mesh", "[mesh]", mesh.is_some()),
        (glass_key, glass_form.as_str(), glass.is_some()),
    ];
    let mut given = given.into_iter().filter(|(.., is_given)| *is_given);
    if let (Some((_, first, _)), Some((key, other, _))) = (given.next(), given.next()) {
        let key = if key == "tier" && tier.is_none() { "index" } else { key };
        return Err(Fault::key(key, format!("{key}: give {first} or {other}, not both")));
    }
    if let Some(TomlTable(form)) = round_brilliant {
        return Ok(Cut::RoundBrilliant(form.proportions()?));
    }
    if let Some(planes) = plane {
        return Ok(Cut::Planes(planes.into_iter().map(|TomlTable(form)| form.plane()).collect()));
    }
    if let Some(TomlTable(form)) = mesh {
        return form.shape().map(Cut::Mesh);
    }
    if let Some((_, glass)) = glass {
        return Ok(Cut::Glass(glass));
    }
    match (index, tier) {
        (Some(TomlTable(index)), Some(tiers)) => Ok(Cut::Tiers(index.tiers(tiers)?)),
        (Some(_), None) => Err(Fault::key("index", "index: the tiers are missing; give [[tier]]")),
        (None, Some(_)) => {
            Err(Fault::key("tier", "tier: the gear is missing; give it as [index], gear = 96"))
        }
        (None, None) => Err("the cut is missing; give [round_brilliant], [[tier]], [[plane]], [mesh] or a glass shape such as [pill]".into()),
    }
}

/// Returns the path of the key whose value the design's check refuses.
fn path(error: &DesignError, design: &Design) -> String {
    match error {
        DesignError::Name => "name".to_owned(),
        DesignError::Diameter { .. } => "diameter_mm".to_owned(),
        DesignError::Material(error) => match design.material {
            MaterialRef::Custom(_) => format!("material/{}", error.key()),
            MaterialRef::Name(_) | MaterialRef::Index(_) => "material".to_owned(),
        },
        DesignError::Proportion(error) => format!("round_brilliant/{}", error.key()),
        DesignError::FacetCount { .. } => "tier".to_owned(),
        DesignError::Tiers { tier: None, fault } => format!("index/{}", fault.key()),
        DesignError::Tiers { tier: Some(number), fault } => format!("tier/{}/{}", number - 1, fault.key()),
        DesignError::NotConvex(_) => "mesh".to_owned(),
        DesignError::Glass(error) => match design.cut {
            Cut::Glass(glass) => format!("{}/{}", glass.called().0, error.key),
            _ => error.key.to_owned(),
        },
        DesignError::PlaneCount { .. } => format!("plane/{MAX_PLANES}"),
        DesignError::Plane { number, fault } => format!("plane/{}/{}", number - 1, fault.key()),
    }
}

impl RoundBrilliantForm {
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
                .map_err(|error| Fault::key("round_brilliant/girdle_facets", error))?,
            culet: self.culet,
        })
    }
}

/// Returns the value of a pair of keys, of which a file gives one. Each key comes with the function that takes its number;
/// both or neither is a fault.
fn either<T>(
    (first, a, of_first): (&str, Option<f64>, fn(f64) -> T),
    (second, b, of_second): (&str, Option<f64>, fn(f64) -> T),
) -> Result<T, Fault> {
    match (a, b) {
        (Some(number), None) => Ok(of_first(number)),
        (None, Some(number)) => Ok(of_second(number)),
        (Some(_), Some(_)) => Err(Fault::key(
            format!("round_brilliant/{second}"),
            format!("{second}: give {first} or {second}, not both"),
        )),
        (None, None) => Err(Fault::key(
            "round_brilliant",
            format!("round_brilliant: {first} or {second} is missing; give one"),
        )),
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

impl MeshForm {
    fn of(shape: &MeshShape) -> Self {
        let Surface { vertices, triangles, .. } = shape.surface();
        let vertices = vertices.iter().map(|v| Numbers(v.to_array())).collect();
        Self { vertices, triangles: triangles.clone() }
    }

    /// Returns the shape, moved into the stone's frame if it was written in another.
    fn shape(self) -> Result<MeshShape, Fault> {
        let fault = |message: String| Fault::key("mesh", format!("mesh: {message}"));
        let vertices: Vec<DVec3> = self.vertices.iter().map(|v| v.0.into()).collect();
        if let Some(corner) = vertices.iter().position(|v| !v.is_finite()) {
            return Err(fault(format!(
                "vertices: place {corner} is no point; three finite numbers are expected"
            )));
        }
        let mut is_used = vec![false; vertices.len()];
        let mut seen = HashSet::new();
        for (number, triangle) in self.triangles.iter().enumerate() {
            let mut corners = *triangle;
            corners
                .iter()
                .for_each(|&c| is_used.get_mut(c as usize).into_iter().for_each(|used| *used = true));
            corners.sort_unstable();
            if !seen.insert(corners) {
                return Err(fault(format!("triangles: {triangle:?}, at place {number}, is listed twice")));
            }
        }
        if let Some(corner) = is_used.iter().position(|used| !used) {
            return Err(fault(format!(
                "vertices: no triangle has the corner at place {corner}; leave it out"
            )));
        }
        let shell = TriangleMesh::new(Surface::new(vertices, self.triangles))
            .map_err(|error| fault(error.to_string()))?;
        let framed = MeshShape::framed(&shell, DQuat::IDENTITY);
        framed.map(|(shape, _)| shape).ok_or_else(|| fault("it has no extent across z".to_owned()))
    }
}
