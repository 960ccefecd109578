//! The convex outline of points in the plane, and its width and length between pairs of parallel lines.

use super::{polygon, span};
use glam::DVec2;
use std::cmp::Ordering;

/// Widths or lengths count as equal if their ratio differs from 1 by less than this: a hundred roundings of f32.
const EQUAL: f64 = 1e-5;

/// A corner that lies off the line between its neighbours by less than this many extents of the outline is none: facets that end
/// within a side of the girdle have corners there, which rounding puts inside of the outline or outside.
const IN_LINE: f64 = 1e-9;

/// Directions are almost equally narrow if their widths differ by less than this part. The noise of a scan makes one
/// of them the narrowest, and that must not decide how long a stone is.
const ALMOST: f64 = 5e-3;

/// An outline has no mirror line if its mirror image reaches beyond it by more than this many widths. Designs are
/// rounded more finely, and noise of 0.3 % of the radius moves corners by less.
const MIRRORED: f64 = 1e-2;

/// An outline with a mirror line may have others that noise has spoilt, which its mirror image reaches beyond by no more
/// than this many widths.
const ALMOST_MIRRORED: f64 = 3e-2;

/// Of two mirror lines, the one that gives the greater width counts if it is the truer one by this part of the
/// difference of the widths.
const TRUER: f64 = 0.5;

/// Two principal moments of an outline set a direction if they differ by at least this part of their sum. It is the
/// difference of an ellipse whose length is 1.01 widths.
const LONG: f64 = 0.01;

/// A side shorter than this many widths may be a corner that was cut off, or a piece of a curve: one of a circle is 0.14
/// widths long until it leans by [`LEANS`].
const LEAST_SIDE: f64 = 0.3;

/// A side leans from a rectangle by no more than this many widths: the noise of a scan.
const LEANS: f64 = 5e-3;

