//! A design: the content of a cut file about a stone.

use super::material::{MaterialError, MaterialRef};
use super::{Cut, ProportionError, TierFault, Tiers, Warning, names};
use brillianteer_math::{NotConvex, Plane};
use brillianteer_optics::{critical_angle, line};
use serde::{Deserialize, Serialize};

/// The girdle diameter of a design whose file gives none, mm: that of a brilliant of about one carat.
pub const DEFAULT_DIAMETER_MM: f64 = 6.5;

/// The most planes a design may list.
pub const MAX_PLANES: usize = 10_000;

/// The girdle diameters that a design may have, mm.
pub const DIAMETERS_MM: std::ops::RangeInclusive<f64> = 0.1..=1000.0;

/// A stone in a file: its cut, its material and its size.
///
/// Serde writes all of it, and reads any numbers: [`check`](Self::check) says whether they can be a design.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Design {
    /// The cut's name: printable, not blank, and at most 200 bytes long.
    pub name: String,
    /// The publication of the cut.
    pub source: Option<String>,
    /// Further text of the file about the cut.
    pub notes: Option<String>,
    /// The material of the stone.
    pub material: MaterialRef,
    /// The girdle diameter, mm, 0.1 to 1000. It is 2 in the stone's frame; absorption depends on it.
    pub diameter_mm: f64,
    /// The shape of the stone.
    pub cut: Cut,
}

/// The fault in a design.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DesignError {
    /// A name that is blank, too long or has control characters.
    #[error("name: a name of 1 to 200 printable characters is expected")]
    Name,
    /// A girdle diameter outside 0.1 to 1000 mm.
    #[error("diameter_mm: {value} must be from {} to {} mm", DIAMETERS_MM.start(), DIAMETERS_MM.end())]
    Diameter {
        /// The diameter in the file, mm.
        value: f64,
    },
    /// A material that is unknown, or whose numbers are impossible.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// Proportions that no cut of the family can have.
    #[error(transparent)]
    Proportion(#[from] ProportionError),
    /// Facets were requested of a design without planes: a mesh, or a smooth glass shape.
    #[error(transparent)]
    NotConvex(#[from] NotConvex),
    /// A list without planes, or with more than [`MAX_PLANES`].
    #[error("plane: {count} planes are given; from 1 to {MAX_PLANES} are expected")]
    PlaneCount {
        /// The number of planes in the list.
        count: usize,
    },
    /// A cutter's design that cuts no facets, or more than [`MAX_PLANES`].
    #[error("tier: {count} facets are cut; from 1 to {MAX_PLANES} are expected")]
    FacetCount {
        /// The number of facets that are cut.
        count: usize,
    },
    /// A cutter's design with a number out of its range.
    #[error("{}{fault}", .tier.map(|tier| format!("tier {tier}: ")).unwrap_or_default())]
    Tiers {
        /// The number of the tier, from 1; `None` where the gear or its offset is at fault.
        tier: Option<usize>,
        /// The fault of the tier, the gear or its offset.
        fault: TierFault,
    },
    /// A plane of the list that bounds nothing or has no valid name.
    #[error("plane {number}: {fault}")]
    Plane {
        /// The number of the plane, from 1, in the order of the list.
        number: usize,
        /// The fault of the plane.
        fault: PlaneFault,
    },
}

/// The fault in a plane of a list.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PlaneFault {
    /// A name that is blank, too long or has control characters.
    #[error("name: a name of 1 to 200 printable characters is expected")]
    Name,
    /// A normal that is zero or not finite.
    #[error("normal: {0} is not a direction; three finite numbers that are not all 0 are expected")]
    Normal(glam::DVec3),
    /// An offset that is not finite, or overflows when the normal is scaled to length 1.
    #[error("offset: {0} is not a finite number; give it in lengths of the normal")]
    Offset(f64),
}

impl PlaneFault {
    /// Returns the key of the cut file that is at fault.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Name => "name",
            Self::Normal(_) => "normal",
            Self::Offset(_) => "offset",
        }
    }
}

impl Design {
    /// Gives the design another name.
    ///
    /// Where the design comes from a cutter's file, the header that held the old name is changed too; if there is none, the
    /// new name becomes the first header.
    pub fn rename(&mut self, name: String) {
        if let Cut::Tiers(tiers) = &mut self.cut {
            let is_name = |header: &&mut String| header.trim() == self.name;
            match tiers.headers.iter_mut().find(is_name) {
                Some(header) => header.clone_from(&name),
                None => tiers.headers.insert(0, name.clone()),
            }
        }
        self.name = name;
    }

