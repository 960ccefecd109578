//! Marks of an audit's findings in a facet diagram: amber outlines of facets, and rings around corners.

use crate::drawing::{DrawnAspect, Sheet};
use brillianteer_cut::Finding;
use brillianteer_math::Facet;
use brillianteer_scene::Stone;
use glam::DVec3;

/// Corners nearer to one another than this, girdle radii, are one.
const SAME_CORNER: f64 = 1e-6;

/// The facets and corners of a stone that a drawing marks.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DrawnMarks {
    /// The places of facets among those of the stone.
    pub facets: Vec<usize>,
    /// Corners of the stone.
    pub corners: Vec<DVec3>,
}

impl DrawnMarks {
    /// Returns the marks of some of the findings of a stone's audit.
    pub fn of<'a>(stone: &Stone, findings: impl IntoIterator<Item = &'a Finding>) -> Self {
        let mut marks = Self::default();
        for finding in findings {
            let is_meant = |place: &usize| finding.facets.contains(&stone.names()[*place]);
            marks.facets.extend((0..stone.names().len()).filter(is_meant));
            if finding.kind.is_about_corners() {
                marks.corners.extend(&finding.points);
            }
        }
        marks.facets.sort_unstable();
        marks.facets.dedup();
        marks
    }

    /// Returns whether there are no marks.
    pub fn is_empty(&self) -> bool {
        self.facets.is_empty() && self.corners.is_empty()
    }

    /// Marks the facets and corners in sight of a view: the facets that it `holds`, and their corners.
    pub(super) fn draw(
        &self,
        sheet: &mut Sheet,
        stone: &Stone,
        aspect: &DrawnAspect,
        holds: impl Fn(&Facet) -> bool,
    ) {
        let facets = stone.polytope.facets();
        for facet in self.facets.iter().filter_map(|place| facets.get(*place)).filter(|facet| holds(facet)) {
            sheet.mark_outline(&aspect.outline(stone, facet));
        }
        let is_on = |facet: &Facet, corner: DVec3| {
            stone.polytope.corners(facet).any(|own| own.distance(corner) < SAME_CORNER)
        };
        for &corner in &self.corners {
            if facets.iter().any(|facet| holds(facet) && is_on(facet, corner)) {
                sheet.mark_corner(aspect.at(corner));
            }
        }
    }
}
