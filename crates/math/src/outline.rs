//! Divides outlines into triangles between their own corners: convex or concave ones, in a plane or nearly so.

use super::{Basis, polygon};
use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::collections::{BTreeMap, HashMap};

/// Triangles cover an outline if their areas add up to its area within this part; a smaller difference is rounding.
const CLOSED: f64 = 1e-9;

/// Divides a polygon in space into triangles, which run as the polygon does; they are given by the places of their corners.
///
/// The polygon may be concave, have corners in one line or several at one place, and reach holes by a bridge that it
/// passes twice. A convex polygon becomes a fan around its first corner. So does an outline that crosses itself, or that
/// encloses nothing, because no triangles between its corners fit it.
pub fn polygon_triangles(corners: &[DVec3]) -> Vec<[usize; 3]> {
    if corners.len() <= 3 {
        return fan(corners.len());
    }
    let flat = flattened(corners).unwrap_or_default();
    if flat.is_empty() || is_around_first(&flat) {
        return fan(corners.len());
    }
    delaunay(&flat).unwrap_or_else(|| fan(corners.len()))
}

/// Returns the triangles between the first corner and each pair of further ones.
pub(super) fn fan(corners: usize) -> Vec<[usize; 3]> {
    (1..corners.max(1) - 1).map(|i| [0, i, i + 1]).collect()
}

/// Projects a polygon onto its own plane, in which it runs counter-clockwise and reaches about 1 from its first corner;
/// `None` where it has no plane.
fn flattened(corners: &[DVec3]) -> Option<Vec<DVec2>> {
    let from = |corner: &DVec3| *corner - corners[0];
    let size = corners.iter().map(|corner| from(corner).abs().max_element()).fold(0.0, f64::max);
    let scaled: Vec<DVec3> = corners.iter().map(|corner| from(corner) / size).collect();
    // The sum of the triangles of a fan is the area vector of the polygon, whatever its shape (Newell).
    let area: DVec3 = scaled.windows(2).map(|pair| pair[0].cross(pair[1])).sum();
    let frame = Basis::FACE_UP.aimed(area.try_normalize()?);
    Some(scaled.into_iter().map(|corner| frame.project(corner)).collect())
}

/// Returns whether the fan around the first corner covers the outline: each triangle runs counter-clockwise, and they do not
/// reach around that corner by more than half a turn.
fn is_around_first(flat: &[DVec2]) -> bool {
    let [first, start, ..] = flat else { return false };
    let start = *start - *first;
    flat[1..].windows(2).all(|pair| {
        let [a, b] = [pair[0] - *first, pair[1] - *first];
        a.perp_dot(b) > 0.0 && start.perp_dot(b) > 0.0
    })
}

/// Returns the Delaunay triangles inside a counter-clockwise outline; `None` where the outline crosses itself, or where
/// rounding keeps the triangles from covering it, which can happen with corners in one line.
pub(super) fn delaunay(flat: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let (first, number) = distinct(flat);
    let points: Vec<_> = first.iter().map(|&at| Point2::new(flat[at].x, flat[at].y)).collect();
    let (count, edges) = (points.len(), sides(&number));
    // Corners that coincide leave edges of zero length.
    let mut is_sound = true;
    let unfit = |_| is_sound = false;
    let cdt =
        ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(points, edges, unfit).ok()?;
    (is_sound && cdt.num_vertices() == count).then_some(())?;
    let inside = inner(&cdt);
    let triangles: Vec<[usize; 3]> = cdt
        .inner_faces()
        .filter(|face| inside[face.fix().index()])
        .map(|face| face.vertices().map(|v| first[v.index()]))
        .collect();
    covers(flat, &triangles).then_some(triangles)
}

