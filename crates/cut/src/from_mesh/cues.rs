//! The properties of a solid, for a direction, by which the direction of its table is found.

use super::outline::LEAST_UPRIGHT;
use brillianteer_math::{Calipers, Facet, Polytope, area, hull, span};
use glam::{DVec2, DVec3};

/// A facet whose normal leans less than this from square to the axis (sine) stands upright: a sixth of a degree. Files'
/// digits leave less, and every facet of a pavilion leans more.
const UPRIGHT: f64 = 3e-3;

/// The number of noises by which the top of an upright facet may lie beside its bottom, and a level edge rise. Noise of a
/// thousandth of the stone leans the thin facets of a girdle by 2 degrees, and facets of a pavilion hardly.
const NOISY: f64 = 3.0;

/// The most lean (sine, 1.5 degrees) of a table or a culet that noise has split into several facets.
const SPLIT: f64 = 0.026;

/// Corners of a knife edge whose heights differ by less than this, in widths of the solid, are level.
const LEVEL: f64 = 2e-3;

/// The departures from a direction that facets and edges may have and still count as upright, square or level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slack {
    /// The distance by which noise moves corners, in the unit of the solid.
    noise: f64,
    /// A facet whose normal is this near to a direction (cosine) is square to the direction.
    square: f64,
}

impl Slack {
    /// The slack of a direction that is known exactly.
    pub const LEAST: Self = Self { noise: 0.0, square: 1.0 - UPRIGHT * UPRIGHT / 2.0 };

    /// Returns the slack of a solid whose corners noise has moved by up to this distance.
    pub fn of_noise(noise: f64) -> Self {
        Self { noise, square: 1.0 - SPLIT * SPLIT / 2.0 }
    }

    /// Returns whether a facet of this normal is square to a direction.
    pub fn is_square(self, normal: DVec3, direction: DVec3) -> bool {
        normal.dot(direction) >= self.square
    }

    /// Returns the mean normal, weighted by area, of the facets that are square to a direction; `None` without one.
    pub fn normal(self, solid: &Polytope, direction: DVec3) -> Option<DVec3> {
        let near = solid.facets().iter().filter(|facet| self.is_square(facet.plane.normal, direction));
        near.map(|facet| facet.plane.normal * solid.facet_area(facet)).sum::<DVec3>().try_normalize()
    }
}

/// The cues of a solid for a direction as up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cues {
    /// The direction, a unit vector.
    pub up: DVec3,
    /// The share of the solid's outline, seen along the direction, that is made by upright facets or by a level edge.
    pub girdle: f64,
    /// The place of the facet that is square to the direction on top, the largest where there are several.
    pub table: Option<usize>,
    /// The area of all facets square to the direction on top, divided by that of the outline; 0 without a table.
    pub table_area: f64,
    /// The area of all facets square to the direction at the bottom, divided by that of the outline; 0 without one.
    pub culet_area: f64,
    /// The height from the outline to the highest point, divided by the whole height.
    pub crown: f64,
    /// The whole height divided by the width.
    pub height: f64,
    /// The length divided by the width.
    pub length: f64,
    /// The noise divided by the width.
    pub noise: f64,
}

/// A part of the outline: an upright facet or an edge, with its length and the heights between which it lies.
struct Piece {
    is_upright: bool,
    length: f64,
    low: f64,
    high: f64,
}

impl Cues {
    /// Returns the cues of a solid for a unit vector as up; `None` where it has no outline.
    pub fn of(solid: &Polytope, up: DVec3, slack: Slack) -> Option<Self> {
        let (right, back) = up.any_orthonormal_pair();
        let flat = |v: DVec3| DVec2::new(v.dot(right), v.dot(back));
        let outline = hull(solid.vertices().iter().map(|&v| flat(v)).collect());
        let around = outline.iter().zip(outline.iter().cycle().skip(1)).map(|(a, b)| a.distance(*b));
        let (perimeter, covered) = (around.sum::<f64>(), area(&outline));
        let Calipers { width, length, .. } = Calipers::of(&outline)?;
        let (low, high) = span(solid.vertices().iter().map(|v| v.dot(up)));
        let pieces = pieces(solid, up, slack.noise);
        let middle = |p: &Piece| (p.low + p.high) / 2.0;
        let whole: f64 = pieces.iter().map(|p| p.length).sum();
        let upright: f64 = pieces.iter().filter(|p| p.is_upright).map(|p| p.length).sum();
        let level = pieces.iter().map(|p| p.length * middle(p)).sum::<f64>() / whole.max(f64::MIN_POSITIVE);
        let (table, top) = square(solid, up, slack);
        let (_, bottom) = square(solid, -up, slack);
        Some(Self {
            up,
            girdle: (upright + level_edge(&pieces, LEVEL * width + NOISY * slack.noise)) / perimeter,
            table,
            table_area: top / covered,
            culet_area: bottom / covered,
            crown: (high - level) / (high - low),
            height: (high - low) / width,
            length: length / width,
            noise: slack.noise / width,
        })
    }
}

/// The height, in widths, of the lowest stone without a table that hangs as a drop does.
const DROP: f64 = 1.6;

impl Cues {
    /// Returns whether the solid is tall and has neither a table nor a culet, as a briolette has none.
    pub fn is_drop(&self) -> bool {
        self.height > DROP && self.table_area + self.culet_area == 0.0
    }
}

