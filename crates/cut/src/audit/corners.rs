//! The corners of a stone as a cutter sees them, the edges between them, and meets that are missed by little.

use super::finding::{Finding, FindingKind, FindingUnit};
use super::subject::Subject;
use crate::TierZone;
use glam::DVec3;
use std::f64::consts::PI;

/// Corners nearer to one another than this, in percent of the width, count as one: the last digits of cutters' files
/// split corners by less, and no loupe shows it. A chain of such corners is one too.
pub const SAME_CORNER: f64 = 0.1;

/// Corners that are two, but nearer to one another than this, in percent of the width, nearly meet.
pub const NEAR_MISS: f64 = 1.0;

/// An edge shorter than this, in percent of the width, may be a meet of four facets that is split.
pub const SPLIT_MEET: f64 = 12.0;

/// Facets whose azimuths differ by less than this, radians, are steps of one flight, whose edges are parallel and not
/// split meets.
const SAME_AZIMUTH: f64 = 0.5 * PI / 180.0;

/// An edge that is longer than this part of the extent of a facet beside it is a side of that facet, and not a split
/// meet: if it shrank to a point, the facet's shape would change.
const PART_OF_SIDE: f64 = 0.5;

/// Edges turn by less than this where one goes on along the other (cosine of 20°).
const GOES_ON: f64 = 0.94;

/// Edges are as long as one another where the longer is no longer than this many times the shorter.
const AS_LONG: f64 = 1.25;

/// A corner: vertices that look like one point.
pub(super) struct Corner {
    /// The mean of the vertices.
    pub at: DVec3,
    /// The facets that meet here, in order, without any that lies within the corner.
    pub facets: Vec<usize>,
}

/// An edge between two corners.
struct CornerEdge {
    ends: [usize; 2],
    sides: [usize; 2],
    length: f64,
}

/// The corners of a stone, and the edges between them.
pub(super) struct Corners {
    pub all: Vec<Corner>,
    edges: Vec<CornerEdge>,
    /// The corners around each facet.
    outlines: Vec<Vec<usize>>,
}

/// Calls `pair` for each two points that are nearer to one another than `reach`, the first below the second by place.
fn pairs_within(points: &[DVec3], reach: f64, mut pair: impl FnMut(usize, usize)) {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| points[a].x.total_cmp(&points[b].x));
    for (place, &a) in order.iter().enumerate() {
        let near = order[place + 1..].iter().take_while(|&&b| points[b].x - points[a].x < reach);
        near.filter(|&&b| points[a].distance_squared(points[b]) < reach * reach)
            .for_each(|&b| pair(a.min(b), a.max(b)));
    }
}

/// Returns the number of each vertex's corner, and the number of corners.
fn clusters(points: &[DVec3], reach: f64) -> (Vec<usize>, usize) {
    let mut root: Vec<usize> = (0..points.len()).collect();
    fn find(root: &mut [usize], mut at: usize) -> usize {
        while root[at] != at {
            root[at] = root[root[at]];
            at = root[at];
        }
        at
    }
    pairs_within(points, reach, |a, b| {
        let (a, b) = (find(&mut root, a), find(&mut root, b));
        root[a.max(b)] = a.min(b);
    });
    let mut count = 0;
    let mut number = vec![usize::MAX; points.len()];
    let of = (0..points.len()).map(|vertex| {
        let first = find(&mut root, vertex);
        if number[first] == usize::MAX {
            number[first] = count;
            count += 1;
        }
        number[first]
    });
    (of.collect(), count)
}

impl Corners {
    pub fn of(subject: &Subject) -> Self {
        let points = subject.given.stone.vertices();
        let (of, count) = clusters(points, SAME_CORNER / 100.0 * subject.outline.width);
        let mut sums = vec![(DVec3::ZERO, 0.0); count];
        for (&corner, &point) in of.iter().zip(points) {
            sums[corner].0 += point;
            sums[corner].1 += 1.0;
        }
        let mut all: Vec<Corner> =
            sums.iter().map(|(sum, number)| Corner { at: *sum / *number, facets: vec![] }).collect();
        let (mut edges, mut outlines) = (vec![], vec![]);
        for (place, facet) in subject.facets().iter().enumerate() {
            let outline: Vec<usize> = facet.outline.iter().map(|&vertex| of[vertex as usize]).collect();
            let is_visible = outline.iter().any(|&corner| corner != outline[0]);
            for (k, &corner) in outline.iter().enumerate() {
                if is_visible && all[corner].facets.last() != Some(&place) {
                    all[corner].facets.push(place);
                }
                let (next, other) = (outline[(k + 1) % outline.len()], facet.neighbours[k] as usize);
                if corner != next && place < other {
                    let length = all[corner].at.distance(all[next].at);
                    edges.push(CornerEdge { ends: [corner, next], sides: [place, other], length });
                }
            }
            let mut around = outline;
            around.dedup();
            if around.first() == around.last() {
                around.pop();
            }
            outlines.push(around);
        }
        Self { all, edges, outlines }
    }

    /// Returns the lengths of all edges except for those between two facets of the girdle.
    pub fn edges_beside_girdle(&self, subject: &Subject) -> Vec<f64> {
        let is_beside = |edge: &&CornerEdge| !edge.sides.iter().all(|&side| subject.is_girdle(side));
        self.edges.iter().filter(is_beside).map(|edge| edge.length).collect()
    }