/// Returns the convex hull of points, counter-clockwise (Andrew's monotone chain).
pub fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = vec![];
        for p in points {
            while let [.., a, b] = chain[..] {
                if (b - a).perp_dot(p - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = half(&mut points.iter().copied());
    lower.extend(half(&mut points.iter().rev().copied()));
    lower
}

/// The width and the length of a convex outline, which do not depend on the rotation of the outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Calipers {
    /// The distance between two parallel lines that hold the outline: the least, except in [`Calipers::of_stone`].
    pub width: f64,
    /// The distance between the two lines that hold the outline and are perpendicular to the lines of the width.
    /// Where several directions are equally narrow, it is the greatest of their lengths.
    pub length: f64,
    /// The unit vector from one line of the width to the other, with x > 0, or x = 0 and y = 1.
    ///
    /// Where several directions are equally narrow and equally long, it is the direction nearest to +x.
    pub across: DVec2,
    /// The centroid of the outline's area.
    ///
    /// It moves no more than the corners do and turns with them, so that a stone has the same middle after rounding.
    /// The middle of a rectangle around the outline would jump where two directions are almost equally narrow.
    pub middle: DVec2,
}

impl Calipers {
    /// Measures a convex outline with counter-clockwise corners, as [`hull`] returns it; `None` where it has no area.
    pub fn of(outline: &[DVec2]) -> Option<Self> {
        let all = Self::square_to_sides(&true_corners(outline));
        let width = all.iter().map(|found| found.width).fold(f64::INFINITY, f64::min);
        if !(width > 0.0 && width.is_finite()) {
            return None;
        }
        let narrow = || all.iter().filter(|found| found.width <= width * (1.0 + EQUAL));
        let length = narrow().map(|found| found.length).fold(0.0, f64::max);
        let long = narrow().filter(|found| found.length >= length * (1.0 - EQUAL));
        Some(Self { width, length, ..*long.max_by(Self::nearer_to_x)? })
    }

    /// Measures a convex outline as people measure a stone: along its mirror line and perpendicular to it, or else in
    /// its narrowest direction.
    ///
    /// The outline is measured along its mirror line if it is mirror symmetric to within 1 % of its width, even where its
    /// narrowest direction is oblique to the mirror line. An example is a kite, which is narrowest perpendicular to a
    /// side. `width` is then the smaller of the two extents. An outline that has a side on each side of its narrowest
    /// rectangle keeps that rectangle; an example is a square without one corner. The mirror line is one of the principal
    /// axes of the area, where these have definite directions.
    ///
    /// Without a mirror line, of directions that are almost equally narrow, to within 0.5 %, the one that is long as well
    /// is taken: that of the least square of the width divided by the length. So noise of 0.3 % changes width and length
    /// by little more.
    pub fn of_stone(outline: &[DVec2]) -> Option<Self> {
        let outline = &true_corners(outline);
        let least = Self::narrow_and_long(outline)?;
        if fills_its_sides(outline, &least) {
            return Some(least);
        }
        Some(Self::in_mirror(outline, least.middle, least.width).unwrap_or(least))
    }

    /// Measures an outline perpendicular to each of its sides.
    fn square_to_sides(outline: &[DVec2]) -> Vec<Self> {
        let middle = polygon::centroid(outline);
        let sides = outline.iter().zip(outline.iter().cycle().skip(1));
        let across = sides.filter_map(|(&a, &b)| Some(rightward((b - a).perp().try_normalize()?)));
        let measured = |across: DVec2| Self {
            width: length(extent(outline, across)),
            length: length(extent(outline, across.perp())),
            across,
            middle,
        };
        across.map(measured).collect()
    }

    /// Sorts equal directions by their coordinates, so that a choice among them does not depend on the order of the
    /// corners.
    fn nearer_to_x(&&a: &&Self, &&b: &&Self) -> Ordering {
        a.across.x.total_cmp(&b.across.x).then(a.across.y.total_cmp(&b.across.y))
    }

    /// Measures an outline in that of its almost narrowest directions that is long as well.
    fn narrow_and_long(outline: &[DVec2]) -> Option<Self> {
        let width = Self::of(outline)?.width;
        let mut narrow = Self::square_to_sides(outline);
        narrow.retain(|found| found.width <= width * (1.0 + ALMOST));
        let cost = |found: &Self| found.width.powi(2) / found.length;
        let least = narrow.iter().map(cost).fold(f64::INFINITY, f64::min);
        let equal = || narrow.iter().filter(|found| cost(found) <= least * (1.0 + EQUAL));
        let width = equal().map(|found| found.width).fold(f64::INFINITY, f64::min);
        let length = equal().map(|found| found.length).fold(0.0, f64::max);
        Some(Self { width, length, ..*equal().max_by(Self::nearer_to_x)? })
    }

    /// Measures an outline of the least width `least` along its mirror line and perpendicular to it; `None` where it has
    /// no mirror line.
    fn in_mirror(outline: &[DVec2], middle: DVec2, least: f64) -> Option<Self> {
        let axes = match principal_axis(outline, middle) {
            Some(axis) => vec![axis],
            None => sides_and_corners(outline, middle),
        };
        let support = Support::of(outline, middle);
        let unlike = |axis: DVec2| support.unlike(axis).min(support.unlike(axis.perp()));
        let mut mirrors: Vec<(DVec2, f64)> = axes.into_iter().map(|axis| (axis, unlike(axis))).collect();
        if !mirrors.iter().any(|(_, unlike)| *unlike <= MIRRORED * least) {
            return None;
        }
        mirrors.retain(|(_, unlike)| *unlike <= ALMOST_MIRRORED * least);
        let measured = mirrors.into_iter().map(|(axis, unlike)| {
            let [one, other] =
                [axis, axis.perp()].map(|along| (length(extent(outline, along)), rightward(along)));
            let (narrow, wide) = if one.0 <= other.0 { (one, other) } else { (other, one) };
            (Self { width: narrow.0, length: wide.0, across: narrow.1, middle }, unlike)
        });
        // Of several mirror lines, such as those of a triangle or a square, the one that gives the least width counts.
        let measured: Vec<(Self, f64)> =
            measured.map(|(found, unlike)| (found, TRUER * found.width + unlike)).collect();
        let lowest = measured.iter().map(|(_, cost)| *cost).fold(f64::INFINITY, f64::min);
        let equal =
            || measured.iter().filter(|(_, cost)| *cost <= lowest + EQUAL * least).map(|(found, _)| found);
        // Equally good lines may give different widths and lengths, and a turn of the outline must not choose among these.
        let width = equal().map(|found| found.width).fold(f64::INFINITY, f64::min);
        let narrow = || equal().filter(|found| found.width <= width + EQUAL * least);
        let length = narrow().map(|found| found.length).fold(0.0, f64::max);
        let long = narrow().filter(|found| found.length >= length - EQUAL * least);
        Some(Self { width, length, ..*long.max_by(Self::nearer_to_x)? })
    }
}

/// Returns an outline without corners that are due to rounding alone.
fn true_corners(outline: &[DVec2]) -> Vec<DVec2> {
    let [x, y] = [DVec2::X, DVec2::Y].map(|along| length(extent(outline, along)));
    let near = IN_LINE * x.max(y);
    let middle = outline.iter().sum::<DVec2>() / outline.len().max(1) as f64;
    let away = |k: &usize| outline[*k].distance_squared(middle);
    // The farthest corner is a true one.
    let first = (0..outline.len()).max_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0);
    let from_first = || outline.iter().copied().cycle().skip(first);
    let mut kept: Vec<DVec2> = vec![];
    for (p, next) in from_first().zip(from_first().skip(1)).take(outline.len()) {
        let off = |from: &DVec2| match (next - from).try_normalize() {
            Some(along) => along.perp_dot(p - from).abs(),
            None => p.distance(*from),
        };
        if kept.last().is_none_or(|before| off(before) > near) {
            kept.push(p);
        }
    }
    kept
}

