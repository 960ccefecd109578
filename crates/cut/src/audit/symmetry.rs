//! Finds the facets that depart from the symmetry that the design states or that nearly all facets keep.

use super::finding::{Finding, FindingKind, FindingUnit};
use super::subject::Subject;
use crate::{Outline, TierZone, Tiers};
use brillianteer_math::{Plane, grouped};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// The distance, in percent of the width at the girdle, up to which an image and a facet count as one: about a tenth of
/// a degree. A facet departs where fewer than half of its images are facets.
pub const OFF_SYMMETRY: f64 = 0.1;

/// A symmetry that the file does not state counts as intended where at least this part of the facets keeps it.
const NEARLY_ALL: f64 = 0.9;

/// Planes farther from an image than this many slacks are not compared with it.
const FAR: f64 = 20.0;

/// Where the symmetry is not stated, a facet departs from it if its distance is more than this many times the
/// greatest among [`NEARLY_ALL`] of the facets. In a stone whose length is nearly its width, all facets lie a little
/// off a symmetry that the stone does not have, and none far more than the others.
const BEYOND_OTHERS: f64 = 3.0;

/// The part of the facets of crown and pavilion that must keep a stated symmetry for the others to count as departures from
/// it, in percent.
pub const MOST_KEEP: f64 = 60.0;

/// The most turns that are tried where the file states no symmetry.
const MOST_TURNS: u32 = 16;

/// The most lines that are tried as mirrors.
const MOST_MIRRORS: usize = 64;

/// A rotation about the axis, or a reflection in a line through it.
#[derive(Clone, Copy)]
enum Map {
    Turn(f64),
    /// The azimuth of the line, radians.
    Mirror(f64),
}

impl Map {
    fn image(self, plane: &Plane) -> Plane {
        let across = plane.normal.truncate();
        let mapped = match self {
            Self::Turn(angle) => DVec2::from_angle(angle).rotate(across),
            Self::Mirror(line) => DVec2::from_angle(2.0 * line).rotate(DVec2::new(across.x, -across.y)),
        };
        Plane { normal: mapped.extend(plane.normal.z), offset: plane.offset }
    }
}

/// The planes of a stone, sorted by the height of their normals, which no map changes.
struct Planes {
    sorted: Vec<Plane>,
    width: f64,
    /// The greatest distance of an image from a plane that counts as kept, in percent of the width.
    slack: f64,
}

impl Planes {
    fn of(subject: &Subject) -> Self {
        let outline = &subject.outline;
        let mut sorted: Vec<Plane> =
            subject.given.stone.planes().map(|plane| about_middle(outline, plane)).collect();
        sorted.sort_by(|a, b| a.normal.z.total_cmp(&b.normal.z));
        Self { sorted, width: outline.width, slack: slack(subject.given.tiers) }
    }

    /// Returns the distance of two planes at the girdle, in percent of the width.
    fn apart(&self, a: &Plane, b: &Plane) -> f64 {
        let lean = 0.5 * a.normal.distance(b.normal);
        100.0 * lean.max((a.offset - b.offset).abs() / self.width)
    }

    /// Returns the planes that may lie at most this far from an image, in percent of the width.
    fn near(&self, image: &Plane, most: f64) -> impl Iterator<Item = &Plane> {
        let reach = 2.0 * most / 100.0;
        let height = image.normal.z;
        let first = self.sorted.partition_point(|plane| plane.normal.z < height - reach);
        self.sorted[first..].iter().take_while(move |plane| plane.normal.z <= height + reach)
    }

    fn has(&self, image: &Plane) -> bool {
        self.near(image, self.slack).any(|plane| self.apart(plane, image) <= self.slack)
    }

    /// Returns the part of the planes whose image is a plane of the stone.
    fn keeping(&self, map: Map) -> f64 {
        let kept = self.sorted.iter().filter(|plane| self.has(&map.image(plane))).count();
        kept as f64 / self.sorted.len() as f64
    }

    /// Returns whether a plane departs from a symmetry: fewer than half of its images are planes of the stone.
    fn departs(&self, plane: &Plane, maps: &[Map]) -> bool {
        let kept = maps.iter().filter(|map| self.has(&map.image(plane))).count();
        2 * kept < maps.len()
    }

