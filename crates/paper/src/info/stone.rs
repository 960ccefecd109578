//! The geometry, proportions and weight of a stone.

use brillianteer_base::{ByName, Unit};
use brillianteer_cut::from_mesh::FacetError;
use brillianteer_cut::{
    CountedAudit, Cut, Derived, MeshHeights, ProportionError, ProportionReport, TierMeet, tier_stem,
};
use brillianteer_files::mesh::MeshBody;
use brillianteer_math::{Facet, Polytope, TriangleMesh};
use brillianteer_scene::{Body, Specimen, Stone};
use glam::{DVec2, DVec3};
use serde::{Deserialize, Deserializer, Serialize};

/// The tilt of a facet's normal, as the sine of its angle to the axis, up to which rounding alone would choose an azimuth.
/// Such a facet counts as level and has the azimuth 0.
const LEVEL: f64 = 1e-12;

/// The distance from 360 degrees, in degrees, below which an azimuth counts as 0: the rest is rounding.
const ROUNDING_DEG: f64 = 1e-9;

/// A stone. Lengths are in girdle radii unless their names say otherwise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StoneInfo {
    /// The path of the file, or the name of a cut that comes with the program.
    pub file: String,
    /// The name of the design.
    pub name: String,
    /// The publication of the cut.
    pub source: Option<String>,
    /// Further text of the file about the cut.
    pub notes: Option<String>,
    /// The name of the material.
    pub material: String,
    /// The girdle diameter, mm.
    pub diameter_mm: f64,
    /// The weight, carats; `None` where the material's density is not known.
    pub carats: Option<f64>,
    /// The numbers that the design gives, by their keys and in their units; `None` where no family shapes it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub given: Option<ByName<GivenNumber>>,
    /// The numbers that follow from them; only of round brilliants.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub derived: Option<Derived>,
    /// The bodies of a mesh that has several, closed ones first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<BodyInfo>,
    /// The volume, girdle radii³.
    pub volume: f64,
    /// The extents along x, y and z.
    pub size: [f64; 3],
    /// The numbers of a solid of triangles; `None` of others.
    #[serde(flatten)]
    pub mesh: Option<MeshInfo>,
    /// The facets of a convex stone between planes; `None` of others.
    #[serde(flatten)]
    pub faceted: Option<FacetedInfo>,
    /// The meets of the tiers, where they were requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub meets: Option<Vec<TierMeet>>,
    /// The audit, where it was requested: `Some(None)` of a solid that cannot be audited.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "requested")]
    pub audit: Option<Option<CountedAudit>>,
}

/// A number that a design gives.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum GivenNumber {
    /// A count, such as that of girdle facets.
    Count(i64),
    /// A number in percent or degrees, or a ratio.
    Number(f64),
}

/// A body of a mesh that has several.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodyInfo {
    /// The number, from 1, by which it can be chosen; `None` of an open one, which is left out.
    pub number: Option<usize>,
    /// The name in the file; may be empty.
    pub name: String,
    /// The number of triangles.
    pub triangles: usize,
    /// True where it is a closed surface.
    pub is_closed: bool,
    /// The lengths along the file's x, y and z, in the file's unit.
    pub extent: [f64; 3],
    /// The number of the body around it; `None` where there is none.
    pub inside: Option<usize>,
    /// True where the design was made of it.
    pub is_read: bool,
}

/// The numbers of a solid of triangles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeshInfo {
    /// The number of triangles.
    pub triangles: usize,
    /// The number of corners.
    pub corners: usize,
    /// The heights; `None` without an upright girdle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heights: Option<MeshHeights>,
    /// The tiers of a family's stone; empty of other solids.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tiers: Vec<TierCount>,
}

/// A tier of a solid of triangles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TierCount {
    /// The name of the tier.
    pub name: String,
    /// The number of its facets.
    pub facets: usize,
}