/// Returns whether an outline has a side on each side of its narrowest rectangle.
fn fills_its_sides(outline: &[DVec2], &Calipers { across, width, .. }: &Calipers) -> bool {
    [across, -across, across.perp(), -across.perp()].iter().all(|out| {
        let (_, most) = extent(outline, *out);
        let on_it = outline.iter().filter(|p| p.dot(*out) >= most - LEANS * width);
        length(span(on_it.map(|p| p.dot(out.perp())))) > LEAST_SIDE * width
    })
}

/// Returns the direction in which the area of an outline extends farthest from its middle; `None` where the area has
/// no such direction.
fn principal_axis(outline: &[DVec2], middle: DVec2) -> Option<DVec2> {
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (&a, &b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
        let (a, b) = (a - middle, b - middle);
        // Twelve times the second moments of the triangle between the middle and this side, weighted by twice its
        // area.
        let (twice, c) = (a.perp_dot(b), a + b);
        xx += twice * (a.x * a.x + b.x * b.x + c.x * c.x);
        xy += twice * (a.x * a.y + b.x * b.y + c.x * c.y);
        yy += twice * (a.y * a.y + b.y * b.y + c.y * c.y);
    }
    let across = DVec2::new(xx - yy, 2.0 * xy);
    (across.length() > LONG * (xx + yy)).then(|| DVec2::from_angle(0.5 * across.to_angle()))
}

/// Returns the directions from the middle of an outline to its corners and to the middles of its sides; every mirror
/// line has one of them. The list is empty for a circle, which has mirror lines everywhere and is as wide as it is
/// long.
fn sides_and_corners(outline: &[DVec2], middle: DVec2) -> Vec<DVec2> {
    let sides = outline.iter().zip(outline.iter().cycle().skip(1));
    let from_middle = |p: DVec2| p - middle;
    let marks: Vec<DVec2> = sides.flat_map(|(&a, &b)| [a, (a + b) / 2.0]).map(from_middle).collect();
    let (nearest, farthest) = span(marks.iter().map(|mark| mark.length()));
    if nearest > (1.0 - LONG) * farthest {
        return vec![];
    }
    marks.into_iter().filter_map(DVec2::try_normalize).collect()
}

/// The lines that hold a convex outline, by their directions, seen from its middle.
struct Support {
    /// The sides by azimuth: the azimuth of the normal, the normal, and the corner at the side's end.
    sides: Vec<(f64, DVec2, DVec2)>,
}

impl Support {
    /// Lists the sides of an outline with counter-clockwise corners.
    fn of(outline: &[DVec2], middle: DVec2) -> Self {
        let ends = outline.iter().zip(outline.iter().cycle().skip(1));
        let side = |(&a, &b): (&DVec2, &DVec2)| {
            let normal = -(b - a).perp().try_normalize()?;
            Some((normal.to_angle(), normal, b - middle))
        };
        let mut sides: Vec<_> = ends.filter_map(side).collect();
        sides.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { sides }
    }