    /// Returns the distance of an image from the nearest plane of the stone, in percent of the width; infinite where
    /// none is near.
    fn to_nearest(&self, image: &Plane) -> f64 {
        let near = self.near(image, FAR * self.slack);
        near.map(|plane| self.apart(plane, image)).fold(f64::INFINITY, f64::min)
    }

    /// Returns the median distance (the lower of two) of a plane's images from planes of the stone, in percent of the
    /// width: above the slack exactly where the plane [`departs`](Self::departs).
    fn usual_departure(&self, plane: &Plane, maps: &[Map]) -> f64 {
        let mut all: Vec<f64> = maps.iter().map(|map| self.to_nearest(&map.image(plane))).collect();
        all.sort_by(f64::total_cmp);
        all[(all.len() - 1) / 2]
    }

    /// Returns the greatest distance of an image of a plane from the nearest plane of the stone, in percent of the
    /// width.
    fn departure(&self, plane: &Plane, maps: &[Map]) -> f64 {
        let nearest = |image: Plane| {
            self.sorted.iter().map(|other| self.apart(other, &image)).fold(f64::INFINITY, f64::min)
        };
        maps.iter().map(|map| nearest(map.image(plane))).fold(0.0, f64::max)
    }
}

/// Returns a plane about the middle of the girdle, so that a lean shifts it by no more than it does within the stone.
fn about_middle(outline: &Outline, plane: Plane) -> Plane {
    let middle = outline.middle.extend(0.5 * (outline.girdle_bottom + outline.girdle_top));
    Plane { offset: plane.offset - plane.normal.dot(middle), ..plane }
}

/// Returns the greatest distance of an image from a plane that counts as kept, in percent of the width. Where the
/// teeth of the gear are no multiple of the stated symmetry, indices are rounded to teeth, so that a whole tooth is
/// no departure.
fn slack(tiers: Option<&Tiers>) -> f64 {
    let rounded =
        tiers.filter(|tiers| tiers.symmetry > 0 && !tiers.gear.unsigned_abs().is_multiple_of(tiers.symmetry));
    let tooth = rounded.map_or(0.0, |tiers| 100.0 * 0.5 * TAU / f64::from(tiers.gear.unsigned_abs().max(1)));
    OFF_SYMMETRY + tooth
}

/// Returns all maps of a symmetry except the identity.
fn maps(turns: u32, mirror: Option<f64>) -> Vec<Map> {
    let step = TAU / f64::from(turns);
    let turned = (1..turns).map(|k| Map::Turn(f64::from(k) * step));
    let mirrored = mirror
        .into_iter()
        .flat_map(|line| (0..turns).map(move |k| Map::Mirror(line + 0.5 * f64::from(k) * step)));
    turned.chain(mirrored).collect()
}

/// Returns the facets that depart from the symmetry, by tiers.
pub(super) fn departures(subject: &Subject) -> Vec<Finding> {
    let planes = Planes::of(subject);
    let stated = subject.given.tiers.filter(|tiers| tiers.symmetry > 1 || tiers.mirror);
    let maps = match stated {
        Some(tiers) => stated_maps(tiers, subject, &planes),
        None => found_maps(subject, &planes),
    };
    if maps.is_empty() {
        return vec![];
    }
    let seen = |facet: usize| about_middle(&subject.outline, subject.facets()[facet].plane);
    let mut off: Vec<usize> =
        (0..subject.facets().len()).filter(|&facet| planes.departs(&seen(facet), &maps)).collect();
    let mut threshold = planes.slack;
    if stated.is_none() && !off.is_empty() {
        let usual: Vec<f64> =
            (0..subject.facets().len()).map(|facet| planes.usual_departure(&seen(facet), &maps)).collect();
        threshold = threshold.max(BEYOND_OTHERS * most_of_nearly_all(&usual));
        off.retain(|&facet| usual[facet] > threshold);
    }
    let kept = kept_percent(subject, &off);
    if stated.is_some() && kept < MOST_KEEP {
        return vec![stated_symmetry_is_not_kept(kept, subject.names(&off))];
    }
    let finding = |tier: Vec<usize>| Finding {
        kind: if subject.is_girdle(tier[0]) { FindingKind::Outline } else { FindingKind::Symmetry },
        points: tier.iter().map(|&facet| subject.middle(facet)).collect::<Vec<DVec3>>(),
        facets: subject.names(&tier),
        size: tier.iter().map(|&facet| planes.departure(&seen(facet), &maps)).fold(0.0, f64::max),
        threshold,
        unit: FindingUnit::PercentOfWidth,
    };
    grouped(off, |&a, &b| subject.tier(a) == subject.tier(b)).into_iter().map(finding).collect()
}

