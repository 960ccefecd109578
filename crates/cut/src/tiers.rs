//! Designs in the form of cutters: tiers of facets that share an angle and a distance, each facet at an index of the
//! faceting machine's gear.
//!
//! Source: the conventions of GemCad (R. Strickland), as described in docs/formats.md.

use super::frosting::FROSTINGS;
use super::meets::Meet;
use super::names;
use brillianteer_math::{Plane, as_written};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// The most teeth of a gear, counted either way round.
const MOST_TEETH: i32 = 100_000;

/// The distance that the block reaches along each axis, in the design's unit.
const BLOCK: f64 = 17.0 / 15.0;

/// The largest index and distance. Beyond it planes lose their digits.
const LARGEST: f64 = 1e9;

/// A cutter's design. Lengths are in the design's own unit; a stone made of it is scaled to its girdle. Written by serde it
/// is the table `[index]` of a cut file, whose tiers are tables of their own.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tiers {
    /// The teeth of the index gear; below 0 where they are counted the other way round. Not 0.
    pub gear: i32,
    /// The gear's offset, in teeth: the index that lies at -y.
    #[serde(default)]
    pub offset: f64,
    /// The number of times that the design repeats around its axis, according to its file. The facets list all
    /// indices nevertheless.
    #[serde(default = "once")]
    pub symmetry: u32,
    /// True where, according to the file, each repeat is its own mirror image.
    #[serde(default)]
    pub mirror: bool,
    /// The text at the top of the file, line by line.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub headers: Vec<String>,
    /// The text at the end of the file, line by line.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub footers: Vec<String>,
    /// Further statements of the file, such as the date, by key.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub remarks: BTreeMap<String, String>,
    /// The tiers, in the order in which they are cut.
    #[serde(skip)]
    pub tiers: Vec<Tier>,
}

fn once() -> u32 {
    1
}

/// Facets cut at one setting of the machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tier {
    /// The angle from the girdle plane, degrees: above 0 crown, below 0 pavilion, ±90 girdle. 0 is the table, or, with a
    /// negative sign or distance, the culet.
    pub angle: f64,
    /// The distance from the origin along the normal, in the design's unit. Its sign matters only at angle 0.
    pub distance: f64,
    /// The cutter's instructions; empty where there are none.
    pub instructions: String,
    /// The meet of the tier, if it is known; `None` where the distance alone places the facets. Reading a design
    /// moves no facet to its meet: [`Tiers::solved`] does.
    pub meet: Option<Meet>,
    /// True where the tier is cut. A tier that is not cut stays in the design but makes no facets.
    pub is_cut: bool,
    /// The frosting of the facets: 0 polished, 1 as rough as possible.
    pub frosting: f64,
    /// The facets, in the order in which they are listed.
    pub facets: Vec<Indexed>,
}

/// A facet of a tier.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Indexed {
    /// The index on the gear, in teeth; may lie between two teeth.
    pub index: f64,
    /// The facet's name; empty where it has none. Cutters name the first facet of a tier, and its name is that of
    /// all.
    pub name: String,
}

/// The fault in a cutter's design.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum TierFault {
    /// A gear without teeth, or with too many.
    #[error("gear: {0} must be from 1 to {MOST_TEETH} teeth, or below 0 where they are counted clockwise")]
    Gear(i32),
    /// An offset that is not a number, or too large.
    #[error("offset: {} must be a number of teeth", as_written(*.0))]
    Offset(f64),
    /// An angle out of range.
    #[error("angle: {} must be from -180 to 180 degrees", as_written(*.0))]
    Angle(f64),
    /// A distance out of range.
    #[error("distance: {} must be a length, up to {LARGEST}", as_written(*.0))]
    Distance(f64),
    /// A finish out of range.
    #[error("frosting: {} must be from 0 (polished) to 1", as_written(*.0))]
    Frosting(f64),
    /// An index out of range.
    #[error("index: {} must be a tooth of the gear, up to {LARGEST}", as_written(*.0))]
    Index(f64),
}

impl TierFault {
    /// Returns the key of the cut file that is at fault.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Gear(_) => "gear",
            Self::Offset(_) => "offset",
            Self::Angle(_) => "angle",
            Self::Distance(_) => "distance",
            Self::Frosting(_) => "frosting",
            Self::Index(_) => "indices",
        }
    }
}

/// The part of a stone where a tier lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TierZone {
    /// The flat facet on top.
    Table,
    /// The leaning facets that face up, above the girdle.
    Crown,
    /// The upright facets.
    Girdle,
    /// The leaning facets that face down, below the girdle.
    Pavilion,
    /// The flat facet at the bottom.
    Culet,
}

impl TierZone {
    /// Returns the trade's name of the zone.
    pub fn name(self) -> &'static str {
        match self {
            Self::Table => "table",
            Self::Crown => "crown",
            Self::Girdle => "girdle",
            Self::Pavilion => "pavilion",
            Self::Culet => "culet",
        }
    }
}

