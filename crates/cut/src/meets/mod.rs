//! Meets, by which cutters say where the facets of a tier go. A tier stores a `meet`; `words` reads meets from
//! instructions, `stated` chooses the reading that agrees with the design's numbers, `found` finds meets in the geometry,
//! and `solve` follows them
//! to the corners that a facet can `reach`. `corners` lists those that a tier of a finished stone can be moved to,
//! `picked` finds the meet through two or three of them, and `corner_fault` says why there is none.
//!
//! `tier_names` gives every tier the name by which meets and lists call it, and `written` reads the program's own words.
//!
//! A meet is a point on the stone as it is cut so far (`stone`): a corner where named tiers meet (`names`), a corner of the
//! girdle, the girdle line, or the point where the axis leaves the stone. Names may be written as cutters write them: P1 is
//! the pavilion tier 1, G1 a girdle tier, C1 the crown tier 1, and small and capital letters are the same.

mod corner_fault;
mod corners;
#[cfg(test)]
mod corners_tests;
mod fault;
mod found;
mod known;
mod meet;
mod names;
mod picked;
mod reach;
mod solve;
mod stated;
#[cfg(test)]
mod stated_tests;
mod stone;
#[cfg(test)]
mod tests;
mod tier_names;
mod words;
mod written;

pub use corner_fault::CornerFault;
pub use corners::TierCorner;
pub use fault::{MeetError, MeetFault};
pub use known::{KnownMeets, MeetOutcome, MeetSource, TierMeet};
pub use meet::{GivenSize, Meet, MeetPoint};
pub use solve::{SolvedTiers, TierOutcome};
