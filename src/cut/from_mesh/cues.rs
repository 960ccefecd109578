//! What a person looks for in a solid to tell which way its table faces.

use crate::math::{Calipers, Polytope, area, hull};
use glam::{DVec2, DVec3};

/// A facet whose normal leans less than this from square to the axis (sine) stands upright: a sixth of a degree, more
/// than files' digits leave and less than any facet of a pavilion leans.
const UPRIGHT: f64 = 3e-3;

/// A facet whose normal is this near (cosine, a sixth of a degree) to a direction is square to it.
const SQUARE: f64 = 1.0 - UPRIGHT * UPRIGHT / 2.0;

/// Corners of a knife edge whose heights differ by less than this part of the width are level.
const LEVEL: f64 = 2e-3;

/// What a solid shows to one who takes a direction for up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cues {
    /// The direction, a unit vector.
    pub up: DVec3,
    /// The share of its outline, seen along the direction, that facets parallel to the direction make, or a level edge.
    pub girdle: f64,
    /// The facet that is square to the direction on top, if there is one.
    pub table: Option<usize>,
    /// The area of the table by that of the outline; 0 without one.
    pub table_area: f64,
    /// The area of the facet that is square to it below by that of the outline; 0 without one.
    pub culet_area: f64,
    /// From the outline to the highest point, by the whole height.
    pub crown: f64,
    /// The whole height by the width.
    pub height: f64,
    /// Length by width.
    pub length: f64,
}

/// A part of the outline: its length, and between which heights it lies.
struct Piece {
    length: f64,
    low: f64,
    high: f64,
}

impl Cues {
    /// What is seen of a solid by one who takes a unit vector for up; `None` where it has no outline.
    pub fn of(solid: &Polytope, up: DVec3) -> Option<Self> {
        let (right, back) = up.any_orthonormal_pair();
        let flat = |v: DVec3| DVec2::new(v.dot(right), v.dot(back));
        let outline = hull(solid.vertices().iter().map(|&v| flat(v)).collect());
        let around = outline.iter().zip(outline.iter().cycle().skip(1)).map(|(a, b)| a.distance(*b));
        let (perimeter, covered) = (around.sum::<f64>(), area(&outline));
        let Calipers { width, length, .. } = Calipers::of(&outline)?;
        let heights = || solid.vertices().iter().map(|v| v.dot(up));
        let (low, high) =
            heights().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
        let pieces = pieces(solid, up);
        let middle = |p: &Piece| (p.low + p.high) / 2.0;
        let whole: f64 = pieces.iter().map(|p| p.length).sum();
        let level = pieces.iter().map(|p| p.length * middle(p)).sum::<f64>() / whole.max(f64::MIN_POSITIVE);
        let square = |direction: DVec3| {
            let facets = solid.facets().iter().enumerate();
            let near = facets.filter(|(_, f)| f.plane.normal.dot(direction) >= SQUARE);
            near.max_by(|a, b| solid.facet_area(a.1).total_cmp(&solid.facet_area(b.1)))
                .map(|(place, _)| place)
        };
        let part =
            |facet: Option<usize>| facet.map_or(0.0, |f| solid.facet_area(&solid.facets()[f]) / covered);
        let table = square(up);
        Some(Self {
            up,
            girdle: (upright(solid, up) + level_edge(&pieces, LEVEL * width)) / perimeter,
            table,
            table_area: part(table),
            culet_area: part(square(-up)),
            crown: (high - level) / (high - low),
            height: (high - low) / width,
            length: length / width,
        })
    }
}

/// How much of the outline upright facets make.
fn upright(solid: &Polytope, up: DVec3) -> f64 {
    let facets = solid.facets().iter().filter(|f| f.plane.normal.dot(up).abs() < UPRIGHT);
    let across = facets.map(|facet| {
        let along = up.cross(facet.plane.normal);
        let reach = solid.corners(facet).map(|c| c.dot(along));
        let (low, high) = reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        high - low
    });
    across.sum()
}

/// The outline's parts: upright facets, and edges between what faces up and down.
fn pieces(solid: &Polytope, up: DVec3) -> Vec<Piece> {
    let lean = |facet: usize| solid.facets()[facet].plane.normal.dot(up);
    let mut pieces = vec![];
    for (place, facet) in solid.facets().iter().enumerate() {
        let corners: Vec<DVec3> = solid.corners(facet).collect();
        let between = |of: &[DVec3]| {
            let heights = of.iter().map(|c| c.dot(up));
            let (low, high) =
                heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
            let along = of.iter().flat_map(|a| of.iter().map(move |b| (*a - *b).reject_from_normalized(up)));
            Piece { length: along.map(DVec3::length).fold(0.0, f64::max), low, high }
        };
        if lean(place).abs() < UPRIGHT {
            pieces.push(between(&corners));
        } else if lean(place) > 0.0 {
            for (k, &other) in facet.neighbours.iter().enumerate() {
                if lean(other as usize) <= -UPRIGHT {
                    pieces.push(between(&[corners[k], corners[(k + 1) % corners.len()]]));
                }
            }
        }
    }
    pieces
}

/// How much of the outline lies in one plane square to the axis, where crown and pavilion meet in an edge. Upright facets
/// are none of it.
fn level_edge(pieces: &[Piece], within: f64) -> f64 {
    let flat = || pieces.iter().filter(|p| p.high - p.low <= within && p.length > 0.0);
    let at =
        |level: f64| -> f64 { flat().filter(|p| (p.low - level).abs() <= within).map(|p| p.length).sum() };
    flat().map(|p| at(p.low)).fold(0.0, f64::max)
}
