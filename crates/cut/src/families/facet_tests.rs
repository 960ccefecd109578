//! Tests for every facet of a family's stones: no facet is a sliver, every plane is used, and facets meet in points.

use super::tests::{made, on_random_cuts, stone};
use super::*;
use crate::FacetZones;
use crate::{Audit, AuditSubject, Finding, FindingKind, TierZone, audit::THIN_FACET, tier_stem};
use brillianteer_math::{Facet, Polytope, span};
use glam::DVec3;
use proptest::prelude::*;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// The least area of a facet, as a part of the median area of its zone, and its least width, as a part of the stone's.
const LEAST: f64 = THIN_FACET / 100.0;

/// The solid of a net, the stone or one half of it, with the tier of each plane.
struct Solid {
    solid: Polytope,
    tiers: Vec<&'static str>,
    zones: FacetZones,
    is_half: bool,
}

impl Solid {
    fn of(cut: &Cut) -> Option<Self> {
        let Cut::Family(family_cut) = cut else { return None };
        cut.check().ok()?;
        let (net, solid) = family_cut.settled().ok()?;
        let tiers = net.facets().map(|(tier, _)| tier).collect();
        Some(Self { zones: FacetZones::of(&solid), solid, tiers, is_half: net.is_half() })
    }

    /// Returns the facets with their tiers, without the plane in which both halves meet.
    fn facets(&self) -> impl Iterator<Item = (&'static str, &Facet)> {
        self.solid.facets().iter().filter_map(|facet| Some((*self.tiers.get(facet.source)?, facet)))
    }

    /// Returns the area of a facet on the whole stone.
    fn area(&self, facet: &Facet) -> f64 {
        let on_seam = self.solid.corners(facet).filter(|corner| corner.x.abs() < 1e-9).count();
        let is_cut = self.is_half && on_seam > 1 && facet.plane.normal.x.abs() < 1e-12;
        self.solid.facet_area(facet) * if is_cut { 2.0 } else { 1.0 }
    }

    /// Returns whether a facet is a sliver. An upright facet may be as low as the girdle is thin, and then as short.
    fn is_thin(&self, facet: &Facet) -> bool {
        let least = 2.0 * LEAST;
        if self.zones.zone(facet) != TierZone::Girdle {
            return self.solid.facet_width(facet) < least;
        }
        let extent = |along: DVec3| {
            let (low, high) = span(self.solid.corners(facet).map(|corner| corner.dot(along)));
            high - low
        };
        extent(facet.plane.normal.cross(DVec3::Z)) < least.min(extent(DVec3::Z))
    }

    /// Returns the faults of the facets, each with its tier and a figure in percent.
    fn faults(&self) -> Vec<(&'static str, &'static str, f64)> {
        let mut faults = vec![];
        let mut areas: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
        self.facets().for_each(|(_, facet)| {
            areas.entry(self.zones.zone(facet).name()).or_default().push(self.area(facet))
        });
        areas.values_mut().for_each(|areas| areas.sort_by(f64::total_cmp));
        for (tier, facet) in self.facets() {
            let area = self.area(facet)
                / areas[self.zones.zone(facet).name()][areas[self.zones.zone(facet).name()].len() / 2];
            if area < LEAST {
                faults.push(("small", tier, 100.0 * area));
            }
            // A culet may be as small as its proportion asks.
            if tier != "culet" && self.is_thin(facet) {
                faults.push(("thin", tier, 50.0 * self.solid.facet_width(facet)));
            }
        }
        for (place, tier) in self.tiers.iter().enumerate() {
            if !self.solid.facets().iter().any(|facet| facet.source == place) {
                faults.push(("unused", *tier, 0.0));
            }
        }
        faults
    }
}

#[test]
fn no_facet_is_a_sliver_and_every_plane_has_a_facet() {
    let found: RefCell<BTreeMap<_, (u32, u32, f64)>> = RefCell::default();
    on_random_cuts(|family, cut| {
        let Some(solid) = Solid::of(cut) else { return Ok(false) };
        let mut kinds = BTreeMap::new();
        for (kind, tier, size) in solid.faults() {
            let entry = kinds.entry((family.key, kind, tier)).or_insert((0, size));
            *entry = (entry.0 + 1, f64::min(size, entry.1));
        }
        for (key, (count, size)) in kinds {
            let mut found = found.borrow_mut();
            let entry = found.entry(key).or_insert((0, 0, size));
            *entry = (entry.0 + 1, entry.1 + count, f64::min(size, entry.2));
        }
        Ok(true)
    });
    // Family, fault and tier; the number of stones, of facets, and the smallest size in percent.
    assert!(found.borrow().is_empty(), "{:#?}", found.borrow());
}

/// Returns the edges of a convex stone that may be a meet of four facets that is split, by the tiers of these facets, with their
/// lengths in percent of the width. Edges of a culet are as short as it is small.
fn split_meets(cut: &Cut) -> Option<Vec<(String, f64)>> {
    let (stone, names) = stone(cut)?;
    let subject =
        AuditSubject { stone: &stone, names: &names, planes: &names, tiers: None, critical_deg: None };
    let is_meet = |finding: &&Finding| !finding.facets.iter().any(|name| name == "culet");
    let named = |finding: &Finding| {
        let mut tiers: Vec<&str> = finding.facets.iter().map(|name| tier_stem(name)).collect();
        tiers.sort_unstable();
        (tiers.join(" "), finding.size)
    };
    Some(Audit::of(&subject).of_kind(FindingKind::SplitMeet).filter(is_meet).map(named).collect())
}