    /// Checks everything that can be checked without building the stone.
    ///
    /// # Errors
    /// The error names the first fault: of name, size, material, proportions or plane.
    pub fn check(&self) -> Result<(), DesignError> {
        if !names::is_printable(&self.name) {
            return Err(DesignError::Name);
        }
        if !DIAMETERS_MM.contains(&self.diameter_mm) {
            return Err(DesignError::Diameter { value: self.diameter_mm });
        }
        self.material.check()?;
        match &self.cut {
            Cut::Tiers(_) | Cut::Planes(_) => self.facets().map(|_| ()),
            Cut::RoundBrilliant(_) | Cut::Family(_) | Cut::Mesh(_) | Cut::Glass(_) => Ok(self.cut.check()?),
        }
    }

    /// Returns every facet's name, no two alike, and its plane with a unit normal.
    ///
    /// Lengths are in girdle radii, except for a cutter's design, whose lengths are in its own unit.
    ///
    /// # Errors
    /// The error names the first proportion or plane that is wrong; [`DesignError::NotConvex`] for a design without
    /// planes.
    pub fn facets(&self) -> Result<Vec<(String, Plane)>, DesignError> {
        match &self.cut {
            Cut::RoundBrilliant(proportions) => Ok(proportions.facets()?),
            Cut::Family(cut) => Ok(cut.facets()?),
            Cut::Tiers(tiers) => tiers_facets(tiers),
            Cut::Planes(planes) => named_planes(planes),
            Cut::Mesh(_) => Err(NotConvex.into()),
            Cut::Glass(glass) => {
                glass.field()?;
                glass.planes().ok_or_else(|| NotConvex.into())
            }
        }
    }

    /// Returns a warning for everything that is possible but unusual about this design. Only cuts of families have
    /// warnings. Pavilions are compared with the critical angle of the material in sodium light.
    ///
    /// # Errors
    /// The error names the first proportion that is wrong.
    pub fn warnings(&self) -> Result<Vec<Warning>, DesignError> {
        match &self.cut {
            Cut::RoundBrilliant(brilliant) => Ok(brilliant.warnings()?),
            Cut::Family(cut) => {
                let index = self.material.material()?.dispersion.try_index(line::SODIUM_D).ok();
                Ok(Warning::of_family(cut, index.and_then(critical_angle).map(f64::to_degrees)))
            }
            Cut::Tiers(_) | Cut::Planes(_) | Cut::Mesh(_) | Cut::Glass(_) => Ok(vec![]),
        }
    }
}

fn tiers_facets(tiers: &Tiers) -> Result<Vec<(String, Plane)>, DesignError> {
    tiers.check().map_err(|(tier, fault)| DesignError::Tiers { tier, fault })?;
    let count = tiers.count();
    if !(1..=MAX_PLANES).contains(&count) {
        return Err(DesignError::FacetCount { count });
    }
    Ok(tiers.facets())
}

fn named_planes(planes: &[(String, Plane)]) -> Result<Vec<(String, Plane)>, DesignError> {
    if !(1..=MAX_PLANES).contains(&planes.len()) {
        return Err(DesignError::PlaneCount { count: planes.len() });
    }
    let names = names::unique(planes.iter().map(|(name, _)| name.as_str()));
    let numbered = planes.iter().zip(names).enumerate();
    numbered
        .map(|(index, ((name, plane), unique))| match unit(name, plane) {
            Ok(plane) => Ok((unique, plane)),
            Err(fault) => Err(DesignError::Plane { number: index + 1, fault }),
        })
        .collect()
}