    /// Returns the distance from the middle to the line that holds the outline in a direction; 0 without sides.
    fn at(&self, direction: DVec2) -> f64 {
        let azimuth = direction.to_angle();
        let place = self.sides.partition_point(|(side, ..)| *side <= azimuth);
        // Before the first side lies the end of the last.
        let side = place.checked_sub(1).map_or(self.sides.last(), |before| self.sides.get(before));
        side.map_or(0.0, |(.., corner)| corner.dot(direction))
    }

    /// Returns the distance by which the mirror image of the outline, in the line through its middle with this normal,
    /// reaches beyond the outline.
    fn unlike(&self, normal: DVec2) -> f64 {
        let beyond = |(_, side, corner): &(f64, DVec2, DVec2)| {
            self.at(*side - 2.0 * side.dot(normal) * normal) - side.dot(*corner)
        };
        self.sides.iter().map(beyond).fold(0.0, f64::max)
    }
}

/// Returns a direction or its opposite, whichever has x > 0, or x = 0 and y > 0.
fn rightward(direction: DVec2) -> DVec2 {
    // Rounding must not decide the sense of an upright direction.
    let x = if direction.x.abs() < f64::EPSILON { 0.0 } else { direction.x };
    if x < 0.0 || (x == 0.0 && direction.y < 0.0) { -direction } else { DVec2::new(x, direction.y) }
}

fn extent(outline: &[DVec2], along: DVec2) -> (f64, f64) {
    span(outline.iter().map(|p| p.dot(along)))
}

