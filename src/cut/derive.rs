//! What follows from the proportions of a round brilliant, once they are found to be within their limits.

use super::proportions::Derived;
use super::round_brilliant::RoundBrilliant;
use super::{ProportionError, Warning, facets, limits};
use crate::math::Plane;

impl RoundBrilliant {
    /// The other member of each pair, the angles of star and halves, the depths; or the first limit crossed.
    ///
    /// # Errors
    /// The first limit crossed, and by how much.
    pub fn derived(&self) -> Result<Derived, ProportionError> {
        limits::check(self).map(|proportions| proportions.derived())
    }

    /// Every facet's name and plane, unit normals, girdle radius 1: table, bezels, stars, upper halves, girdle, lower
    /// halves, mains, each tier numbered from 1 counterclockwise seen from the table, and the culet if there is one.
    ///
    /// Where the girdle closes in its valleys some girdle planes no longer touch the stone, which a polytope tells.
    ///
    /// # Errors
    /// The first limit crossed, and by how much.
    pub fn facets(&self) -> Result<Vec<(String, Plane)>, ProportionError> {
        limits::check(self).map(|proportions| facets::round_brilliant(&proportions))
    }

    /// What is possible but unusual about these proportions.
    ///
    /// # Errors
    /// The first limit crossed, and by how much.
    pub fn warnings(&self) -> Result<Vec<Warning>, ProportionError> {
        limits::check(self).map(|proportions| Warning::of(&proportions))
    }
}

#[cfg(test)]
pub(crate) mod strategy {
    //! Valid proportions at random, wide of what is ever cut.

    use super::*;
    use crate::cut::{Crown, LowerHalf, Pavilion};
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