/// Returns the largest facet that is square to a direction, if there is one, and the area of all that are.
fn square(solid: &Polytope, direction: DVec3, slack: Slack) -> (Option<usize>, f64) {
    let facets = solid.facets().iter().enumerate();
    let near = facets.filter(|(_, facet)| slack.is_square(facet.plane.normal, direction));
    let areas: Vec<(usize, f64)> = near.map(|(place, facet)| (place, solid.facet_area(facet))).collect();
    let largest = areas.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(place, _)| *place);
    (largest, areas.iter().map(|(_, area)| area).sum())
}

/// The direction in which a facet faces.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Facing {
    Up,
    Aside,
    Down,
}

impl Facing {
    /// Returns the direction in which a facet faces where noise moves corners by this distance.
    fn of(solid: &Polytope, facet: &Facet, up: DVec3, noise: f64) -> Self {
        let lean = facet.plane.normal.dot(up);
        let is_noise = || {
            let (low, high) = span(solid.corners(facet).map(|corner| corner.dot(up)));
            lean.abs() < LEAST_UPRIGHT && lean.abs() * (high - low) <= NOISY * noise
        };
        if lean.abs() < UPRIGHT || is_noise() {
            Self::Aside
        } else if lean > 0.0 {
            Self::Up
        } else {
            Self::Down
        }
    }
}

/// Returns the parts of the outline: upright facets, and edges between facets that face up and facets that face down.
fn pieces(solid: &Polytope, up: DVec3, noise: f64) -> Vec<Piece> {
    let facing: Vec<Facing> =
        solid.facets().iter().map(|facet| Facing::of(solid, facet, up, noise)).collect();
    let mut pieces = vec![];
    for (own, facet) in facing.iter().zip(solid.facets()) {
        if *own == Facing::Aside {
            let reach = |along: DVec3| span(solid.corners(facet).map(|corner| corner.dot(along)));
            let ((from, to), (low, high)) = (reach(up.cross(facet.plane.normal)), reach(up));
            pieces.push(Piece { is_upright: true, length: to - from, low, high });
        } else if *own == Facing::Up {
            let corners: Vec<DVec3> = solid.corners(facet).collect();
            for (k, &other) in facet.neighbours.iter().enumerate() {
                if facing[other as usize] == Facing::Down {
                    let [a, b] = [corners[k], corners[(k + 1) % corners.len()]];
                    let (low, high) = span([a.dot(up), b.dot(up)]);
                    let length = (a - b).reject_from_normalized(up).length();
                    pieces.push(Piece { is_upright: false, length, low, high });
                }
            }
        }
    }
    pieces
}

/// Returns the greatest total length of edges that lie in one plane square to the axis, where crown and pavilion meet in an
/// edge.
///
/// Edges that rise by more than `within` do not count.
fn level_edge(pieces: &[Piece], within: f64) -> f64 {
    let flat = pieces.iter().filter(|p| !p.is_upright && p.high - p.low <= within && p.length > 0.0);
    let mut flat: Vec<(f64, f64)> = flat.map(|p| (p.low, p.length)).collect();
    flat.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut below = vec![0.0];
    below.extend(flat.iter().scan(0.0, |sum, (_, length)| {
        *sum += length;
        Some(*sum)
    }));
    let at = |level: f64| {
        let first = flat.partition_point(|(low, _)| *low < level - within);
        let end = flat.partition_point(|(low, _)| *low <= level + within);
        below[end] - below[first]
    };
    flat.iter().map(|(low, _)| at(*low)).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_math::Plane;

    fn edge(low: f64, length: f64) -> Piece {
        Piece { is_upright: false, length, low, high: low + 0.01 }
    }

    #[test]
    fn a_level_edge_is_the_longest_of_pieces_at_one_height() {
        let mut pieces =
            vec![edge(0.5, 1.0), edge(0.0, 2.0), edge(0.05, 3.0), edge(0.12, 4.0), edge(-0.2, 5.0)];
        pieces.push(Piece { high: 9.0, ..edge(0.0, 100.0) });
        // 0 and 0.12 are too far apart, but both are near to 0.05.
        assert!((level_edge(&pieces, 0.1) - 9.0).abs() < 1e-12);
        assert!((level_edge(&pieces, 0.06) - 5.0).abs() < 1e-12);
        assert_eq!(level_edge(&[], 0.1), 0.0);
    }

    #[test]
    fn a_low_girdle_counts_once() {
        let sides = [DVec3::X, DVec3::Y].into_iter().flat_map(|n| [Plane::new(n, 1.0), Plane::new(-n, 1.0)]);
        let ends = [Plane::new(DVec3::Z, 5e-4), Plane::new(DVec3::NEG_Z, 5e-4)];
        let slab = Polytope::from_planes(&sides.chain(ends).collect::<Vec<_>>()).unwrap();
        let cues = Cues::of(&slab, DVec3::Z, Slack::LEAST).unwrap();
        assert!((cues.girdle - 1.0).abs() < 1e-12, "{cues:?}");
    }

    #[test]
    fn many_edges_of_a_ring_are_summed_without_comparing_all_with_all() {
        let pieces: Vec<Piece> = (0..300_000).map(|k| edge(f64::from(k % 1000), 1.0)).collect();
        let began = std::time::Instant::now();
        assert!((level_edge(&pieces, 0.1) - 300.0).abs() < 1e-6);
        // Comparing all with all would take minutes.
        assert!(began.elapsed().as_secs() < 300);
    }
}
