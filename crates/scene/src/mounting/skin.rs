//! Surfaces of rows of points, and the number of chords by which curves are divided.

use brillianteer_math::ShadedSurface;
use glam::{DVec2, DVec3};

/// The greatest distance of a chord from its curve, in mm: two of them are a tenth of a pixel of a picture that shows
/// a ring of 20 mm at 1024 pixels.
pub(super) const CHORD_MM: f64 = 0.002;

/// The cosine of the angle between triangles from which their edge is a crease: 40 degrees.
const CREASE: f64 = 0.766;

/// Returns the number of chords that an arc needs.
pub(super) fn chords(radius: f64, angle: f64) -> usize {
    let step = 2.0 * (1.0 - (CHORD_MM / radius.max(CHORD_MM)).min(1.0)).acos();
    (angle.abs() / step).ceil().max(2.0) as usize
}

/// Joins rows of points, each a closed line with as many points as the next, to a closed surface.
///
/// Each line runs counter-clockwise seen from the next row's side. Where the rows are `closed`, the last is joined to the
/// first; else the first and the last are covered.
pub(super) fn skin(rows: &[Vec<DVec3>], closed: bool) -> ShadedSurface {
    let across = rows.first().map_or(0, Vec::len);
    let mut points: Vec<DVec3> = rows.iter().flatten().copied().collect();
    let mut triangles = vec![];
    let at = |i: usize, j: usize| ((i % rows.len()) * across + j % across) as u32;
    for i in 0..rows.len() - usize::from(!closed) {
        for j in 0..across {
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    if !closed {
        for (row, is_last) in [(0, false), (rows.len() - 1, true)] {
            let middle = points.len() as u32;
            points.push(rows[row].iter().sum::<DVec3>() / across as f64);
            let side = |j| [at(row, j), at(row, j + 1)];
            let cover =
                (0..across).map(side).map(|[a, b]| if is_last { [a, b, middle] } else { [b, a, middle] });
            triangles.extend(cover);
        }
    }
    ShadedSurface::creased(&points, &triangles, CREASE)
}

/// Rounds the corners of a closed line, each by its radius, or by less where its edges are short.
pub(super) fn rounded(corners: &[(DVec2, f64)]) -> Vec<DVec2> {
    let count = corners.len();
    let mut line = vec![];
    for (k, &(corner, radius)) in corners.iter().enumerate() {
        let (before, after) =
            (corners[(k + count - 1) % count].0 - corner, corners[(k + 1) % count].0 - corner);
        let longest = 0.45 * before.length().min(after.length());
        let (back, on) = (before.normalize_or_zero(), after.normalize_or_zero());
        let half = 0.5 * back.angle_to(on).abs();
        let reach = (radius / half.tan()).min(longest);
        if radius <= 0.0 || !(0.01..1.56).contains(&half) {
            line.push(corner);
            continue;
        }
        let radius = reach * half.tan();
        let middle = corner + (back + on).normalize_or_zero() * (radius / half.sin());
        let (from, to) = (corner + back * reach - middle, corner + on * reach - middle);
        let turn = from.angle_to(to);
        let steps = chords(radius, turn).max(3);
        line.extend(
            (0..=steps).map(|k| middle + DVec2::from_angle(turn * k as f64 / steps as f64).rotate(from)),
        );
    }
    line
}
