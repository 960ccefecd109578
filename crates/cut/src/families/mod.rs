//! All families of cuts, and the search for the family of a cut.
//!
//! To add a family (`oval.rs` is the pattern):
//!
//! 1. Write its `Family` in a file here: key and name, a row for each number (`rows`, `step_rows` and
//!    `brilliant_rows` have those that families share), the values of its first cut in the order of the rows,
//!    `net`, which makes the facets, and `depth`, the height of the whole stone by a formula. A row reads its value
//!    by its index in the list. Say at the head of the file where the usual ranges come from.
//! 2. In `net`, use a kernel where one fits: `brilliant` (mains, stars and halves on a `Girdle` of any convex
//!    curve), `steps` (rows parallel to an outline of straight sides), `chevrons`, `alternating`. Or add planes
//!    through points to a `FacetNet`. Half of the width is 1, the length runs along y, z = 0 is the girdle's upper
//!    edge. The diameter at the girdle must stay 2 where a corner at the widest place is cut off. A family that is not
//!    convex, as `heart`, makes one half, which its mirror image closes.
//! 3. Put it into `FAMILIES` and `GROUPS`, a cut of it with the citation of its numbers into `cuts/`, and that file
//!    into `CUTS` of `crates/files/src/library.rs`. Panel, help, files, errors and lists read the rows.
//! 4. The laws of `tests` and `facet_tests` run on every family. They demand a mirror image in x; a family without one
//!    needs its exception in `tests.rs`. A step or chevron cut stands in `SIDES` of `step_tests.rs`. Counts of families
//!    stand in README.md, `src/cli/documents.rs` and `moved_numbers.rs`; names of cuts in
//!    `docs/images/contact-sheet.sh`. Where its numbers count something (mains, rows), state in the tests how many
//!    facets follow.
//! 5. State where its usual ranges come from in `range_sources`.
//!
//! No proportion is named Length or Width: the panel has rows of these names for the size of stones.

mod alternating;
mod asscher;
mod baguette;
mod barion;
mod brilliant;
mod brilliant_rows;
mod briolette;
mod chevrons;
mod curves;
mod cushion;
mod cushion_barion;
mod cushion_chevrons;
mod emerald;
#[cfg(test)]
mod facet_tests;
mod girdle;
mod heart;
mod hexagon;
mod kite;
mod marquise;
mod modified_cushion;
#[cfg(test)]
mod number_tests;
mod oval;
mod oval_barion;
mod pear;
mod portuguese;
mod princess;
mod radiant;
mod range_sources;
mod rose;
mod rows;
mod single_cut;
mod step_rows;
#[cfg(test)]
mod step_tests;
mod steps;
mod tapered_baguette;
#[cfg(test)]
mod tests;
mod trillion;

use super::family::{Family, ProfileHandle, Proportion};
#[cfg(test)]
use super::family_cut::FamilyCut;
use super::glass_table::{CUBE, PILL, PLATE, PRISM};
use super::round_brilliant_table::ROUND_BRILLIANT;
use super::{Cut, Glass};
use asscher::ASSCHER;
use baguette::BAGUETTE;
use barion::BARION;
use briolette::BRIOLETTE;
use cushion::CUSHION;
use cushion_barion::CUSHION_BARION;
use emerald::EMERALD;
use heart::HEART;
use hexagon::HEXAGON;
use kite::KITE;
use marquise::MARQUISE;
use modified_cushion::MODIFIED_CUSHION;
use oval::OVAL;
use oval_barion::OVAL_BARION;
use pear::PEAR;
use portuguese::PORTUGUESE;
use princess::PRINCESS;
use radiant::RADIANT;
use rose::ROSE;
use single_cut::SINGLE_CUT;
use tapered_baguette::TAPERED_BAGUETTE;
use trillion::TRILLION;

/// All families that are described by proportions, in the order in which messages list them.
pub static FAMILIES: [&Family; 27] = [
    &ROUND_BRILLIANT,
    &SINGLE_CUT,
    &PORTUGUESE,
    &ROSE,
    &BRIOLETTE,
    &OVAL,
    &MARQUISE,
    &PEAR,
    &HEART,
    &CUSHION,
    &TRILLION,
    &EMERALD,
    &ASSCHER,
    &BAGUETTE,
    &TAPERED_BAGUETTE,
    &KITE,
    &HEXAGON,
    &PRINCESS,
    &RADIANT,
    &MODIFIED_CUSHION,
    &BARION,
    &CUSHION_BARION,
    &OVAL_BARION,
    &PILL,
    &CUBE,
    &PRISM,
    &PLATE,
];

/// The key that stands for cuts without a family among [`GROUPS`].
pub const BY_TIERS: &str = "tiers";

/// The families as the trade groups them: the name of each group, and the keys of its families.
pub const GROUPS: [(&str, &[&str]); 6] = [
    ("Rounds", &["round_brilliant", "single_cut", "portuguese", "rose", "briolette"]),
    ("Fancy brilliant cuts", &["oval", "pear", "marquise", "heart", "cushion", "trillion"]),
    ("Step cuts", &["emerald", "asscher", "baguette", "tapered_baguette", "kite", "hexagon"]),
    ("Mixed cuts", &["princess", "radiant", "modified_cushion", "barion", "cushion_barion", "oval_barion"]),
    ("By tiers", &[BY_TIERS]),
    ("Glass", &["pill", "cube", "prism", "plate"]),
];

impl Family {
    /// Returns the family that has this key in cut files.
    pub fn of_key(key: &str) -> Option<&'static Self> {
        FAMILIES.into_iter().find(|family| family.key == key)
    }
}

impl Cut {
    /// Returns the family; `None` for a cut that lists its facets or triangles.
    pub fn family(&self) -> Option<&'static Family> {
        match self {
            Self::RoundBrilliant(_) => Some(&ROUND_BRILLIANT),
            Self::Family(cut) => Some(cut.family),
            Self::Glass(Glass::Pill(_)) => Some(&PILL),
            Self::Glass(Glass::Cube(_)) => Some(&CUBE),
            Self::Glass(Glass::Prism(_)) => Some(&PRISM),
            Self::Glass(Glass::Plate(_)) => Some(&PLATE),
            Self::Tiers(_) | Self::Planes(_) | Self::Mesh(_) => None,
        }
    }

    /// Returns the rows of the family's table; none for a cut that lists its facets or triangles.
    pub fn proportions(&self) -> &'static [Proportion] {
        self.family().map_or(&[], |family| family.proportions)
    }

    /// Returns the proportion that has this key in cut files.
    pub fn proportion(&self, key: &str) -> Option<&'static Proportion> {
        self.family()?.proportion(key)
    }

    /// Returns the proportions that the cut gives, with their values.
    pub fn given(&self) -> impl Iterator<Item = (&'static Proportion, f64)> {
        let given = self.family().into_iter().flat_map(Family::editable).filter(|row| (row.is_given)(self));
        given.map(|row| (row, (row.get)(self)))
    }

    /// Returns the proportion that a handle of the profile changes.
    pub fn handled_by(&self, handle: ProfileHandle) -> Option<&'static Proportion> {
        self.proportions().iter().find(|row| row.handles.contains(&handle))
    }
}