/// Returns the greatest of these values after the greatest ones beyond [`NEARLY_ALL`] are left out.
fn most_of_nearly_all(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let nearly_all = (NEARLY_ALL * sorted.len() as f64).ceil() as usize;
    sorted.get(nearly_all.saturating_sub(1)).copied().unwrap_or(0.0)
}

/// Returns the part of the facets of crown and pavilion that are not among those `off` the symmetry, in percent. A
/// girdle of many facets has symmetries that the stone lacks.
fn kept_percent(subject: &Subject, off: &[usize]) -> f64 {
    let all = (0..subject.facets().len()).filter(|&facet| !subject.is_girdle(facet)).count();
    let off = off.iter().filter(|&&facet| !subject.is_girdle(facet)).count();
    100.0 * (1.0 - off as f64 / all.max(1) as f64)
}

fn stated_symmetry_is_not_kept(kept: f64, facets: Vec<String>) -> Finding {
    Finding {
        kind: FindingKind::StatedSymmetry,
        points: vec![],
        facets,
        size: kept,
        threshold: MOST_KEEP,
        unit: FindingUnit::PercentOfFacets,
    }
}

/// Returns the maps of the symmetry that the design states. Its mirror is the line through index 0, or, where that
/// line is not a mirror, the best one that the facets show.
fn stated_maps(tiers: &Tiers, subject: &Subject, planes: &Planes) -> Vec<Map> {
    let turns = tiers.symmetry.clamp(1, 360);
    let index_0 = -0.25 * TAU - tiers.offset / f64::from(tiers.gear) * TAU;
    let mirror = tiers.mirror.then(|| {
        if planes.keeping(Map::Mirror(index_0)) >= NEARLY_ALL {
            return index_0;
        }
        best_mirror(subject, planes).unwrap_or(index_0)
    });
    maps(turns, mirror)
}

/// Returns the maps of the highest symmetry that nearly all facets keep; an empty list where there is none.
fn found_maps(subject: &Subject, planes: &Planes) -> Vec<Map> {
    let is_kept = |turns: &u32| planes.keeping(Map::Turn(TAU / f64::from(*turns))) >= NEARLY_ALL;
    let turns = (2..=MOST_TURNS).rev().find(is_kept).unwrap_or(1);
    let mirror = best_mirror(subject, planes).filter(|&line| planes.keeping(Map::Mirror(line)) >= NEARLY_ALL);
    maps(turns, mirror)
}

/// Returns the azimuth, radians, of the mirror line that most planes keep; `None` where all facets are level.
fn best_mirror(subject: &Subject, planes: &Planes) -> Option<f64> {
    let leaning = (0..subject.facets().len())
        .filter(|&facet| !matches!(subject.zones[facet], TierZone::Table | TierZone::Culet));
    let tiers =
        grouped(leaning, |&a, &b| subject.tier(a) == subject.tier(b) && subject.zones[a] == subject.zones[b]);
    let smallest = tiers.into_iter().min_by_key(Vec::len)?;
    let azimuths: Vec<f64> =
        smallest.iter().map(|&facet| subject.facets()[facet].plane.normal.truncate().to_angle()).collect();
    let lines = azimuths.iter().map(|azimuth| 0.5 * (azimuths[0] + azimuth)).take(MOST_MIRRORS);
    // The first line runs through the first facet, the others half way between it and another facet of its tier.
    let kept = lines.map(|line| (planes.keeping(Map::Mirror(line)), line));
    kept.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, line)| line)
}
