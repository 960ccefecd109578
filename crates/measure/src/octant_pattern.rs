//! A pattern of the image, cut into octants: convex pieces, the regions that they join to, and the difference of two
//! octants.

use super::facet_deviations::OCTANTS;
use brillianteer_math::{Affine, area, centroid, clip, span};
use brillianteer_trace::beam::Beams;
use glam::DVec2;
use std::f64::consts::{FRAC_PI_4, FRAC_PI_8};

/// Pieces smaller than this, squared girdle radii, arise from rounding where a piece touches the border of an octant.
const LEAST_AREA: f64 = 1e-14;

/// Points nearer to a line than this, girdle radii, lie on it: a thousand roundings of the corners of beams.
const ON_LINE: f64 = 1e-9;

/// Two pieces belong to one region if they share a border at least this long, girdle radii. Regions that meet in a point, as
/// shaft and head of an arrow do, stay apart, also where small pieces lie at the point.
const JOINED: f64 = 2e-2;

/// Areas that differ by less than this part are equal except for rounding.
const ALIKE: f64 = 1e-7;

/// The place of a stone's octants, seen along its axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct OctantFrame {
    /// The middle of the stone.
    pub middle: DVec2,
    /// The girdle radius.
    pub radius: f64,
    /// The azimuth of the first octant's axis, radians.
    pub azimuth: f64,
}

/// The kind of a cell of the map of strongest exits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CellKind {
    /// The cell is part of the pattern, and of this layer of it. Only pieces of one layer join.
    Lit { layer: u8 },
    /// The cell is no part of the pattern.
    Dark,
}

/// A convex piece of a pattern in the frame of its octant: x runs along the octant's axis, in girdle radii.
#[derive(Debug, Clone)]
pub(super) struct PatternPiece {
    corners: Vec<DVec2>,
    low: DVec2,
    high: DVec2,
    area: f64,
    layer: u8,
}

impl PatternPiece {
    fn new(corners: Vec<DVec2>, layer: u8) -> Self {
        let (low, high) = (corners.iter().fold(DVec2::INFINITY, |low, c| low.min(*c)), corners.iter());
        let high = high.fold(DVec2::NEG_INFINITY, |high, c| high.max(*c));
        Self { low, high, area: area(&corners), layer, corners }
    }

    fn is_near(&self, other: &Self, by: f64) -> bool {
        (self.low - by).cmple(other.high).all() && (other.low - by).cmple(self.high).all()
    }

    fn edges(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).map(|(&a, &b)| [a, b])
    }

    /// Returns the length of the border that two pieces share.
    fn shared_border(&self, other: &Self) -> f64 {
        self.edges().flat_map(|own| other.edges().map(move |theirs| shared(own, theirs))).sum()
    }

    /// Returns the part of the octant's axis that lies in the piece, with its border.
    fn on_axis(&self) -> Option<[f64; 2]> {
        let crossings =
            self.edges().filter_map(|[a, b]| match (a.y.abs() <= ON_LINE, b.y.abs() <= ON_LINE) {
                (true, _) => Some(a.x),
                (false, false) if (a.y < 0.0) != (b.y < 0.0) => Some(a.x + (b.x - a.x) * a.y / (a.y - b.y)),
                _ => None,
            });
        let (least, most) = span(crossings);
        (most - least > ON_LINE).then_some([least, most])
    }
}