/// The edges that real stones of the cut have as well: the upper edges of corners' facets below a table of eight or more sides, where
/// the crown has one row.
const TABLE_EDGE: &str = "crown_1 crown_1 crown_1 table";

/// The families with such edges: the most in a stone, a multiple of four, and their least length in percent of the width.
const TABLE_EDGES: [(&str, f64, f64); 3] =
    [("asscher", 4.0, 10.0), ("cushion_barion", 8.0, 9.9), ("oval_barion", 4.0, 10.0)];

#[test]
fn facets_meet_in_points() {
    let first = made().filter_map(|(family, _)| Some((family.key, split_meets(&family.first)?)));
    let first: Vec<_> = first.filter(|(_, edges)| !edges.is_empty()).collect();
    assert!(first.is_empty(), "{first:?}");
    let found: RefCell<BTreeMap<_, BTreeMap<_, [f64; 4]>>> = RefCell::default();
    on_random_cuts(|family, cut| {
        let Some(edges) = split_meets(cut) else { return Ok(false) };
        let mut found = found.borrow_mut();
        let of_family = found.entry(family.key).or_default();
        for (tiers, _) in &edges {
            let same = || edges.iter().filter(|(other, _)| other == tiers);
            let sizes = same().map(|(_, size)| *size);
            let [stones, count, least, most] =
                of_family.entry(tiers.clone()).or_insert([0.0, 0.0, 100.0, 0.0]);
            *stones += 1.0 / same().count() as f64;
            *count = count.max(same().count() as f64);
            *least = sizes.clone().fold(*least, f64::min);
            *most = sizes.fold(*most, f64::max);
        }
        Ok(true)
    });
    // Family, tiers; stones of 300, edges of each, their least and greatest length in percent of the width.
    let found = found.into_inner();
    let is_known = |key: &str, tiers: &str, [_, count, least, _]: [f64; 4]| {
        let of_family = TABLE_EDGES.iter().find(|(family, ..)| *family == key);
        let is_within = |(_, most, shortest): &(&str, f64, f64)| {
            count <= *most && count % 4.0 == 0.0 && least >= *shortest
        };
        tiers == TABLE_EDGE && of_family.is_some_and(is_within)
    };
    let split: Vec<_> = found
        .iter()
        .flat_map(|(key, edges)| edges.iter().map(move |(tiers, sizes)| (key, tiers, *sizes)))
        .filter(|(key, tiers, sizes)| !is_known(key, tiers, *sizes))
        .collect();
    assert!(found.len() > 15 && split.is_empty(), "split meets: {split:#?}");
    assert!(!found["asscher"].is_empty(), "the edges of the table are found");
}

#[test]
fn a_brilliant_has_the_facets_that_its_mains_make() {
    let counted = on_random_cuts(|family, cut| {
        // Where there is no culet, all mains touch in a point.
        let mut pointed = cut.clone();
        family
            .proportion("culet")
            .filter(|row| row.can_be_set())
            .iter()
            .for_each(|row| row.set(&mut pointed, 0.0));
        Ok(has_its_facets(family, cut)? && has_its_facets(family, &pointed)?)
    });
    assert_eq!(counted.iter().filter(|(_, count)| *count > 240).count(), 6, "{counted:?}");
}

/// Checks the number of facets of each tier of a brilliant; returns `false` for other families and cuts that make no stone.
fn has_its_facets(family: &Family, cut: &Cut) -> Result<bool, TestCaseError> {
    let count = |key: &str| family.proportion(key).map_or(0.0, |row| (row.get)(cut)) as usize;
    // A heart has one main more than gaps between mains.
    let (gaps, extra) = match family.key {
        "oval" | "marquise" | "pear" | "cushion" => (4 * count("mains_per_quarter"), 0),
        "trillion" => (3 * count("mains_per_side"), 0),
        "heart" => (2 * count("mains_per_half"), 1),
        _ => return Ok(false),
    };
    let Some(solid) = super::tests::Solid::of(cut) else { return Ok(false) };
    let of = |tier: &str| solid.tiers.get(tier).copied().unwrap_or(0);
    let found = ["table", "bezel", "star", "upper_half", "lower_half", "main"].map(of);
    let mains = gaps + extra;
    prop_assert_eq!(found, [1, mains, gaps, 2 * gaps, 2 * gaps, mains]);
    // Seven upright facets to each main, and one more at a corner of the outline; fewer where the girdle closes.
    let corners = [("marquise", 2), ("pear", 1), ("trillion", 3), ("heart", 2)];
    let corners = corners.iter().find(|(key, _)| *key == family.key).map_or(0, |(_, corners)| *corners);
    let whole = 7 * gaps + corners;
    prop_assert!(of("girdle") <= whole && of("girdle") >= 2 * gaps, "{} of {whole}", of("girdle"));
    // Along the lobes of a heart, halves cut deep into the girdle.
    let is_thick = count("girdle_thickness") >= 6 && family.key != "heart";
    prop_assert!(!is_thick || of("girdle") == whole, "{} of {whole}", of("girdle"));
    Ok(true)
}