impl Tier {
    /// Returns the zone where the tier lies.
    pub fn zone(&self) -> TierZone {
        // A facet beyond 90 degrees faces the other way than its sign says.
        match (self.angle, self.faces_down() != (self.angle.abs() > 90.0)) {
            (0.0, true) => TierZone::Culet,
            (0.0, false) => TierZone::Table,
            (90.0 | -90.0, _) => TierZone::Girdle,
            (_, true) => TierZone::Pavilion,
            (_, false) => TierZone::Crown,
        }
    }

    /// Returns the instruction for the cutter: the tier's own, or where it has none, the meet in words.
    pub fn instruction(&self) -> Cow<'_, str> {
        match &self.meet {
            Some(meet) if self.instructions.is_empty() => Cow::Owned(meet.to_string()),
            _ => Cow::Borrowed(&self.instructions),
        }
    }

    /// Returns the tier's own name: the first that one of its facets has; empty where none has one. [`Tiers::names`] has the
    /// name by which it is called.
    pub fn name(&self) -> &str {
        self.facets.iter().map(|facet| facet.name.as_str()).find(|name| !name.is_empty()).unwrap_or_default()
    }

    fn faces_down(&self) -> bool {
        self.angle.is_sign_negative() || (self.angle == 0.0 && self.distance.is_sign_negative())
    }

    fn check(&self) -> Result<(), TierFault> {
        if !(-180.0..=180.0).contains(&self.angle) {
            return Err(TierFault::Angle(self.angle));
        }
        if !(-LARGEST..=LARGEST).contains(&self.distance) {
            return Err(TierFault::Distance(self.distance));
        }
        if !FROSTINGS.contains(&self.frosting) {
            return Err(TierFault::Frosting(self.frosting));
        }
        let wrong = self.facets.iter().find(|facet| !(-LARGEST..=LARGEST).contains(&facet.index));
        wrong.map_or(Ok(()), |facet| Err(TierFault::Index(facet.index)))
    }
}

impl Tiers {
    /// Checks the gear, the offset and every tier.
    ///
    /// # Errors
    /// The error names the first number that is out of its range, with the number of its tier, from 1; `None` where
    /// the gear or the offset is wrong.
    pub fn check(&self) -> Result<(), (Option<usize>, TierFault)> {
        if self.gear == 0 || !(-MOST_TEETH..=MOST_TEETH).contains(&self.gear) {
            return Err((None, TierFault::Gear(self.gear)));
        }
        if !(-LARGEST..=LARGEST).contains(&self.offset) {
            return Err((None, TierFault::Offset(self.offset)));
        }
        let mut numbered = (1..).zip(&self.tiers);
        numbered.try_for_each(|(number, tier)| tier.check().map_err(|fault| (Some(number), fault)))
    }

    /// Returns the plane of a facet of a tier, in the design's unit, with a unit normal.
    ///
    /// Without an offset, index 0 lies at -y. Indices count counter-clockwise seen from above for a gear above 0.
    pub fn plane(&self, tier: &Tier, index: f64) -> Plane {
        let down = if tier.faces_down() { -1.0 } else { 1.0 };
        let (slope_sin, slope_cos) = match tier.angle.abs() {
            90.0 => (1.0, 0.0),
            angle => angle.to_radians().sin_cos(),
        };
        let (sin, cos) = ((index - self.offset) / f64::from(self.gear) * TAU).sin_cos();
        let flat = tier.angle == 0.0;
        let across = if flat { [0.0; 2] } else { [sin * slope_sin, -cos * slope_sin] };
        Plane::new(DVec3::new(across[0], across[1], down * slope_cos), tier.distance.abs())
    }

    /// Returns the facets that are cut, each with a name of its own, which begins with that of its tier, and its plane in the
    /// design's unit.
    pub(super) fn facets(&self) -> Vec<(String, Plane)> {
        let cut = self.names().into_iter().zip(&self.tiers).filter(|(_, tier)| tier.is_cut);
        let bases: Vec<(String, Plane)> = cut
            .flat_map(|(base, tier)| {
                tier.facets.iter().map(move |facet| (base.clone(), self.plane(tier, facet.index)))
            })
            .collect();
        let names = names::unique(bases.iter().map(|(name, _)| name.as_str()));
        names.into_iter().zip(bases.iter().map(|(_, plane)| *plane)).collect()
    }

    /// Returns the frosting of each facet that is cut, in the order in which a design lists its facets.
    pub fn frosting(&self) -> Vec<f64> {
        let cut = self.tiers.iter().filter(|tier| tier.is_cut);
        cut.flat_map(|tier| std::iter::repeat_n(tier.frosting, tier.facets.len())).collect()
    }

    /// Returns the faces of the block that GemCad cuts from, which close a stone whose facets leave it open.
    ///
    /// The block reaches 17/15 of the unit along each axis, as the outlines stored in GemCad's files show.
    pub fn block() -> impl Iterator<Item = (String, Plane)> {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
        (1..).zip(axes).map(|(number, normal)| (format!("block {number}"), Plane::new(normal, BLOCK)))
    }