/// Returns the length that two edges share.
fn shared([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> f64 {
    let along = (b - a).normalize_or_zero();
    let aside = |p: DVec2| along.perp_dot(p - a).abs();
    if along == DVec2::ZERO || aside(c) > ON_LINE || aside(d) > ON_LINE {
        return 0.0;
    }
    let [c, d] = [c, d].map(|p| along.dot(p - a));
    (c.max(d).min(a.distance(b)) - c.min(d).max(0.0)).max(0.0)
}

/// The part of a pattern that lies in one octant.
#[derive(Debug, Clone, Default)]
pub(super) struct OctantPattern {
    pieces: Vec<PatternPiece>,
    /// The area of all cells that are certainly part of the pattern, squared girdle radii.
    pub certain: f64,
    /// The area of all cells that may or may not be part of it, since unresolved light leaves that open.
    pub undecided: f64,
}

impl OctantPattern {
    /// Returns the parts of a pattern in all octants. `kind` is called with the ids of each cell's outline and
    /// strongest exit.
    pub fn of(beams: &Beams, frame: &OctantFrame, kind: impl Fn(u32, u32) -> CellKind) -> [Self; OCTANTS] {
        let mut octants: [Self; OCTANTS] = Default::default();
        let mut clipped = [vec![], vec![]];
        for cell in beams.strongest_exits() {
            let found = cell.strongest.map_or(CellKind::Dark, |exit| kind(cell.outline, exit));
            let is_undecided = cell.undecided || cell.strongest.is_none();
            if found == CellKind::Dark && !is_undecided {
                continue;
            }
            let outline = seen_along_axis(beams, cell.outline, frame);
            for (octant, part) in octants.iter_mut().enumerate() {
                let Some(corners) = in_octant(&outline, octant, &mut clipped) else { continue };
                let area = area(&corners);
                *(if is_undecided { &mut part.undecided } else { &mut part.certain }) += area;
                if let CellKind::Lit { layer } = found {
                    part.pieces.push(PatternPiece::new(corners, layer));
                }
            }
        }
        octants
    }

    /// Returns the area, in which undecided cells count by their strongest exit so far.
    pub fn area(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.area).sum()
    }

    /// Returns the area that only one of two octants has, after they are turned onto one another.
    pub fn difference(&self, other: &Self) -> f64 {
        let (mut clipped, mut both) = ([vec![], vec![]], 0.0);
        for own in &self.pieces {
            for theirs in other.pieces.iter().filter(|theirs| own.is_near(theirs, 0.0)) {
                both += common_area(&own.corners, &theirs.corners, &mut clipped);
            }
        }
        (self.area() + other.area() - 2.0 * both).max(0.0)
    }

    /// Returns the regions of one layer, the largest first. Where several are largest except for rounding, as mirror
    /// images are, the first is the one that lies farthest to the counter-clockwise side, so that equal octants name
    /// equal regions.
    pub fn regions(&self, layer: u8) -> Vec<Region<'_>> {
        let pieces: Vec<&PatternPiece> = self.pieces.iter().filter(|piece| piece.layer == layer).collect();
        let mut open: Vec<usize> = (0..pieces.len()).collect();
        let mut regions = vec![];
        while let Some(first) = open.pop() {
            let mut region = vec![first];
            let mut next = 0;
            while next < region.len() {
                let piece = pieces[region[next]];
                let touches = |&k: &usize| {
                    pieces[k].is_near(piece, ON_LINE) && pieces[k].shared_border(piece) >= JOINED
                };
                let (joined, apart) = open.into_iter().partition::<Vec<_>, _>(touches);
                region.extend(joined);
                open = apart;
                next += 1;
            }
            regions.push(Region { pieces: region.into_iter().map(|k| pieces[k]).collect() });
        }
        regions.sort_by(|a, b| b.area().total_cmp(&a.area()));
        let largest = regions.first().map_or(0.0, Region::area);
        let alike = regions.iter().take_while(|region| region.area() > (1.0 - ALIKE) * largest).count();
        regions[..alike].sort_by(|a, b| b.azimuth().total_cmp(&a.azimuth()));
        regions
    }
}

/// Pieces that share borders. Lengths are in girdle radii.
pub(super) struct Region<'a> {
    pieces: Vec<&'a PatternPiece>,
}

