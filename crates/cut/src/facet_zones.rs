//! Finds the zone of a stone in which a facet lies: the table, the crown, the girdle, the pavilion or the culet.

use super::TierZone;
use brillianteer_math::{Facet, Polytope};

/// A facet whose normal leans less than this (sine) from the girdle plane is upright, and from the axis level. Upright facets
/// of a cutter's file of six digits lean by no more.
pub(super) const EXACT: f64 = 1e-5;

/// The same limit for measured facets, such as those of a scan: about 1.15 degrees. Narrow facets of a girdle lean
/// most.
const MEASURED: f64 = 0.02;

/// Where no facet leans by less than this but those that do not lean at all, they lean because they are meant to: a tenth of
/// a degree. Some facet of a measured stone leans by less.
const MEANT: f64 = 0.001_745;

/// The limits up to which upright and level facets of a stone may lean.
///
/// The facets of a design are exact. Where most facets that are nearly upright, or nearly level, lean by more than
/// rounding does, and some of them hardly lean, the stone was measured, and all of them count as upright or level. A design
/// may have flat stars, or steep facets, that are many more than its table, or than the facets of its girdle.
#[derive(Debug, Clone, Copy)]
pub struct FacetZones {
    upright: f64,
    level: f64,
}

impl FacetZones {
    /// Finds the limits for the facets of a stone.
    pub fn of(stone: &Polytope) -> Self {
        let facets = stone.facets();
        let upright = Leaning::of(facets.iter().map(from_upright));
        let level = Leaning::of(facets.iter().filter(|facet| facet.plane.normal.z > 0.0).map(from_level));
        let is_design = upright.exact > 0 && upright.is_exact(false);
        Self { upright: limit_where(upright.is_exact(false)), level: limit_where(level.is_exact(is_design)) }
    }

    /// Returns whether facets that are upright or level lean as those of a measured stone do.
    pub fn is_measured(&self) -> bool {
        self.upright.max(self.level) > EXACT
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
        if self.is_girdle(facet) {
            TierZone::Girdle
        } else if self.is_table(facet) {
            TierZone::Table
        } else if facet.plane.normal.z > 0.0 {
            TierZone::Crown
        } else if from_level(facet) < self.level {
            TierZone::Culet
        } else {
            TierZone::Pavilion
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

/// The facets that are nearly upright, or nearly level.
struct Leaning {
    /// The number of those that lean by rounding alone.
    exact: usize,
    /// The number of the others.
    others: usize,
    /// The sine by which the others lean at least.
    least: f64,
}

impl Leaning {
    fn of(sines: impl Iterator<Item = f64>) -> Self {
        let none = Self { exact: 0, others: 0, least: f64::INFINITY };
        sines.filter(|sine| *sine < MEASURED).fold(none, |found, sine| {
            if sine < EXACT {
                Self { exact: found.exact + 1, ..found }
            } else {
                Self { others: found.others + 1, least: found.least.min(sine), ..found }
            }
        })
    }

    /// Returns whether only those that lean by rounding alone count as upright or level; `is_design` says that other
    /// facets of the stone are exact.
    fn is_exact(&self, is_design: bool) -> bool {
        let are_meant = self.least >= MEANT;
        self.others <= self.exact
            || self.exact > 0 && (is_design || are_meant)
            || is_design && are_meant && self.others > 1
    }
}

/// Returns the sine up to which facets count as upright or level, where they are exact or measured.
fn limit_where(is_exact: bool) -> f64 {
    if is_exact { EXACT } else { MEASURED }
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::{MODERN, RoundBrilliant};
    use super::*;
    use crate::Outline;
    use brillianteer_math::Plane;
    use glam::{DQuat, DVec3};
    use std::f64::consts::TAU;

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

    /// Returns a brilliant with facets of this slope, in degrees, around its axis. Each has this distance from the origin,
    /// as a function of the slope in radians.
    fn with_more(number: u32, degrees: f64, distance: impl Fn(f64) -> f64) -> Polytope {
        let brilliant = RoundBrilliant { girdle_facets: 16, ..MODERN };
        let own = brilliant.facets().unwrap().into_iter().map(|(_, plane)| plane);
        let slope = degrees.to_radians();
        let around =
            |k| Plane::from_slope(slope, 0.1 + TAU * f64::from(k) / f64::from(number), distance(slope));
        Polytope::from_planes(&own.chain((0..number).map(around)).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn facets_that_are_meant_to_lean_a_little_are_no_tables_and_no_girdle_however_many_they_are() {
        let top = planes().1[0].offset;
        let counted = |stone: &Polytope| {
            let zones = FacetZones::of(stone);
            assert!(!zones.is_measured());
            let count = |zone| stone.facets().iter().filter(|facet| zones.zone(facet) == zone).count();
            [TierZone::Table, TierZone::Crown, TierZone::Girdle].map(count)
        };
        for degrees in [0.01, 0.1, 0.5, 1.0, 2.0] {
            // Each facet cuts off a part of the table's edge.
            let stone = with_more(12, degrees, |slope| top * slope.cos() + 0.45 * slope.sin());
            assert_eq!(counted(&stone), [1, 32 + 12, 16], "{degrees}");
        }
        for degrees in [0.2, 0.5, 1.0, 2.0] {
            // Each facet cuts off a part of the girdle's upper edge.
            let stone = with_more(24, 90.0 - degrees, |slope| 0.98 * slope.sin() - 0.002 * slope.cos());
            assert_eq!(counted(&stone), [1, 32 + 24, 16], "{degrees}");
        }
    }
}
