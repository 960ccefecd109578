//! Finds the zone of a stone in which a facet lies: the table, the crown, the girdle, the pavilion or the culet.

use super::TierZone;
use crate::math::{Facet, Polytope};

/// A facet whose normal leans less than this (sine) from the girdle plane is upright, and from the axis level. Upright facets
/// of a cutter's file of six digits lean by no more.
pub(super) const EXACT: f64 = 1e-5;

/// The same limit for measured facets, such as those of a scan: about 1.15 degrees. Narrow facets of a girdle lean
/// most.
const MEASURED: f64 = 0.02;

/// The limits up to which upright and level facets of a stone may lean.
///
/// The facets of a design are exact. Where most facets that are nearly upright, or nearly level, lean by more than
/// rounding does, the stone was measured, and all of them count as upright or level.
#[derive(Debug, Clone, Copy)]
pub struct FacetZones {
    upright: f64,
    level: f64,
}

impl FacetZones {
    /// Finds the limits for the facets of a stone.
    pub fn of(stone: &Polytope) -> Self {
        let facets = stone.facets();
        Self {
            upright: limit(facets.iter().map(from_upright)),
            level: limit(facets.iter().filter(|facet| facet.plane.normal.z > 0.0).map(from_level)),
        }
    }

    /// Returns whether a facet is upright, so that it is part of the girdle.
    pub fn is_girdle(&self, facet: &Facet) -> bool {
        from_upright(facet) < self.upright
    }

    /// Returns whether a facet lies flat on top, so that it is the table.
    pub fn is_table(&self, facet: &Facet) -> bool {
        facet.plane.normal.z > 0.0 && from_level(facet) < self.level
    }

    /// Returns the zone of a facet.
    pub fn zone(&self, facet: &Facet) -> TierZone {
        match facet.plane.normal.z > 0.0 {
            _ if self.is_girdle(facet) => TierZone::Girdle,
            true if self.is_table(facet) => TierZone::Table,
            true => TierZone::Crown,
            false if from_level(facet) < self.level => TierZone::Culet,
            false => TierZone::Pavilion,
        }
    }
}

/// Returns the sine of the angle between a facet and the axis.
fn from_upright(facet: &Facet) -> f64 {
    facet.plane.normal.z.abs()
}

/// Returns the sine of the angle between a facet and the girdle plane.
fn from_level(facet: &Facet) -> f64 {
    facet.plane.normal.truncate().length()
}

/// Returns the limit up to which such angles count as 0.
fn limit(sines: impl Iterator<Item = f64>) -> f64 {
    let (exact, measured) = sines.filter(|sine| *sine < MEASURED).fold((0, 0), |(exact, measured), sine| {
        if sine < EXACT { (exact + 1, measured) } else { (exact, measured + 1) }
    });
    if measured > exact { MEASURED } else { EXACT }
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::MODERN;
    use super::*;
    use crate::cut::Outline;
    use crate::math::Plane;
    use glam::{DQuat, DVec3};

    fn planes() -> (Vec<String>, Vec<Plane>) {
        MODERN.facets().unwrap().into_iter().unzip()
    }

    /// Leans each facet by some degrees about a direction that differs from facet to facet.
    fn measured(planes: &[Plane], degrees: f64) -> Polytope {
        let lean = |(k, plane): (usize, &Plane)| {
            let way = k as f64 * 2.4;
            let axis = DVec3::new(way.cos(), way.sin(), 0.0);
            let turn = DQuat::from_axis_angle(
                axis,
                (degrees * (0.4 + 0.6 * (k as f64 * 1.7).sin().abs())).to_radians(),
            );
            Plane::new(turn * plane.normal, plane.offset)
        };
        Polytope::from_planes(&planes.iter().enumerate().map(lean).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn a_measured_stone_has_the_table_and_the_girdle_of_its_design() {
        let (names, planes) = planes();
        let exact = Polytope::from_planes(&planes).unwrap();
        for degrees in [0.0, 0.05, 0.2] {
            let stone = measured(&planes, degrees);
            let zones = FacetZones::of(&stone);
            for (facet, name) in stone.facets().iter().zip(&names) {
                let expected = match name.split(' ').next().unwrap() {
                    "table" => TierZone::Table,
                    "girdle" => TierZone::Girdle,
                    "lower_half" | "main" => TierZone::Pavilion,
                    _ => TierZone::Crown,
                };
                assert_eq!(zones.zone(facet), expected, "{name} {degrees}");
            }
            let (given, found) = (Outline::of(&exact), Outline::of(&stone));
            assert!((given.table_corners - found.table_corners).abs() < 0.03, "{degrees}: {found:?}");
        }
    }

    #[test]
    fn a_facet_of_a_design_that_leans_a_little_is_no_table_and_no_girdle() {
        let (_, mut planes) = planes();
        planes.push(Plane::from_slope(0.4_f64.to_radians(), 0.2, planes[0].offset + 1e-4));
        let stone = Polytope::from_planes(&planes).unwrap();
        let zones = FacetZones::of(&stone);
        let tables = stone.facets().iter().filter(|facet| zones.is_table(facet)).count();
        assert_eq!((tables, zones.zone(stone.facets().last().unwrap())), (1, TierZone::Crown));
    }
}
