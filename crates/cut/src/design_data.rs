//! The parts of a [`Design`](super::Design) as serde writes and reads them: cuts of families by the keys of their numbers, and
//! meshes as their surfaces.

use super::family::Family;
use super::family_cut::FamilyCut;
use super::mesh_shape::MeshShape;
use super::shape::Cut;
use brillianteer_base::ByName;
use brillianteer_math::{Surface, TriangleMesh, TriangleMeshError};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::sync::Arc;

/// A cut of a family as plain data.
#[derive(Serialize, Deserialize)]
struct FamilyNumbers {
    /// The key of the family.
    family: String,
    /// The numbers that the cut gives, by their keys and in their units. Those that are missing are those of the family's first
    /// cut.
    numbers: ByName<f64>,
}

/// The reason why numbers make no cut of a family.
#[derive(Debug, thiserror::Error)]
enum FamilyNumbersError {
    #[error("'{family}' is no family of cuts that is shaped by numbers alone")]
    Family { family: String },
    #[error("{family} has no number '{key}'")]
    Number { family: String, key: String },
}

// Written here and not derived there: the families themselves are cuts of families.
impl Serialize for FamilyCut {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        FamilyNumbers::from(*self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for FamilyCut {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        FamilyNumbers::deserialize(deserializer)?.try_into().map_err(D::Error::custom)
    }
}

impl From<FamilyCut> for FamilyNumbers {
    fn from(cut: FamilyCut) -> Self {
        let given = Cut::Family(cut);
        let numbers = given.given().map(|(row, value)| (row.key, value)).collect();
        Self { family: cut.family.key.to_owned(), numbers }
    }
}

impl TryFrom<FamilyNumbers> for FamilyCut {
    type Error = FamilyNumbersError;

    fn try_from(FamilyNumbers { family: name, numbers }: FamilyNumbers) -> Result<Self, FamilyNumbersError> {
        let found = Family::of_key(&name);
        let (Some(family), Some(mut cut)) = (found, found.map(|family| family.first.clone())) else {
            return Err(FamilyNumbersError::Family { family: name });
        };
        for (key, value) in numbers.iter() {
            let Some(row) = family.editable().find(|row| row.key == key) else {
                return Err(FamilyNumbersError::Number { family: name, key: key.to_owned() });
            };
            row.give(&mut cut, *value);
        }
        match cut {
            Cut::Family(cut) => Ok(cut),
            _ => Err(FamilyNumbersError::Family { family: name }),
        }
    }
}

impl From<MeshShape> for Surface {
    fn from(shape: MeshShape) -> Self {
        shape.surface().clone()
    }
}

impl TryFrom<Surface> for MeshShape {
    type Error = TriangleMeshError;

    fn try_from(surface: Surface) -> Result<Self, TriangleMeshError> {
        Ok(Self(Arc::new(TriangleMesh::new(surface)?)))
    }
}

#[cfg(test)]
mod tests {
    use crate::round_brilliant::MODERN;
    use crate::{
        Cut, Design, FAMILIES, Family, Glass, Indexed, MaterialRef, Meet, MeetPoint, MeshShape, Plate, Sides,
        Tier, Tiers,
    };
    use brillianteer_math::{Plane, Surface};
    use glam::DVec3;

    fn design(cut: Cut) -> Design {
        let material = MaterialRef::Name("diamond".to_owned());
        Design {
            name: "a".to_owned(),
            source: None,
            notes: Some("b".to_owned()),
            material,
            diameter_mm: 7.0,
            cut,
        }
    }

    fn comes_back(cut: Cut) {
        let given = design(cut);
        let text = serde_json::to_string(&given).unwrap();
        assert_eq!(serde_json::from_str::<Design>(&text).unwrap(), given, "{text}");
    }

    #[test]
    fn designs_of_every_kind_come_back_equal() {
        assert!(FAMILIES.len() > 20);
        for family in FAMILIES.iter().copied() {
            comes_back(family.first.clone());
            let mut other = family.first.clone();
            for (place, row) in family.editable().filter(|row| (row.is_given)(&family.first)).enumerate() {
                let value = (row.get)(&other);
                row.give(
                    &mut other,
                    value
                        + if row.unit == brillianteer_base::Unit::Count { 8.0 } else { 0.01 * place as f64 },
                );
            }
            comes_back(other);
        }
        comes_back(Cut::Planes(vec![("table".to_owned(), Plane::new(DVec3::Z, 0.1 + 0.2)); 2]));
        let sides = Sides { length: 90.0, width: 80.0, depth: 20.0, edge: 3.0 };
        comes_back(Cut::Glass(Glass::Plate(Plate { sides, amplitude: 1.0, wavelength: 30.0, phase: 45.0 })));
        let tier = |meet| Tier {
            angle: -41.7,
            distance: 0.3,
            instructions: "Cut to centre".to_owned(),
            meet,
            is_cut: true,
            frosting: 0.25,
            facets: vec![Indexed { index: 12.0, name: "P1".to_owned() }],
        };
        let corner = Meet::Points(vec![MeetPoint::LaterCorner { names: vec!["P1".to_owned()], reached: 2 }]);
        let tiers = vec![tier(None), tier(Some(corner)), tier(Some(Meet::CentreAngle(40.0)))];
        comes_back(Cut::Tiers(Tiers { gear: -96, symmetry: 8, mirror: true, tiers, ..Tiers::default() }));
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(DVec3::from_array);
        let surface = Surface::new(corners.into(), vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        comes_back(Cut::Mesh(MeshShape::try_from(surface).unwrap()));
    }

    #[test]
    fn unknown_families_and_numbers_are_named() {
        let oval = Family::of_key("oval").unwrap();
        let text = serde_json::to_string(&design(oval.first.clone())).unwrap();
        for (from, to, said) in [
            ("\"oval\"", "\"ovum\"", "'ovum' is no family"),
            ("\"crown_angle\"", "\"crown_slope\"", "oval has no number 'crown_slope'"),
        ] {
            assert!(text.contains(from), "{text}");
            let error = serde_json::from_str::<Design>(&text.replace(from, to)).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
        let brilliant = serde_json::to_string(&design(Cut::RoundBrilliant(MODERN))).unwrap();
        assert!(
            brilliant.contains(r#""cut":{"round_brilliant":{"table":56.0,"crown":{"angle":34.5}"#),
            "{brilliant}"
        );
    }
}
