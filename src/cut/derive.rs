//! The results that follow from the proportions of a round brilliant: derived lengths and angles, facets and
//! warnings. Each is computed only after the proportions have passed their limits.

use super::proportions::{Derived, Proportions};
use super::round_brilliant::RoundBrilliant;
use super::{Cut, ProportionError, Warning, facets};
use brillianteer_math::Plane;

impl RoundBrilliant {
    fn closed_form(&self) -> Result<Proportions, ProportionError> {
        Cut::RoundBrilliant(*self).check().map(|()| Proportions::unchecked(self))
    }

    /// Returns both members of each pair (angle and height, say), the angles of the stars and halves, and the depths.
    ///
    /// # Errors
    /// The error names the first limit that is crossed, and the excess.
    pub fn derived(&self) -> Result<Derived, ProportionError> {
        self.closed_form().map(|proportions| proportions.derived())
    }

    /// Returns every facet's name and plane, with unit normals and girdle radius 1.
    ///
    /// The order is table, bezels, stars, upper halves, girdle, lower halves, mains, and the culet if there is one. Each
    /// tier is numbered from 1, counter-clockwise seen from the table. Where the girdle closes in its valleys, some girdle
    /// planes no longer touch the stone; a [`Polytope`](brillianteer_math::Polytope) made of the planes lists them as redundant.
    ///
    /// # Errors
    /// The error names the first limit that is crossed, and the excess.
    pub fn facets(&self) -> Result<Vec<(String, Plane)>, ProportionError> {
        self.closed_form().map(|proportions| facets::round_brilliant(&proportions))
    }

    /// Returns a warning for everything that is possible but unusual about these proportions.
    ///
    /// # Errors
    /// The error names the first limit that is crossed, and the excess.
    pub fn warnings(&self) -> Result<Vec<Warning>, ProportionError> {
        self.closed_form().map(|proportions| Warning::of(&proportions))
    }
}

#[cfg(test)]
pub(crate) mod strategy {
    //! Random valid proportions, over wider ranges than real stones have.

    use super::*;
    use crate::cut::round_brilliant_table::least_star_length;
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

    /// Proportions with a table of up to 85 %. Larger tables need stars that reach more than 90 % of the way to the girdle.
    pub fn proportions() -> impl Strategy<Value = RoundBrilliant> {
        let shape = (5.0..85.0, crown(), pavilion(), 0.01..0.99, lower_half());
        (shape, 0.0..8.0, 16_u32..=128, prop_oneof![Just(0.0), 0.1..90.0]).prop_map(
            |((table, crown, pavilion, star, lower_half), girdle_thickness, girdle_facets, culet)| {
                let least = least_star_length(table);
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