/// Returns the first corner at each place, and for each corner the number of its place.
fn distinct(flat: &[DVec2]) -> (Vec<usize>, Vec<usize>) {
    let mut known = HashMap::new();
    let mut first = vec![];
    let place = |(at, corner): (usize, &DVec2)| {
        // Adding 0 turns -0 into 0, which compares equal to it.
        let key = (*corner + DVec2::ZERO).to_array().map(f64::to_bits);
        *known.entry(key).or_insert_with(|| {
            first.push(at);
            first.len() - 1
        })
    };
    let number = flat.iter().enumerate().map(place).collect();
    (first, number)
}

/// Returns the sides that part the inside from the outside: those that the outline passes an odd number of times. A bridge
/// to a hole is passed twice.
fn sides(number: &[usize]) -> Vec<[usize; 2]> {
    let next = number.iter().cycle().skip(1);
    let all = || number.iter().zip(next.clone()).map(|(&a, &b)| [a, b]).filter(|[a, b]| a != b);
    let key = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let mut passes = BTreeMap::<[usize; 2], usize>::new();
    all().for_each(|side| *passes.entry(key(side)).or_default() += 1);
    all().filter(|&side| passes.insert(key(side), 0).is_some_and(|count| count % 2 == 1)).collect()
}

/// Returns which faces lie inside the constraints: each constraint that is crossed leads in or out.
fn inner(cdt: &ConstrainedDelaunayTriangulation<Point2<f64>>) -> Vec<bool> {
    let mut parity = vec![None; cdt.num_all_faces()];
    let mut open = vec![];
    for edge in cdt.convex_hull() {
        for face in [edge.face(), edge.rev().face()].into_iter().filter_map(|face| face.as_inner()) {
            let own = &mut parity[face.fix().index()];
            if own.is_none() {
                *own = Some(edge.is_constraint_edge());
                open.push(face);
            }
        }
    }
    while let Some(face) = open.pop() {
        let own = parity[face.fix().index()] == Some(true);
        for edge in face.adjacent_edges() {
            let Some(next) = edge.rev().face().as_inner() else { continue };
            let other = &mut parity[next.fix().index()];
            if other.is_none() {
                *other = Some(own != edge.is_constraint_edge());
                open.push(next);
            }
        }
    }
    parity.into_iter().map(|parity| parity == Some(true)).collect()
}