/// The facets of a convex stone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FacetedInfo {
    /// The proportions and tiers, measured on the solid.
    pub measured: ProportionReport,
    /// The area of the surface, girdle radii².
    pub surface_area: f64,
    /// The area seen along the axis, girdle radii².
    pub silhouette_area: f64,
    /// The number of edges.
    pub edges: usize,
    /// The corners.
    pub vertices: Vec<[f64; 3]>,
    /// The facets.
    pub facets: Vec<FacetInfo>,
}

/// A facet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FacetInfo {
    /// The name.
    pub name: String,
    /// The outward normal, of length 1.
    pub normal: [f64; 3],
    /// The distance of its plane from the origin along the normal.
    pub offset: f64,
    /// The slope from the girdle plane, degrees, 0 to 90.
    pub slope_deg: f64,
    /// The azimuth of the normal, degrees, from 0 to below 360; 0 of a level facet.
    pub azimuth_deg: f64,
    /// The area, girdle radii².
    pub area: f64,
    /// The places of its corners among `vertices`, counter-clockwise seen from outside.
    pub corners: Vec<u32>,
    /// The errors of a facet that was found in a scan; `None` of others.
    #[serde(flatten)]
    pub uncertainty: Option<FacetUncertainty>,
    /// The frosting: 0 polished, 1 as rough as possible.
    #[serde(default, skip_serializing_if = "is_polished")]
    pub frosting: f64,
}

/// The errors of a facet that was found in a scan.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FacetUncertainty {
    /// The standard error of the slope, degrees.
    pub slope_error_deg: f64,
    /// The standard error of the azimuth, degrees; `None` of a level facet.
    pub azimuth_error_deg: Option<f64>,
    /// True where the facet bends by more than noise, so that it may be several.
    pub may_be_several: bool,
}

/// Reads a value that was written because it was requested, also where there is none.
fn requested<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Option<CountedAudit>>, D::Error> {
    Option::deserialize(deserializer).map(Some)
}

fn is_polished(frosting: &f64) -> bool {
    *frosting <= 0.0
}

impl StoneInfo {
    /// Describes a stone of a file. `errors` are those of the facets that were found in a scan, and `bodies` those of a mesh
    /// that has several.
    ///
    /// # Errors
    /// Fails for a round brilliant of impossible proportions, of which no specimen is made.
    pub fn of(
        file: &str,
        specimen: &Specimen,
        errors: &[FacetError],
        bodies: &[MeshBody],
    ) -> Result<Self, ProportionError> {
        let design = &specimen.design;
        let derived = match &design.cut {
            Cut::RoundBrilliant(brilliant) => Some(brilliant.derived()?),
            _ => None,
        };
        let (low, high) = specimen.solid().bounds();
        Ok(Self {
            file: file.to_owned(),
            name: design.name.clone(),
            source: design.source.clone(),
            notes: design.notes.clone(),
            material: specimen.material.name.clone(),
            diameter_mm: design.diameter_mm,
            carats: specimen.carats(),
            given: design.cut.family().map(|_| given(&design.cut)),
            derived,
            bodies: bodies.iter().map(BodyInfo::of).collect(),
            volume: specimen.solid().volume(),
            size: (high - low).to_array(),
            mesh: match &*specimen.body {
                Body::Mesh(mesh) => Some(MeshInfo::of(mesh)),
                Body::Stone(_) | Body::Glass(_) => None,
            },
            faceted: specimen.stone().ok().map(|stone| FacetedInfo::of(&design.cut, stone, errors)),
            meets: None,
            audit: None,
        })
    }
}

/// Returns the numbers that a cut of a family gives.
fn given(cut: &Cut) -> ByName<GivenNumber> {
    let number = |value: f64, unit| match unit {
        Unit::Count => GivenNumber::Count(value as i64),
        _ => GivenNumber::Number(value),
    };
    cut.given().map(|(row, value)| (row.key, number(value, row.unit))).collect()
}

impl GivenNumber {
    /// Returns the number.
    pub fn value(self) -> f64 {
        match self {
            Self::Count(count) => count as f64,
            Self::Number(number) => number,
        }
    }
}

impl BodyInfo {
    fn of(body: &MeshBody) -> Self {
        Self {
            number: body.number,
            name: body.name.clone(),
            triangles: body.triangles,
            is_closed: body.number.is_some(),
            extent: body.extent.to_array(),
            inside: body.within,
            is_read: body.is_read,
        }
    }
}

