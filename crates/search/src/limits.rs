//! Limits on the geometry of a stone.

use super::appraisal::SearchError;
use super::goal::{AtLeastAtMost, Goal};
use super::kept_shape::{FindingCounts, audit_of, estimated_class, usual_limits};
use brillianteer_cut::{
    CutClass, Design, Proportion, ProportionReport, SheetFigures, SmallestParts, TierZone,
};
use brillianteer_optics::{critical_angle, line};
use brillianteer_scene::{Specimen, Stone};

/// The names of limits that any cut has, besides the keys of its proportions:
///
/// - `above_critical`: the degrees by which the flattest facet of the pavilion is steeper than the critical angle, in
///   the material of the goal with the lowest index;
/// - `yield`: the volume in cubes of the width, as a part of that of the design before the search;
/// - `smallest_facet`: the area of the smallest facet as a part of the median area of the facets of its zone;
/// - `shortest_edge`: the length of the shortest edge as a part of the width, without the upright ones of the girdle;
/// - `new_findings`: the number of findings of an audit beyond those of the design before the search, kind by kind;
/// - `lower_class`: the number of classes by which the estimate for round brilliants of diamond is below that of the design
///   before the search; 0 for what has no estimate;
/// - the ratios of a cutter's sheet ([`SheetFigures`]), all measured on the stone.
pub const LIMIT_NAMES: [&str; 13] = [
    "above_critical",
    "yield",
    SMALLEST_FACET,
    SHORTEST_EDGE,
    NEW_FINDINGS,
    LOWER_CLASS,
    "length_to_width",
    "table_to_width",
    "pavilion_to_width",
    "crown_to_width",
    GIRDLE,
    "height_to_width",
    "volume_to_width_cubed",
];

/// The limits that a search keeps by itself; see [`usual_limits`].
pub(super) const SMALLEST_FACET: &str = "smallest_facet";
pub(super) const SHORTEST_EDGE: &str = "shortest_edge";
pub(super) const NEW_FINDINGS: &str = "new_findings";
pub(super) const LOWER_CLASS: &str = "lower_class";
pub(super) const GIRDLE: &str = "girdle_to_width";

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
    /// One of the smallest parts of the stone, as a part of what it is compared with.
    Smallest(fn(&SmallestParts) -> f64),
    /// Findings of an audit beyond these.
    NewFindings(FindingCounts),
    /// Classes below this one.
    LowerClass(Option<CutClass>),
}

impl GeometryLimit {
    /// Returns the limits of a goal for a design, which makes a stone, and then those that a search keeps by itself.
    pub fn all(goal: &Goal, specimen: &Specimen, stone: &Stone) -> Result<Vec<Self>, SearchError> {
        let limit = |(name, given): (&String, &AtLeastAtMost)| {
            let kind = LimitKind::of(name, goal, specimen, stone)?;
            Ok(Self { name: name.clone(), kind, ends: given.ends() })
        };
        let usual = usual_limits(goal, stone);
        goal.limit.iter().chain(&usual).map(limit).collect()
    }

    /// Returns the value of the limited figure.
    pub fn value(&self, specimen: &Specimen, stone: &Stone) -> f64 {
        match &self.kind {
            LimitKind::Proportion(row) => (row.get)(&specimen.design.cut),
            LimitKind::Ratio(of, unit) => of(&figures(stone)) / unit,
            LimitKind::AboveCritical(critical_deg) => flattest_deg(stone) - critical_deg,
            LimitKind::Smallest(of) => 0.01 * of(&SmallestParts::of(&stone.polytope)),
            LimitKind::NewFindings(before) => before.new_in(&audit_of(specimen)) as f64,
            LimitKind::LowerClass(before) => before.map_or(0.0, |before| classes_below(before, specimen)),
        }
    }

    /// Returns whether the figure changes in steps, so that it has no slope.
    pub fn is_stepped(&self) -> bool {
        matches!(self.kind, LimitKind::NewFindings(_) | LimitKind::LowerClass(_))
    }
}

impl LimitKind {
    fn of(name: &str, goal: &Goal, specimen: &Specimen, stone: &Stone) -> Result<Self, SearchError> {
        let design = &specimen.design;
        if let Some(row) = design.cut.proportion(name) {
            return Ok(Self::Proportion(row));
        }
        let ratio: fn(&SheetFigures) -> f64 = match name {
            "above_critical" => return Ok(Self::AboveCritical(critical_deg(goal, design)?)),
            SMALLEST_FACET => return Ok(Self::Smallest(|parts| parts.facet_percent)),
            SHORTEST_EDGE => return Ok(Self::Smallest(|parts| parts.edge_percent)),
            NEW_FINDINGS => return Ok(Self::NewFindings(FindingCounts::of(&audit_of(specimen)))),
            LOWER_CLASS => return Ok(Self::LowerClass(estimated_class(specimen))),
            "yield" => |figures| figures.volume_to_width_cubed,
            "length_to_width" => |figures| figures.length_to_width,
            "table_to_width" => |figures| figures.table_to_width,
            "pavilion_to_width" => |figures| figures.pavilion_to_width,
            "crown_to_width" => |figures| figures.crown_to_width,
            GIRDLE => |figures| figures.girdle_to_width,
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

/// Returns the number of classes by which a stone is estimated below a class; 0 for one without an estimate.
fn classes_below(before: CutClass, specimen: &Specimen) -> f64 {
    estimated_class(specimen).map_or(0.0, |now| f64::from((now as u8).saturating_sub(before as u8)))
}

fn figures(stone: &Stone) -> SheetFigures {
    SheetFigures::of(&stone.polytope, stone.names())
}

/// Returns the slope of the flattest facet of the pavilion, degrees; 90 without one.
fn flattest_deg(stone: &Stone) -> f64 {
    let tiers = ProportionReport::of(&stone.polytope, stone.names()).tiers;
    let pavilion = tiers.iter().filter(|tier| tier.zone == TierZone::Pavilion);
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