fn covers(flat: &[DVec2], triangles: &[[usize; 3]]) -> bool {
    let whole = polygon::area(flat);
    let parts: f64 = triangles.iter().map(|t| polygon::area(&t.map(|i| flat[i]))).sum();
    whole > 0.0 && (whole - parts).abs() <= CLOSED * whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;
    use std::f64::consts::TAU;

    const SQUARE: [(f64, f64); 4] = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];

    /// Places an outline of a plane in space, in a way that has no round numbers.
    fn in_space(flat: &[(f64, f64)]) -> Vec<DVec3> {
        let turn = DQuat::from_rotation_x(0.7) * DQuat::from_rotation_z(0.3);
        flat.iter().map(|&(x, y)| turn * DVec3::new(x, y, 0.0) + DVec3::new(3.0, -5.0, 11.0)).collect()
    }

    /// Returns the area of all triangles, and the area of the polygon itself, both along its normal.
    fn areas(corners: &[DVec3]) -> (f64, f64) {
        let triangles = polygon_triangles(corners);
        let area = |[a, b, c]: [usize; 3]| (corners[b] - corners[a]).cross(corners[c] - corners[a]) / 2.0;
        let whole: DVec3 = fan(corners.len()).into_iter().map(area).sum();
        // The lengths of the parts add up to the whole only where none runs in the other sense.
        (triangles.into_iter().map(|t| area(t).length()).sum(), whole.length())
    }

    fn star(points: u32, inner: f64) -> Vec<(f64, f64)> {
        let at = |k: u32| {
            let (sin, cos) = (f64::from(k) * TAU / f64::from(2 * points)).sin_cos();
            let radius = if k.is_multiple_of(2) { 1.0 } else { inner };
            (radius * cos, radius * sin)
        };
        (0..2 * points).map(at).collect()
    }

    #[test]
    fn the_triangles_of_a_concave_polygon_lie_inside_it() {
        let comb: Vec<(f64, f64)> = (0..20)
            .flat_map(|k| [(f64::from(k), 0.0), (f64::from(k) + 0.5, 3.0)])
            .chain([(20.0, 0.0), (20.0, -1.0), (0.0, -1.0)])
            .rev()
            .collect();
        let spiral: Vec<(f64, f64)> = (1..40)
            .map(|k| (f64::from(k), 1.0))
            .chain((1..40).rev().map(|k| (f64::from(k), 0.8)))
            .map(|(k, part)| ((0.4 * k).cos() * k * part, (0.4 * k).sin() * k * part))
            .collect();
        let dented = [(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)];
        for flat in [comb, spiral, star(5, 0.35), star(64, 0.9), dented.to_vec()] {
            for start in [0, 1, 2, flat.len() / 2] {
                let mut turned = flat.clone();
                turned.rotate_left(start);
                for corners in [in_space(&turned), in_space(&turned).into_iter().rev().collect()] {
                    let (parts, whole) = areas(&corners);
                    assert!((parts / whole - 1.0).abs() < 1e-9, "{parts} {whole} {flat:?}");
                    assert_eq!(polygon_triangles(&corners).len(), corners.len() - 2);
                }
            }
        }
    }

    #[test]
    fn corners_in_one_line_or_at_one_place_and_bridges_to_holes_leave_the_area() {
        let with = |more: &[(usize, (f64, f64))]| {
            let mut flat = SQUARE.to_vec();
            more.iter().for_each(|&(at, corner)| flat.insert(at, corner));
            flat
        };
        let hole = with(&[
            (4, (0.0, 0.0)),
            (5, (1.0, 1.0)),
            (6, (1.0, 3.0)),
            (7, (3.0, 3.0)),
            (8, (3.0, 1.0)),
            (9, (1.0, 1.0)),
        ]);
        for (flat, area) in [
            (with(&[(1, (2.0, 0.0))]), 16.0),
            (with(&[(1, (1.0, 0.0)), (2, (2.0, 0.0)), (4, (4.0, 1.0))]), 16.0),
            (with(&[(1, (0.0, 0.0))]), 16.0),
            (with(&[(2, (4.0, 0.0)), (3, (4.0, 0.0)), (6, (0.0, 4.0))]), 16.0),
            // A spike that goes out and back encloses nothing.
            (with(&[(2, (7.0, 0.5)), (3, (4.0, 0.0))]), 16.0),
            (hole, 12.0),
        ] {
            let (parts, whole) = areas(&in_space(&flat));
            assert!((parts - area).abs() < 1e-9 && (whole - area).abs() < 1e-9, "{parts} {whole} {flat:?}");
        }
    }

    #[test]
    fn a_convex_polygon_is_a_fan_and_nothing_makes_it_panic() {
        assert_eq!(polygon_triangles(&in_space(&SQUARE)), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(polygon_triangles(&in_space(&SQUARE[..3])), [[0, 1, 2]]);
        for few in 0..3 {
            assert!(polygon_triangles(&in_space(&SQUARE[..few])).is_empty());
        }
        let crossed = [(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 3.0)];
        assert_eq!(polygon_triangles(&in_space(&crossed)).len(), 2);
        for odd in [f64::NAN, f64::INFINITY, 1e300, 0.0, 1e-300] {
            let corners: Vec<DVec3> =
                in_space(&star(5, 0.3)).into_iter().map(|corner| odd * corner).collect();
            assert!(!polygon_triangles(&corners).is_empty());
        }
    }

    #[test]
    fn corners_that_fall_together_are_no_reason_to_panic() {
        let square = SQUARE.map(DVec2::from);
        assert_eq!(delaunay(&square).map(|t| t.len()), Some(2));
        for twice in 0..4 {
            let mut corners = square.to_vec();
            corners.insert(twice, square[twice]);
            assert_eq!(delaunay(&corners).map(|t| t.len()), Some(2));
        }
        assert_eq!(delaunay(&[DVec2::ZERO; 4]), None);
    }
}
