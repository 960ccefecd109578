//! The round brilliant as people write it: percent of the girdle diameter, degrees from the girdle plane.
//!
//! Eight bezels, eight stars, sixteen upper and lower halves, eight mains, after GIA's way of measuring: table and
//! star length are radial, the lower-half length radial too unless the vertical one is asked for.

use serde::Serialize;

use super::proportion_error::ProportionError;
use super::proportions::Derived;
use super::warning::Warning;
use super::{facets, limits};
use crate::math::Plane;

/// The proportions of a round brilliant as given; everything else follows from them.
///
/// Serialises under the keys of a cut file's `[round_brilliant]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RoundBrilliant {
    /// Table, corner to opposite corner. Percent of the girdle diameter, 5 to 92.39.
    pub table: f64,
    /// The crown, by the angle of its bezels or by its height.
    #[serde(flatten)]
    pub crown: Crown,
    /// The pavilion, by the angle of its mains or by its depth.
    #[serde(flatten)]
    pub pavilion: Pavilion,
    /// How far the stars reach from the table's edge to the girdle, seen from above. Percent of that way, below 100;
    /// its lower limit depends on the table.
    pub star_length: f64,
    /// How far the lower halves reach from the girdle to the centre.
    #[serde(flatten)]
    pub lower_half: LowerHalf,
    /// Girdle thickness at the bezels, where it is greatest. Percent of the girdle diameter; 0 is a knife edge all
    /// round, without girdle facets.
    pub girdle_thickness: f64,
    /// Number of girdle facets, any whole number from 16 to 128.
    ///
    /// Multiples of 8 keep the eightfold mirror symmetry whole, so tracers have a sixteenth of the work; multiples of
    /// 16 also put a girdle corner under each star tip; multiples of 32 one at each valley, and 16 itself gives a
    /// straight girdle edge.
    pub girdle_facets: u32,
    /// Culet, flat to opposite flat. Percent of the girdle diameter, 0 (a point) to below 100.
    pub culet: f64,
}

/// What a crown is given by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub enum Crown {
    /// Angle of the bezels from the girdle plane, degrees.
    #[serde(rename = "crown_angle")]
    Angle(f64),
    /// From the girdle's upper edge to the table, percent of the girdle diameter.
    #[serde(rename = "crown_height")]
    Height(f64),
}

/// What a pavilion is given by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub enum Pavilion {
    /// Angle of the mains from the girdle plane, degrees.
    #[serde(rename = "pavilion_angle")]
    Angle(f64),
    /// From the girdle's lower edge to the culet (so less with a larger culet), percent of the girdle diameter.
    #[serde(rename = "pavilion_depth")]
    Depth(f64),
}

/// What the length of the lower halves is given by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub enum LowerHalf {
    /// Seen along the axis: percent of the way from the girdle to the centre (GIA).
    #[serde(rename = "lower_half_length")]
    Radial(f64),
    /// Seen from the side: percent of the depth from the girdle to where the mains meet (some laboratories).
    #[serde(rename = "lower_half_length_vertical")]
    Vertical(f64),
}

impl RoundBrilliant {
    /// The other member of each pair, the angles of star and halves, the depths; or the first limit crossed.
    pub fn derived(&self) -> Result<Derived, ProportionError> {
        limits::check(self).map(|proportions| proportions.derived())
    }

    /// Every facet's name and plane, unit normals, girdle radius 1: table, bezels, stars, upper halves, girdle, lower
    /// halves, mains, each tier numbered from 1 counterclockwise seen from the table, and the culet if there is one.
    ///
    /// Where the girdle closes in its valleys some girdle planes no longer touch the stone, which a polytope tells.
    pub fn facets(&self) -> Result<Vec<(String, Plane)>, ProportionError> {
        limits::check(self).map(|proportions| facets::round_brilliant(&proportions))
    }

    /// What is possible but unusual about these proportions.
    pub fn warnings(&self) -> Result<Vec<Warning>, ProportionError> {
        limits::check(self).map(|proportions| Warning::of(&proportions))
    }
}

/// A modern ideal cut, which the tests bend.
#[cfg(test)]
pub(crate) const MODERN: RoundBrilliant = RoundBrilliant {
    table: 56.0,
    crown: Crown::Angle(34.5),
    pavilion: Pavilion::Angle(40.8),
    star_length: 50.0,
    lower_half: LowerHalf::Radial(77.0),
    girdle_thickness: 3.0,
    girdle_facets: 96,
    culet: 0.0,
};

#[cfg(test)]
pub(crate) mod strategy {
    //! Valid proportions at random, wide of what is ever cut.

    use super::*;
    use proptest::prelude::*;

    fn crown() -> impl Strategy<Value = Crown> {
        prop_oneof![(2.5..65.0).prop_map(Crown::Angle), (4.0..100.0).prop_map(Crown::Height)]
    }

    fn pavilion() -> impl Strategy<Value = Pavilion> {
        prop_oneof![(2.5..65.0).prop_map(Pavilion::Angle), (4.0..75.0).prop_map(Pavilion::Depth)]
    }

    fn lower_half() -> impl Strategy<Value = LowerHalf> {
        prop_oneof![(3.0..99.0).prop_map(LowerHalf::Radial), (10.5..99.0).prop_map(LowerHalf::Vertical)]
    }

    /// Table up to 85 %, above which stars need more than 90 % of the way to the girdle.
    pub fn proportions() -> impl Strategy<Value = RoundBrilliant> {
        let shape = (5.0..85.0, crown(), pavilion(), 0.01..0.99, lower_half());
        (shape, 0.0..8.0, 16_u32..=128, prop_oneof![Just(0.0), 0.1..90.0]).prop_map(
            |((table, crown, pavilion, star, lower_half), girdle_thickness, girdle_facets, culet)| {
                let least = limits::least_star_length(table);
                let star_length = least + (100.0 - least) * star;
                RoundBrilliant {
                    table,
                    crown,
                    pavilion,
                    star_length,
                    lower_half,
                    girdle_thickness,
                    girdle_facets,
                    culet,
                }
            },
        )
    }
}
