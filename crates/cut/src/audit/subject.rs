//! The subject of an audit: a stone, and the statements of its design.

use crate::FacetZones;
use crate::{Outline, TierZone, Tiers, tier_stem};
use brillianteer_math::{Facet, Polytope};
use glam::DVec3;

/// A stone to audit, with the statements of its design.
#[derive(Debug, Clone, Copy)]
pub struct AuditSubject<'a> {
    /// The stone, +z out of its table, its axis x = y = 0. The unit of length does not matter.
    pub stone: &'a Polytope,
    /// The names of its facets, in their order; facets beyond the last name are numbered from 1.
    pub names: &'a [String],
    /// The names of the design's planes, from which the stone was built, in their order; planes beyond them are the block that
    /// closes an open stone. Where the list is empty, unused planes are called by their numbers.
    pub planes: &'a [String],
    /// The tiers, where the design has tiers: they state its symmetry.
    pub tiers: Option<&'a Tiers>,
    /// The medium's critical angle, degrees; `None` where the medium is unknown or has none.
    pub critical_deg: Option<f64>,
}

/// A stone that is being audited: its width, and the zone of each facet.
pub(super) struct Subject<'a> {
    pub given: &'a AuditSubject<'a>,
    pub outline: Outline,
    pub zones: Vec<TierZone>,
    names: Vec<String>,
}

impl<'a> Subject<'a> {
    pub fn new(given: &'a AuditSubject<'a>) -> Self {
        let (facets, in_zones) = (given.stone.facets(), FacetZones::of(given.stone));
        let name = |place: usize| match given.names.get(place) {
            Some(name) => name.clone(),
            None => format!("facet {}", place + 1),
        };
        Self {
            given,
            outline: Outline::of(given.stone),
            zones: facets.iter().map(|facet| in_zones.zone(facet)).collect(),
            names: (0..facets.len()).map(name).collect(),
        }
    }

    pub fn facets(&self) -> &'a [Facet] {
        self.given.stone.facets()
    }

    /// Returns a length in percent of the stone's width.
    pub fn percent(&self, length: f64) -> f64 {
        100.0 * length / self.outline.width
    }

    /// Returns the names of facets, in order.
    pub fn names(&self, facets: &[usize]) -> Vec<String> {
        facets.iter().map(|&facet| self.names[facet].clone()).collect()
    }

    /// Returns the name of a facet's tier.
    pub fn tier(&self, facet: usize) -> &str {
        tier_stem(&self.names[facet])
    }

    pub fn is_girdle(&self, facet: usize) -> bool {
        self.zones[facet] == TierZone::Girdle
    }

    /// Returns the mean of a facet's corners, by which a finding about a facet is placed.
    pub fn middle(&self, facet: usize) -> DVec3 {
        let facet = &self.facets()[facet];
        self.given.stone.corners(facet).sum::<DVec3>() / facet.outline.len() as f64
    }
}
