//! The keys of a cut file, in the order in which they are written.

use serde::{Deserialize, Serialize};

use super::family_form::FamilyForm;
use super::material_form::{MaterialForm, path_of};
use super::tier_form::TierForm;
use super::values::{Numbers, TomlTable};
use crate::toml_format::FORMAT;
use brillianteer_base::Fault;
use brillianteer_cut::{Cut, DEFAULT_DIAMETER_MM, Design, DesignError, MAX_PLANES, MeshShape, Tiers};
use brillianteer_math::{Plane, Surface, TriangleMesh};
use glam::{DQuat, DVec3};
use std::collections::HashSet;

/// A whole cut file except for the table of a family. Values come before tables, since TOML must be written so.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DesignForm {
    format: i64,
    name: String,
    source: Option<String>,
    notes: Option<String>,
    #[serde(default = "default_diameter")]
    diameter_mm: f64,
    material: MaterialForm,
    index: Option<TomlTable<Tiers>>,
    tier: Option<Vec<TomlTable<TierForm>>>,
    plane: Option<Vec<TomlTable<PlaneForm>>>,
    mesh: Option<TomlTable<MeshForm>>,
}

fn default_diameter() -> f64 {
    DEFAULT_DIAMETER_MM
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

impl DesignForm {
    /// Returns the form in which a design is written, without the table of its family.
    pub fn of(design: &Design) -> Self {
        let form = Self {
            format: FORMAT,
            name: design.name.clone(),
            source: design.source.clone(),
            notes: design.notes.clone(),
            diameter_mm: design.diameter_mm,
            material: MaterialForm::of(&design.material),
            index: None,
            tier: None,
            plane: None,
            mesh: None,
        };
        match &design.cut {
            Cut::RoundBrilliant(_) | Cut::Family(_) | Cut::Glass(_) => form,
            Cut::Tiers(tiers) => Self {
                index: Some(TomlTable(tiers.clone())),
                tier: Some(tiers.tiers.iter().map(|tier| TomlTable(TierForm::of(tier))).collect()),
                ..form
            },
            Cut::Planes(planes) => Self {
                plane: Some(planes.iter().map(|plane| TomlTable(PlaneForm::of(plane))).collect()),
                ..form
            },
            Cut::Mesh(shape) => Self { mesh: Some(TomlTable(MeshForm::of(shape))), ..form },
        }
    }

    /// Returns the design that the form describes with the tables of families beside it, checked.
    pub fn design(mut self, families: &[FamilyForm]) -> Result<Design, Fault> {
        let cut = self.cut(families);
        let design = Design {
            name: self.name,
            source: self.source,
            notes: self.notes,
            material: self.material.material()?,
            diameter_mm: self.diameter_mm,
            cut: cut?,
        };
        match design.check() {
            Ok(()) => Ok(design),
            Err(error) => Err(Fault::key(path(&error, &design), error)),
        }
    }

    /// Takes the one cut that a file gives out of its tables.
    fn cut(&mut self, families: &[FamilyForm]) -> Result<Cut, Fault> {
        let families_given =
            families.iter().map(|form| (form.family.key, format!("[{}]", form.family.key), true));
        let others = [
            ("tier", "[[tier]]".to_owned(), self.tier.is_some() || self.index.is_some()),
            ("plane", "[[plane]]".to_owned(), self.plane.is_some()),
            ("mesh", "[mesh]".to_owned(), self.mesh.is_some()),
        ];
        let mut given = families_given.chain(others).filter(|(.., is_given)| *is_given);
        if let (Some((_, first, _)), Some((key, other, _))) = (given.next(), given.next()) {
            let key = if key == "tier" && self.tier.is_none() { "index" } else { key };
            return Err(Fault::key(key, format!("{key}: give {first} or {other}, not both")));
        }
        if let Some(form) = families.first() {
            return form.cut();
        }
        if let Some(planes) = self.plane.take() {
            return Ok(Cut::Planes(planes.into_iter().map(|TomlTable(form)| form.plane()).collect()));
        }
        if let Some(TomlTable(form)) = self.mesh.take() {
            return form.shape().map(Cut::Mesh);
        }
        match (self.index.take(), self.tier.take()) {
            (Some(TomlTable(index)), Some(tiers)) => {
                let tier = |(place, TomlTable(form)): (usize, TomlTable<TierForm>)| form.tier(place);
                let tiers = tiers.into_iter().enumerate().map(tier).collect::<Result<_, _>>()?;
                Ok(Cut::Tiers(Tiers { tiers, ..index }))
            }
            (Some(_), None) => Err(Fault::key("index", "index: the tiers are missing; give [[tier]]")),
            (None, Some(_)) => {
                Err(Fault::key("tier", "tier: the gear is missing; give it as [index], gear = 96"))
            }
            (None, None) => Err("the cut is missing; give [round_brilliant], [[tier]], [[plane]], [mesh] or a glass shape such as [pill]".into()),
        }
    }
}

/// Returns the path of the key whose value the design's check refuses.
fn path(error: &DesignError, design: &Design) -> String {
    match error {
        DesignError::Name => "name".to_owned(),
        DesignError::Diameter { .. } => "diameter_mm".to_owned(),
        DesignError::Material(error) => path_of(error, &design.material),
        DesignError::Proportion(error) => {
            format!("{}/{}", design.cut.family().map_or("", |family| family.key), error.row().key)
        }
        DesignError::FacetCount { .. } => "tier".to_owned(),
        DesignError::Tiers { tier: None, fault } => format!("index/{}", fault.key()),
        DesignError::Tiers { tier: Some(number), fault } => format!("tier/{}/{}", number - 1, fault.key()),
        DesignError::NotConvex(_) => "mesh".to_owned(),
        DesignError::PlaneCount { .. } => format!("plane/{MAX_PLANES}"),
        DesignError::Plane { number, fault } => format!("plane/{}/{}", number - 1, fault.key()),
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
                "vertices: place {corner} is not a point; three finite numbers are expected"
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
        let mesh = TriangleMesh::new(Surface::new(vertices, self.triangles))
            .map_err(|error| fault(error.to_string()))?;
        let framed = MeshShape::framed(&mesh, DQuat::IDENTITY);
        framed.map(|(shape, _)| shape).ok_or_else(|| fault("it has no extent across z".to_owned()))
    }
}