fn length((low, high): (f64, f64)) -> f64 {
    high - low
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, TAU};

    fn turned(points: &[[f64; 2]], angle: f64) -> Vec<DVec2> {
        hull(
            points
                .iter()
                .map(|p| DVec2::from_angle(angle).rotate(DVec2::from(*p)) + DVec2::new(3.0, -2.0))
                .collect(),
        )
    }

    #[test]
    fn a_hull_keeps_the_corners_alone() {
        let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.5], [0.0, 1.0], [0.0, 0.0]];
        let hull = hull(points.map(DVec2::from_array).to_vec());
        assert_eq!(hull, [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]].map(DVec2::from_array));
    }

    #[test]
    fn width_and_length_are_the_same_however_an_outline_is_turned() {
        // A rectangle, a kite that is narrowest square to a side, and a regular pentagon.
        let pentagon: Vec<[f64; 2]> =
            (0..5).map(|k| DVec2::from_angle(TAU * f64::from(k) / 5.0).to_array()).collect();
        let side = 36f64.to_radians();
        let shapes: [(&[[f64; 2]], f64, f64); 3] = [
            (&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]], 1.0, 3.0),
            (&[[0.0, 0.0], [4.0, -3.0], [4.0, 0.0], [0.0, 3.0]], 3.0 * 0.8, 0.0),
            (&pentagon, 1.0 + side.cos(), 2.0 * 72f64.to_radians().sin()),
        ];
        for (shape, width, length) in shapes {
            let plain = Calipers::of(&turned(shape, 0.0)).unwrap();
            assert!((plain.width - width).abs() < 1e-12, "{plain:?}");
            assert!(length == 0.0 || (plain.length - length).abs() < 1e-12, "{plain:?}");
            for step in 1..50 {
                let again = Calipers::of(&turned(shape, 0.37 * f64::from(step))).unwrap();
                let off = (again.width - plain.width).abs().max((again.length - plain.length).abs());
                assert!(off < 1e-12, "{step}: {again:?} {plain:?}");
                assert!(again.across.x >= 0.0);
            }
        }
    }

    #[test]
    fn a_mirror_image_is_measured_along_its_mirror_line_however_it_is_turned() {
        let kite = [[1.0, 0.5], [0.0, 1.5], [-1.0, 0.5], [0.0, -1.5]];
        let lozenge = [[1.0, 0.0], [0.0, 1.3], [-1.0, 0.0], [0.0, -1.3]];
        let taper = [[1.0, 1.5], [-1.0, 1.5], [-0.5, -1.5], [0.5, -1.5]];
        // Its area extends as far in all directions, so that its axes are not set.
        let even = [[1.0, 0.4], [0.0, 0.97], [-1.0, 0.4], [0.0, -0.97]];
        for (shape, width, length) in
            [(kite, 2.0, 3.0), (lozenge, 2.0, 2.6), (taper, 2.0, 3.0), (even, 1.94, 2.0)]
        {
            for step in 0..50 {
                let angle = 0.37 * f64::from(step);
                let outline = turned(&shape, angle);
                let (least, found) = (Calipers::of(&outline).unwrap(), Calipers::of_stone(&outline).unwrap());
                assert!((found.width - width).abs().max((found.length - length).abs()) < 1e-12, "{found:?}");
                let along =
                    [0.0, FRAC_PI_2].map(|by| found.across.perp_dot(DVec2::from_angle(angle + by)).abs());
                assert!(along[0].min(along[1]) < 1e-12, "{found:?}");
                assert!(least.width < 0.99 * width, "the outline is narrower square to a side: {least:?}");
                // A corner out of its place leaves no mirror line.
                let mut uneven = shape;
                uneven[0][1] += 0.15;
                let uneven = turned(&uneven, angle);
                assert_eq!(Calipers::of_stone(&uneven), Calipers::of(&uneven));
            }
        }
    }

    #[test]
    fn what_is_narrowest_along_or_across_its_mirror_line_or_has_none_is_measured_as_by_calipers() {
        let ring = |n: i32, long: f64| -> Vec<[f64; 2]> {
            let corner =
                |k: i32| DVec2::from_angle(TAU * f64::from(k) / f64::from(n)) * DVec2::new(1.0, long);
            (0..n).map(|k| corner(k).to_array()).collect()
        };
        let shapes = [
            ring(3, 1.0),
            ring(4, 1.0),
            ring(5, 1.0),
            ring(8, 1.0),
            ring(16, 1.0),
            vec![[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]],
            vec![[0.0, 0.0], [3.0, 0.0], [3.5, 1.0], [0.5, 1.0]],
            vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 2.0], [0.0, 2.0]],
            vec![[0.0, 0.0], [2.0, 0.1], [1.7, 1.4], [0.3, 1.1]],
        ];
        for (index, shape) in shapes.iter().enumerate() {
            for step in 0..20 {
                let outline = turned(shape, 0.37 * f64::from(step));
                let [a, b] = [Calipers::of_stone(&outline), Calipers::of(&outline)].map(Option::unwrap);
                let off = (a.width - b.width).abs().max((a.length - b.length).abs());
                assert!(off < 1e-12, "shape {index}: {a:?} {b:?}");
            }
        }
    }

    /// Noise of 0.2 % on every corner chooses another direction each time, which must not show in the width or the length.
    #[test]
    fn noise_changes_width_and_length_by_little_more_than_itself() {
        let ring = |n: i32, first: f64, long: f64| -> Vec<[f64; 2]> {
            let corner = |k: i32| DVec2::from_angle(first + TAU * f64::from(k) / f64::from(n));
            (0..n).map(|k| (corner(k) * DVec2::new(1.0, long)).to_array()).collect()
        };
        let cut_off = |reach: f64| -> Vec<[f64; 2]> {
            let corner = [[1.0, reach], [reach, 1.0], [-reach, 1.0], [-1.0, reach]];
            corner.into_iter().chain(corner.map(|[x, y]| [-x, -y])).collect()
        };
        let shapes = [
            ring(4, 0.5, 1.0),
            ring(4, 0.0, 1.3),
            ring(3, 0.2, 1.0),
            ring(5, 0.0, 1.0),
            ring(6, 0.0, 1.0),
            ring(8, 0.1, 1.0),
            ring(32, 0.0, 1.4),
            ring(96, 0.0, 1.0),
            cut_off(0.99),
            cut_off(0.7),
            vec![[1.0, 0.5], [0.0, 1.5], [-1.0, 0.5], [0.0, -1.5]],
            vec![[1.0, 0.4], [0.0, 0.97], [-1.0, 0.4], [0.0, -0.97]],
            vec![[1.0, 1.5], [-1.0, 1.5], [-0.5, -1.5], [0.5, -1.5]],
            vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 2.0], [0.0, 2.0]],
        ];
        let mut next = crate::solids::noise(7);
        for (index, shape) in shapes.iter().enumerate() {
            let plain = Calipers::of_stone(&turned(shape, 0.0)).unwrap();
            for step in 0..40 {
                let shaken: Vec<[f64; 2]> =
                    shape.iter().map(|[x, y]| [x + 2e-3 * next(), y + 2e-3 * next()]).collect();
                let found = Calipers::of_stone(&turned(&shaken, 0.37 * f64::from(step))).unwrap();
                let off = (found.width - plain.width).abs().max((found.length - plain.length).abs());
                assert!(off < 1e-2, "shape {index}: {found:?} {plain:?}");
            }
        }
    }

    /// The outline of an oval that is narrower in an oblique direction than across its mirror line.
    #[test]
    fn a_corner_within_a_side_changes_no_width() {
        let quarter = [
            (1.0016, 0.0209),
            (0.9795, 0.2955),
            (0.8319, 0.7797),
            (0.6006, 1.1193),
            (0.3025, 1.3326),
            (0.0693, 1.3983),
        ];
        let mirrored = |[x, y]: [f64; 2]| quarter.map(|(a, b)| DVec2::new(x * a, y * b));
        let outline: Vec<DVec2> =
            [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].into_iter().flat_map(mirrored).collect();
        let of = |more: &[DVec2]| Calipers::of_stone(&hull([&outline, more].concat())).unwrap();
        let plain = of(&[]);
        assert!((plain.width - 2.0032).abs() < 1e-12, "{plain:?}");
        let ends =
            [1.0, -1.0].map(|y| [-0.035, 0.035].map(|x| DVec2::new(x, y * 1.3983 * (1.0 + f64::EPSILON))));
        for within in [&ends[0][..], &ends[1], &ends.concat()] {
            let found = of(within);
            let off = (found.width - plain.width).abs().max((found.length - plain.length).abs());
            assert!(off < 1e-12, "{found:?} {plain:?}");
        }
    }

    /// Of mirror lines that noise has spoilt by equal amounts, a turn must not choose one of another width. About one polygon in
    /// a hundred has such lines.
    #[test]
    fn an_outline_with_noise_has_one_width_however_it_is_turned() {
        let mut next = crate::solids::noise(3);
        for trial in 0..4000 {
            let sides = 3 + trial % 6;
            let corner = |k: i32| DVec2::from_angle(TAU * f64::from(k) / f64::from(sides));
            let shaken: Vec<[f64; 2]> =
                (0..sides).map(|k| (corner(k) + 1e-3 * DVec2::new(next(), next())).to_array()).collect();
            let plain = Calipers::of_stone(&turned(&shaken, 0.0)).unwrap();
            for step in 1..6 {
                let again = Calipers::of_stone(&turned(&shaken, 1.37 * f64::from(step))).unwrap();
                let off = (again.width - plain.width).abs().max((again.length - plain.length).abs());
                assert!(off < 1e-4, "trial {trial}: {again:?} {plain:?}");
            }
        }
    }

    #[test]
    fn the_middle_turns_with_the_outline_and_hardly_moves_when_its_corners_hardly_do() {
        // An uneven outline, and one of three turns, whose middle is their axis.
        let uneven = [[0.0, 0.0], [2.0, 0.1], [1.7, 1.4], [0.3, 1.1]];
        let triangle = [0.0, 1.0, 2.0].map(|k| DVec2::from_angle(TAU * k / 3.0).to_array());
        let middle = |points: &[[f64; 2]], angle| Calipers::of(&turned(points, angle)).unwrap().middle;
        let shift = DVec2::new(3.0, -2.0);
        assert!((middle(&triangle, 0.3) - shift).length() < 1e-12);
        let plain = middle(&uneven, 0.0) - shift;
        for step in 1..20 {
            let angle = 0.37 * f64::from(step);
            let expected = DVec2::from_angle(angle).rotate(plain);
            assert!((middle(&uneven, angle) - shift - expected).length() < 1e-12, "{step}");
        }
        let mut moved = uneven;
        moved[2][0] += 1e-6;
        let by = (middle(&moved, 0.0) - shift - plain).length();
        assert!(by > 1e-8 && by < 1e-6, "{by}");
    }

    #[test]
    fn what_has_no_area_has_no_width() {
        for none in [vec![], vec![DVec2::ONE], vec![DVec2::ZERO, DVec2::ONE]] {
            assert_eq!(Calipers::of(&hull(none)), None);
        }
    }
}