impl Region<'_> {
    /// Returns the area, squared girdle radii.
    pub fn area(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.area).sum()
    }

    /// Returns the azimuth of the centre of area from the octant's axis, radians.
    pub fn azimuth(&self) -> f64 {
        self.pieces.iter().map(|piece| centroid(&piece.corners) * piece.area).sum::<DVec2>().to_angle()
    }

    /// Returns the distance from the stone's axis to the nearest point.
    pub fn inner(&self) -> f64 {
        let edges = self.pieces.iter().flat_map(|piece| piece.edges());
        edges.map(|[a, b]| from_origin(a, b)).fold(f64::INFINITY, f64::min)
    }

    /// Returns the distance from the stone's axis to the farthest corner, of those to the left of the octant's axis (its
    /// counter-clockwise side), of those to the right, or of all.
    pub fn outer(&self, side: OctantSide) -> f64 {
        let corners = self.pieces.iter().flat_map(|piece| &piece.corners);
        let there = corners.filter(|corner| match side {
            OctantSide::Left => corner.y >= -ON_LINE,
            OctantSide::Right => corner.y <= ON_LINE,
            OctantSide::Both => true,
        });
        there.map(|corner| corner.length()).fold(0.0, f64::max)
    }

    /// Returns whether the centre of area lies nearer to the stone's axis than all of another region.
    pub fn is_below(&self, other: &Self) -> bool {
        let moment = self.pieces.iter().map(|piece| centroid(&piece.corners) * piece.area).sum::<DVec2>();
        moment.length() < other.inner() * self.area()
    }

    /// Returns the extent square to the octant's axis.
    pub fn width(&self) -> f64 {
        let (least, most) = span(self.pieces.iter().flat_map(|piece| [piece.low.y, piece.high.y]));
        most - least
    }

    /// Returns the outermost point on the octant's axis; `None` where the region does not reach the axis.
    pub fn outer_on_axis(&self) -> Option<f64> {
        self.pieces.iter().filter_map(|piece| piece.on_axis()).map(|[_, most]| most).reduce(f64::max)
    }
}

/// A side of an octant's axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OctantSide {
    Left,
    Right,
    Both,
}

/// Returns the distance from the origin to the edge from `a` to `b`.
fn from_origin(a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let part = (-a.dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (a + along * part).length()
}

/// Returns the outline of a beam as it lies in the frame of the stone seen from above, counter-clockwise, relative to the
/// middle, in girdle radii.
fn seen_along_axis(beams: &Beams, id: u32, frame: &OctantFrame) -> Vec<DVec2> {
    let beam = beams.get(id);
    let place = |corner: &DVec2| (beams.view.lift(*corner).truncate() - frame.middle) / frame.radius;
    let turn = |p: DVec2| DVec2::from_angle(-frame.azimuth).rotate(p);
    let mut corners: Vec<DVec2> = beam.outline.iter().map(place).map(turn).collect();
    if beams.view.toward.z < 0.0 {
        corners.reverse();
    }
    corners
}

/// Returns the part of an outline in an octant, turned so that the octant's axis is x; `None` where there is none.
fn in_octant(outline: &[DVec2], octant: usize, [first, second]: &mut [Vec<DVec2>; 2]) -> Option<Vec<DVec2>> {
    let turn = DVec2::from_angle(-FRAC_PI_4 * octant as f64);
    let turned: Vec<DVec2> = outline.iter().map(|&corner| turn.rotate(corner)).collect();
    let (sin, cos) = FRAC_PI_8.sin_cos();
    clip(&turned, Affine::new(0.0, DVec2::new(sin, cos)), first);
    clip(first, Affine::new(0.0, DVec2::new(sin, -cos)), second);
    (second.len() > 2 && area(second) > LEAST_AREA).then(|| second.clone())
}

/// Returns the area that two convex outlines have in common.
fn common_area(a: &[DVec2], b: &[DVec2], [part, rest]: &mut [Vec<DVec2>; 2]) -> f64 {
    part.clear();
    part.extend_from_slice(a);
    for (&from, &to) in b.iter().zip(b.iter().cycle().skip(1)) {
        let inward = (to - from).perp();
        clip(part, Affine::new(-inward.dot(from), inward), rest);
        std::mem::swap(part, rest);
        if part.len() < 3 {
            return 0.0;
        }
    }
    area(part)
}
