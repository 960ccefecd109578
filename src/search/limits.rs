//! Limits on the geometry of a stone.

use super::appraisal::SearchError;
use super::goal::Goal;
use crate::cut::{Cut, Design, Proportion, ProportionReport, SheetFigures};
use crate::optics::{critical_angle, line};
use crate::scene::{Specimen, Stone};

/// The names of limits that any cut has, besides the keys of its proportions:
///
/// - `above_critical`: the degrees by which the flattest facet of the pavilion is steeper than the critical angle, in
///   the material of the goal with the lowest index;
/// - `yield`: the volume in cubes of the width, as a part of that of the design before the search;
/// - the ratios of a cutter's sheet ([`SheetFigures`]), all measured on the stone.
pub const LIMIT_NAMES: [&str; 9] = [
    "above_critical",
    "yield",
    "length_to_width",
    "table_to_width",
    "pavilion_to_width",
    "crown_to_width",
    "girdle_to_width",
    "height_to_width",
    "volume_to_width_cubed",
];

/// A limit on the geometry.
pub(super) struct GeometryLimit {
    pub name: String,
    kind: LimitKind,
    /// The least and the greatest value; infinite where there is none.
    pub ends: (f64, f64),
}

enum LimitKind {
    /// A proportion of the cut's family.
    Proportion(&'static Proportion),
    /// A ratio of the sheet, and its divisor.
    Ratio(fn(&SheetFigures) -> f64, f64),
    /// Degrees above this critical angle, degrees.
    AboveCritical(f64),
}

impl GeometryLimit {
    /// Returns the limits of a goal for a design, which makes `stone`.
    pub fn all(goal: &Goal, design: &Design, stone: &Stone) -> Result<Vec<Self>, SearchError> {
        let limit = |name: &String, ends| {
            let kind = LimitKind::of(name, goal, design, stone)?;
            Ok(Self { name: name.clone(), kind, ends })
        };
        goal.limit.iter().map(|(name, given)| limit(name, given.ends())).collect()
    }

    /// Returns the value of the limited figure.
    pub fn value(&self, cut: &Cut, stone: &Stone) -> f64 {
        match self.kind {
            LimitKind::Proportion(row) => (row.get)(cut),
            LimitKind::Ratio(of, unit) => of(&figures(stone)) / unit,
            LimitKind::AboveCritical(critical_deg) => flattest_deg(stone) - critical_deg,
        }
    }
}

impl LimitKind {
    fn of(name: &str, goal: &Goal, design: &Design, stone: &Stone) -> Result<Self, SearchError> {
        if let Some(row) = design.cut.proportion(name) {
            return Ok(Self::Proportion(row));
        }
        let ratio: fn(&SheetFigures) -> f64 = match name {
            "above_critical" => return Ok(Self::AboveCritical(critical_deg(goal, design)?)),
            "yield" => |figures| figures.volume_to_width_cubed,
            "length_to_width" => |figures| figures.length_to_width,
            "table_to_width" => |figures| figures.table_to_width,
            "pavilion_to_width" => |figures| figures.pavilion_to_width,
            "crown_to_width" => |figures| figures.crown_to_width,
            "girdle_to_width" => |figures| figures.girdle_to_width,
            "height_to_width" => |figures| figures.height_to_width,
            "volume_to_width_cubed" => |figures| figures.volume_to_width_cubed,
            _ => {
                let rows = design.cut.proportions().iter().map(|row| row.key);
                let known: Vec<&str> = LIMIT_NAMES.into_iter().chain(rows).collect();
                return Err(SearchError::NoLimit { name: name.to_owned(), known: known.join(", ") });
            }
        };
        let unit = if name == "yield" { ratio(&figures(stone)) } else { 1.0 };
        Ok(Self::Ratio(ratio, unit))
    }
}

fn figures(stone: &Stone) -> SheetFigures {
    SheetFigures::of(&stone.polytope, stone.names())
}

/// Returns the slope of the flattest facet of the pavilion, degrees; 90 without one.
fn flattest_deg(stone: &Stone) -> f64 {
    let tiers = ProportionReport::of(&stone.polytope, stone.names()).tiers;
    let pavilion = tiers.iter().filter(|tier| tier.zone == "pavilion");
    pavilion.map(|tier| tier.slope_deg.least).fold(90.0, f64::min)
}

/// Returns the greatest critical angle of the goal's materials, degrees.
fn critical_deg(goal: &Goal, design: &Design) -> Result<f64, SearchError> {
    let mut greatest: f64 = 0.0;
    for material in super::terms::materials(goal) {
        let mut design = design.clone();
        if let Some(material) = material {
            design.material = material.reference();
        }
        let specimen = Specimen::new(design)?;
        let index = specimen.material.dispersion.try_index(line::SODIUM_D);
        let angle = index.ok().and_then(critical_angle).map_or(90.0, f64::to_degrees);
        greatest = greatest.max(angle);
    }
    Ok(greatest)
}