/// Returns the plane with a unit normal, or the fault of its name or numbers.
fn unit(name: &str, plane: &Plane) -> Result<Plane, PlaneFault> {
    if !names::is_printable(name) {
        return Err(PlaneFault::Name);
    }
    if !plane.normal.is_finite() || plane.normal == glam::DVec3::ZERO {
        return Err(PlaneFault::Normal(plane.normal));
    }
    plane.normalized().ok_or(PlaneFault::Offset(plane.offset))
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::{MODERN, RoundBrilliant};
    use super::*;
    use glam::DVec3;

    fn design(cut: Cut) -> Design {
        Design {
            name: "test".to_owned(),
            source: None,
            notes: None,
            material: MaterialRef::Name("diamond".to_owned()),
            diameter_mm: DEFAULT_DIAMETER_MM,
            cut,
        }
    }

    fn plane(name: &str, normal: [f64; 3], offset: f64) -> (String, Plane) {
        (name.to_owned(), Plane::new(DVec3::from_array(normal), offset))
    }

    fn text(planes: Vec<(String, Plane)>) -> String {
        design(Cut::Planes(planes)).check().unwrap_err().to_string()
    }

    #[test]
    fn planes_come_out_with_unit_normals_and_names_of_their_own() {
        let planes = vec![
            plane("table", [0.0, 0.0, 2.0], 1.0),
            plane("star", [3.0, 0.0, 4.0], 5.0),
            plane("facet", [1.0, 0.0, 0.0], 1.0),
            plane("star", [0.0, 1e-3, 0.0], 1e-3),
        ];
        let facets = design(Cut::Planes(planes)).facets().unwrap();
        let names: Vec<_> = facets.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["table", "star 1", "facet", "star 2"]);
        assert_eq!(facets[0].1, Plane::new(DVec3::Z, 0.5));
        assert_eq!(facets[1].1, Plane::new(DVec3::new(0.6, 0.0, 0.8), 1.0));
        assert!((facets[3].1.offset - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_brilliant_gives_its_facets_and_warnings() {
        let thin = RoundBrilliant { girdle_thickness: 1.0, ..MODERN };
        let design = design(Cut::RoundBrilliant(thin));
        assert!(design.check().is_ok());
        assert_eq!(design.facets().unwrap(), thin.facets().unwrap());
        assert_eq!(design.warnings().unwrap().len(), 1);
    }

    #[test]
    fn planes_that_bound_nothing_are_named_by_their_number() {
        let good = plane("table", [0.0, 0.0, 1.0], 1.0);
        let nowhere = "is not a direction; three finite numbers that are not all 0 are expected";
        for normal in [[0.0; 3], [f64::NAN, 0.0, 0.0], [f64::INFINITY, 0.0, 0.0]] {
            let text = text(vec![good.clone(), plane("x", normal, 1.0)]);
            assert!(text.starts_with("plane 2: normal: ") && text.ends_with(nowhere), "{text}");
        }
        let far = text(vec![plane("x", [0.0, 0.0, 1e-100], 1e300)]);
        assert!(far.starts_with("plane 1: offset: 1000"), "{far}");
        assert!(text(vec![plane("", [0.0, 0.0, 1.0], 1.0)]).starts_with("plane 1: name: "));
    }

    #[test]
    fn a_new_name_stands_among_the_headers_of_a_cutters_file() {
        let headers = vec!["PC 1".to_owned(), " test ".to_owned()];
        let tiers = Tiers { gear: 96, symmetry: 1, headers, ..Tiers::default() };
        let mut design = design(Cut::Tiers(tiers));
        let headers = |design: &Design| match &design.cut {
            Cut::Tiers(tiers) => tiers.headers.join("|"),
            _ => panic!(),
        };
        design.rename("mine".to_owned());
        assert_eq!((design.name.as_str(), headers(&design).as_str()), ("mine", "PC 1|mine"));
        design.name = "from its file's name".to_owned();
        design.rename("other".to_owned());
        assert_eq!(headers(&design), "other|PC 1|mine");
    }

    #[test]
    fn planes_must_be_some_and_not_too_many() {
        assert_eq!(text(vec![]), "plane: 0 planes are given; from 1 to 10000 are expected");
        let many = vec![plane("x", [0.0, 0.0, 1.0], 1.0); MAX_PLANES + 1];
        assert_eq!(text(many), "plane: 10001 planes are given; from 1 to 10000 are expected");
    }

    #[test]
    fn name_size_and_material_are_checked() {
        let good = design(Cut::RoundBrilliant(MODERN));
        let cases = [
            (
                Design { name: "\n".to_owned(), ..good.clone() },
                "name: a name of 1 to 200 printable characters is expected",
            ),
            (Design { diameter_mm: 0.0, ..good.clone() }, "diameter_mm: 0 must be from 0.1 to 1000 mm"),
            (
                Design { diameter_mm: f64::NAN, ..good.clone() },
                "diameter_mm: NaN must be from 0.1 to 1000 mm",
            ),
            (
                Design { material: MaterialRef::Index(0.0), ..good.clone() },
                "material: the index 0 must be from 1 (air) to 6",
            ),
        ];
        for (design, expected) in cases {
            assert_eq!(design.check().unwrap_err().to_string(), expected);
        }
        let flat = RoundBrilliant { table: 1.0, ..MODERN };
        let error = design(Cut::RoundBrilliant(flat)).warnings().unwrap_err();
        assert!(matches!(error, DesignError::Proportion(ProportionError::TooSmall(_))));
    }
}