impl MeshInfo {
    fn of(mesh: &TriangleMesh) -> Self {
        let mut tiers: Vec<TierCount> = vec![];
        for name in mesh.facet_names().into_iter().map(tier_stem) {
            match tiers.iter_mut().find(|tier| tier.name == name) {
                Some(tier) => tier.facets += 1,
                None => tiers.push(TierCount { name: name.to_owned(), facets: 1 }),
            }
        }
        Self {
            triangles: mesh.surface().triangles.len(),
            corners: mesh.vertices().len(),
            heights: MeshHeights::of(mesh),
            tiers,
        }
    }
}

impl FacetedInfo {
    fn of(cut: &Cut, stone: &Stone, errors: &[FacetError]) -> Self {
        let polytope = &stone.polytope;
        let facet = |(facet, name): (&Facet, &String)| {
            FacetInfo::of(polytope, facet, name, errors.iter().find(|error| error.facet == *name))
        };
        Self {
            measured: ProportionReport::of_cut(cut, polytope, stone.names()),
            surface_area: polytope.surface_area(),
            silhouette_area: polytope.silhouette_area(DVec3::Z),
            edges: polytope.edge_count(),
            vertices: polytope.vertices().iter().map(|vertex| vertex.to_array()).collect(),
            facets: polytope.facets().iter().zip(stone.names()).map(facet).collect(),
        }
    }
}

impl FacetInfo {
    fn of(polytope: &Polytope, facet: &Facet, name: &str, error: Option<&FacetError>) -> Self {
        let normal = facet.plane.normal;
        let across = normal.truncate();
        Self {
            name: name.to_owned(),
            normal: normal.to_array(),
            // Adding 0.0 turns -0.0 into 0.0, for planes through the origin.
            offset: facet.plane.offset + 0.0,
            slope_deg: across.length().atan2(normal.z.abs()).to_degrees(),
            azimuth_deg: azimuth_deg(across),
            area: polytope.facet_area(facet),
            corners: facet.outline.clone(),
            uncertainty: error.map(|error| FacetUncertainty {
                slope_error_deg: error.slope_deg,
                azimuth_error_deg: error.azimuth_deg,
                may_be_several: error.is_bent,
            }),
            frosting: facet.frosting,
        }
    }
}

/// Returns the azimuth of a normal's part in the girdle plane, in degrees from 0 to below 360; 0 for a level facet.
fn azimuth_deg(across: DVec2) -> f64 {
    if across.length() <= LEVEL {
        return 0.0;
    }
    let azimuth = across.to_angle().to_degrees().rem_euclid(360.0);
    // An angle that rounding has put just below 0 becomes 360, or just less.
    if 360.0 - azimuth < ROUNDING_DEG { 0.0 } else { azimuth }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_files::{cut_file, library};

    fn info(cut: &str) -> StoneInfo {
        let design = cut_file::parse(library::cut(cut).unwrap(), cut).unwrap();
        StoneInfo::of(cut, &Specimen::new(design).unwrap(), &[], &[]).unwrap()
    }

    #[test]
    fn rounding_makes_no_full_turn() {
        for angle in [-1e-17, -1e-12, 0.0, 1e-17] {
            assert!(azimuth_deg(DVec2::from_angle(angle)) < 1e-9, "{angle}");
        }
        assert!((azimuth_deg(DVec2::from_angle(-1e-6)) - 359.999_942_7).abs() < 1e-6);
    }

    #[test]
    fn a_described_stone_is_written_and_read_back_equal() {
        for cut in ["tolkowsky", "oval", "heart", "pill"] {
            let mut info = info(cut);
            info.audit = (cut == "heart").then_some(None);
            let text = serde_json::to_string(&info).unwrap();
            assert_eq!(serde_json::from_str::<StoneInfo>(&text).unwrap(), info, "{cut}");
            assert_eq!(
                (info.mesh.is_some(), info.faceted.is_none()),
                (cut == "heart", "heart pill".contains(cut))
            );
        }
    }
}