    /// Returns the split meets and the near misses.
    pub fn findings(&self, subject: &Subject) -> Vec<Finding> {
        let splits: Vec<&CornerEdge> =
            self.edges.iter().filter(|edge| self.is_split(edge, subject)).collect();
        let mut known: Vec<[usize; 2]> = splits.iter().map(|edge| sorted(edge.ends)).collect();
        known.extend(
            self.edges.iter().filter(|edge| self.is_side(edge, subject)).map(|edge| sorted(edge.ends)),
        );
        known.sort_unstable();
        let mut misses = vec![];
        let points: Vec<DVec3> = self.all.iter().map(|corner| corner.at).collect();
        pairs_within(&points, NEAR_MISS / 100.0 * subject.outline.width, |a, b| {
            if known.binary_search(&[a, b]).is_err() && !self.is_across_girdle([a, b], subject) {
                misses.push([a, b]);
            }
        });
        misses.sort_unstable();
        let near =
            misses.into_iter().map(|ends| self.finding(FindingKind::NearMiss, ends, NEAR_MISS, subject));
        let split = splits.iter().map(|e| self.finding(FindingKind::SplitMeet, e.ends, SPLIT_MEET, subject));
        near.chain(split).collect()
    }

    fn finding(&self, kind: FindingKind, ends: [usize; 2], threshold: f64, subject: &Subject) -> Finding {
        let [a, b] = ends.map(|corner| &self.all[corner]);
        let mut facets = [a.facets.as_slice(), &b.facets].concat();
        facets.sort_unstable();
        facets.dedup();
        Finding {
            kind,
            points: vec![a.at, b.at],
            facets: subject.names(&facets),
            size: subject.percent(a.at.distance(b.at)),
            threshold,
            unit: FindingUnit::PercentOfWidth,
        }
    }

    /// Returns whether an edge may be a split meet of four facets.
    fn is_split(&self, edge: &CornerEdge, subject: &Subject) -> bool {
        edge.length < SPLIT_MEET / 100.0 * subject.outline.width
            && edge.ends.iter().all(|&end| self.all[end].facets.len() == 3)
            && !self.is_side(edge, subject)
    }

    /// Returns whether an edge is a side of the facets beside it, however short, and so not a split meet: an edge
    /// between steps, an upright edge of the girdle, an edge among three girdle facets, one half of a side, or one that is as
    /// long as a facet beside it is wide.
    fn is_side(&self, edge: &CornerEdge, subject: &Subject) -> bool {
        let [a, b] = edge.sides;
        if subject.is_girdle(a) && subject.is_girdle(b) || same_azimuth(subject, a, b) {
            return true;
        }
        if edge.sides.iter().any(|&side| self.is_half_of_side(edge, side)) {
            return true;
        }
        let mut around: Vec<usize> =
            edge.ends.iter().flat_map(|&end| self.all[end].facets.iter().copied()).collect();
        around.sort_unstable();
        around.dedup();
        // Upright planes share no single point, but at most an upright line.
        if around.iter().filter(|&&facet| subject.is_girdle(facet)).count() > 2 {
            return true;
        }
        let [from, to] = edge.ends.map(|end| self.all[end].at);
        let along = (to - from) / edge.length;
        edge.sides.iter().any(|&side| {
            let facet = &subject.facets()[side];
            let (low, high) =
                brillianteer_math::span(subject.given.stone.corners(facet).map(|corner| corner.dot(along)));
            edge.length > PART_OF_SIDE * (high - low)
        })
    }

    /// Returns whether an edge is one half of a side of a facet in whose middle a corner lies, as where two chevrons part below a facet
    /// of the girdle: that corner is as far from both ends of the side and nearly meets neither.
    fn is_half_of_side(&self, edge: &CornerEdge, facet: usize) -> bool {
        let (around, [a, b]) = (&self.outlines[facet], edge.ends);
        let at = |corner: usize| self.all[corner].at;
        let goes_on = |from: usize, middle: usize| {
            let Some(place) = around.iter().position(|&corner| corner == middle) else { return false };
            let beside = [1, around.len() - 1].map(|step| around[(place + step) % around.len()]);
            let Some(&to) = beside.iter().find(|&&corner| corner != from) else { return false };
            let (before, after) = (at(middle) - at(from), at(to) - at(middle));
            let (short, long) = (before.length().min(after.length()), before.length().max(after.length()));
            before.dot(after) > GOES_ON * short * long && long <= AS_LONG * short
        };
        goes_on(a, b) || goes_on(b, a)
    }

    /// Returns whether one corner lies on the girdle's upper edge and the other on its lower one, so that their
    /// distance is the thickness of the girdle.
    fn is_across_girdle(&self, ends: [usize; 2], subject: &Subject) -> bool {
        let [a, b] = ends.map(|corner| &self.all[corner].facets);
        let touches = |facets: &[usize], zone| facets.iter().any(|&facet| subject.zones[facet] == zone);
        let only = |facets: &[usize], zone, other| touches(facets, zone) && !touches(facets, other);
        let (up, down) = (TierZone::Crown, TierZone::Pavilion);
        let shares = a.iter().any(|facet| subject.is_girdle(*facet) && b.contains(facet));
        shares && (only(a, up, down) && only(b, down, up) || only(a, down, up) && only(b, up, down))
    }
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// Returns whether two facets lean to the same azimuth. Tables and culets have no azimuth.
fn same_azimuth(subject: &Subject, a: usize, b: usize) -> bool {
    let level = |facet: usize| matches!(subject.zones[facet], TierZone::Table | TierZone::Culet);
    let across = |facet: usize| subject.facets()[facet].plane.normal.truncate();
    !level(a) && !level(b) && across(a).angle_to(across(b)).abs() < SAME_AZIMUTH
}
