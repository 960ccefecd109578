//! Edits of one number of a design, which all meets follow.

use super::super::tiers::Tiers;
use super::solve::SolvedTiers;

/// A change of one number of a tier.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TierEdit {
    /// The angle from the girdle plane, degrees.
    Angle(f64),
    /// The distance from the origin, in the design's unit. The tier loses its meet, which would give another.
    Distance(f64),
    /// The index of one facet.
    Index {
        /// The place of the facet in its tier, from 0.
        facet: usize,
        /// The index on the gear, in teeth.
        index: f64,
    },
}

impl Tiers {
    /// Returns the design with one number of the tier at a place changed, from 0, and with all meets followed. A place past the
    /// last tier or facet changes nothing.
    pub fn edited(&self, place: usize, edit: TierEdit) -> SolvedTiers {
        let mut design = self.clone();
        if let Some(tier) = design.tiers.get_mut(place) {
            match edit {
                TierEdit::Angle(angle) => tier.angle = angle,
                TierEdit::Distance(distance) => (tier.distance, tier.meet) = (distance, None),
                TierEdit::Index { facet, index } => {
                    tier.facets.iter_mut().skip(facet).take(1).for_each(|facet| facet.index = index);
                }
            }
        }
        design.solved()
    }
}
