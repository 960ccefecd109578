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
