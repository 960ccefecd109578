//! A cut of a family whose facets a function makes out of the numbers of its table.

use super::facet_net::{FacetNet, NoRoom};
use super::family::{Family, Proportion};
use super::shape::Cut;
use brillianteer_math::Polytope;
use std::fmt;
use std::ops::Index;

/// The most numbers that a family may have.
pub const MOST_NUMBERS: usize = 16;

/// The function that makes the facets of a family.
///
/// # Errors
/// The error names the tier for which the numbers leave no room.
pub type MakeNet = fn(&FamilyCut) -> Result<FacetNet, NoRoom>;

/// The function that returns the height of a whole stone of a family, in girdle radii. It is defined for impossible numbers as
/// well, so that a message can say how far they are off.
pub type TotalDepth = fn(&FamilyCut) -> f64;

/// A cut of a family, as the numbers of its table in their units. A number is accessed by its place among the rows of
/// the table, for which the file of the family has constants.
#[derive(Clone, Copy)]
pub struct FamilyCut {
    /// The family, which has a [`Family::net`].
    pub family: &'static Family,
    /// The numbers, in the order of the rows; those past the last row are 0.
    pub numbers: [f64; MOST_NUMBERS],
}

impl FamilyCut {
    /// Makes the first cut of a family, for its table.
    pub const fn first(family: &'static Family, given: &[f64]) -> Cut {
        let mut numbers = [0.0; MOST_NUMBERS];
        let mut place = 0;
        while place < given.len() {
            numbers[place] = given[place];
            place += 1;
        }
        Cut::Family(Self { family, numbers })
    }

    /// Returns the net of facets.
    ///
    /// # Errors
    /// The error names the tier for which the numbers leave no room.
    pub(super) fn net(&self) -> Result<FacetNet, NoRoom> {
        let Some(make) = self.family.net else { return Err(NoRoom::default()) };
        make(self)
    }

    /// Returns the net with all facets that have room on the stone, and the solid between them.
    ///
    /// # Errors
    /// The error names the tier for which the numbers leave no room.
    pub(super) fn settled(&self) -> Result<(FacetNet, Polytope), NoRoom> {
        self.net()?.settled()
    }
}

impl Index<usize> for FamilyCut {
    type Output = f64;

    /// Returns the number at a place among the rows.
    fn index(&self, place: usize) -> &f64 {
        &self.numbers[place]
    }
}

impl fmt::Debug for FamilyCut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = self.family.proportions.iter().map(|row| row.key);
        f.write_str(self.family.key)?;
        f.debug_map().entries(rows.zip(self.numbers)).finish()
    }
}

/// Cuts of one family are equal where their numbers are.
impl PartialEq for FamilyCut {
    fn eq(&self, other: &Self) -> bool {
        self.family.key == other.family.key && self.numbers == other.numbers
    }
}

/// Returns a row whose value is the number at the place `PLACE`, for the table of a family to complete.
pub(super) const fn number<const PLACE: usize>() -> Proportion {
    Proportion { get: get::<PLACE>, give: Some(give::<PLACE>), ..Proportion::BLANK }
}

fn get<const PLACE: usize>(cut: &Cut) -> f64 {
    match cut {
        Cut::Family(cut) => cut[PLACE],
        _ => f64::NAN,
    }
}

fn give<const PLACE: usize>(cut: &mut Cut, value: f64) {
    if let Cut::Family(cut) = cut {
        cut.numbers[PLACE] = value;
    }
}