    /// Returns the number of facets that are cut; at most [`MAX_PLANES`](super::MAX_PLANES) make a stone.
    pub fn count(&self) -> usize {
        self.tiers.iter().filter(|tier| tier.is_cut).map(|tier| tier.facets.len()).sum()
    }
}

/// A whole design as serde writes and reads it: the header as `index`, and the tiers as `tier`.
pub(super) mod whole {
    use super::{Tier, Tiers};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize)]
    struct Written<'a> {
        index: &'a Tiers,
        tier: &'a [Tier],
    }

    #[derive(Deserialize)]
    struct Read {
        index: Tiers,
        tier: Vec<Tier>,
    }

    pub fn serialize<S: Serializer>(tiers: &Tiers, serializer: S) -> Result<S::Ok, S::Error> {
        Written { index: tiers, tier: &tiers.tiers }.serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Tiers, D::Error> {
        let Read { index, tier } = Read::deserialize(deserializer)?;
        Ok(Tiers { tiers: tier, ..index })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tier(angle: f64, distance: f64, indices: &[f64]) -> Tier {
        let facets = indices.iter().map(|&index| Indexed { index, name: String::new() }).collect();
        Tier { angle, distance, instructions: String::new(), meet: None, is_cut: true, frosting: 0.0, facets }
    }

    fn square(gear: i32, offset: f64) -> Tiers {
        let tiers =
            vec![tier(-90.0, 1.0, &[0.0, 24.0, 48.0, 72.0]), tier(0.0, 0.5, &[0.0]), tier(-0.0, 0.5, &[0.0])];
        Tiers { gear, offset, symmetry: 4, mirror: true, tiers, ..Tiers::default() }
    }

    #[test]
    fn indices_count_from_the_bottom_counter_clockwise() {
        let design = square(96, 0.0);
        let normals: Vec<DVec3> = design.facets().iter().map(|(_, plane)| plane.normal).collect();
        for (normal, expected) in
            normals.iter().zip([DVec3::NEG_Y, DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z])
        {
            assert!(normal.abs_diff_eq(expected, 1e-15), "{normal} is not {expected}");
        }
        // Girdles stand upright to the last bit.
        assert!(normals[..4].iter().all(|n| n.z == 0.0));
        let turned = square(-96, 24.0).facets();
        assert!(turned[0].1.normal.abs_diff_eq(DVec3::X, 1e-15), "{}", turned[0].1.normal);
        assert!(turned[2].1.normal.abs_diff_eq(DVec3::NEG_X, 1e-15));
    }

    #[test]
    fn the_sign_of_angle_or_distance_tells_table_from_culet() {
        let zones =
            [(0.0, 1.0), (0.0, -1.0), (-0.0, 1.0), (41.0, 1.0), (-41.0, 1.0), (90.0, 1.0), (-90.0, 1.0)]
                .map(|(angle, distance)| tier(angle, distance, &[]).zone());
        use TierZone::*;
        assert_eq!(zones, [Table, Culet, Culet, Crown, Pavilion, Girdle, Girdle]);
        for angle in [100.0, -100.0, 41.0, -41.0] {
            let leaning = tier(angle, 1.0, &[]);
            let is_up = square(96, 0.0).plane(&leaning, 0.0).normal.z > 0.0;
            assert_eq!(leaning.zone(), if is_up { Crown } else { Pavilion }, "{angle}");
        }
        let below = square(96, 0.0).plane(&tier(-40.0, 1.0, &[]), 0.0);
        assert!(
            (below.normal - DVec3::new(0.0, -40f64.to_radians().sin(), -40f64.to_radians().cos())).length()
                < 1e-15
        );
    }

    #[test]
    fn a_tier_is_called_by_its_first_name_and_else_by_its_zone_and_number() {
        let mut design = square(96, 0.0);
        design.tiers[0].facets[1].name = "G1".to_owned();
        let names: Vec<String> = design.facets().into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["G1 1", "G1 2", "G1 3", "G1 4", "T", "K"]);
        design.tiers[0].facets[1].name = "\u{7}".to_owned();
        design.tiers[1].is_cut = false;
        let names: Vec<String> = design.facets().into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["G1 1", "G1 2", "G1 3", "G1 4", "K"]);
    }

    #[test]
    fn numbers_that_make_no_sense_are_named() {
        assert_eq!(square(96, 0.0).check(), Ok(()));
        assert_eq!(square(0, 0.0).check(), Err((None, TierFault::Gear(0))));
        assert!(matches!(square(96, f64::NAN).check(), Err((None, TierFault::Offset(_)))));
        for (number, (angle, distance, index)) in
            [(270.0, 1.0, 0.0), (f64::NAN, 1.0, 0.0), (10.0, f64::INFINITY, 0.0), (10.0, 1.0, 1e300)]
                .into_iter()
                .enumerate()
        {
            let mut design = square(96, 0.0);
            design.tiers.insert(1, tier(angle, distance, &[index]));
            let Err((Some(2), fault)) = design.check() else { panic!("{number}") };
            assert_eq!(fault.key(), ["angle", "angle", "distance", "indices"][number]);
        }
    }
}
