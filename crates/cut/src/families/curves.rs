//! The convex curves of outlines, as places along the curves. Lengths are in girdle radii.

use super::girdle::GirdlePlace;
use glam::DVec2;

/// Returns the place at a part of the way around an outline that is symmetric about both axes, from +x. `quarter`
/// returns the place at a part of the way from +x to +y.
pub fn around(way: f64, quarter: impl Fn(f64) -> GirdlePlace) -> GirdlePlace {
    let (number, part) = ((4.0 * way).floor(), (4.0 * way).fract());
    let flipped =
        |place: GirdlePlace, by: DVec2| GirdlePlace { at: place.at * by, normal: place.normal * by, ..place };
    match number as i64 % 4 {
        0 => quarter(part),
        1 => flipped(quarter(1.0 - part), DVec2::new(-1.0, 1.0)),
        2 => flipped(quarter(part), DVec2::NEG_ONE),
        _ => flipped(quarter(1.0 - part), DVec2::new(1.0, -1.0)),
    }
}

/// A curve from (1, 0), where it runs along y, to a point at (0, `length`): the side of a marquise or a pear.
pub struct Wing {
    length: f64,
    /// The height at which the tangents of both ends meet.
    tangents_meet: f64,
}

impl Wing {
    /// Makes the curve whose end tangents meet `fullness` times as high as those of an arc of a circle. It is an arc
    /// at 1; `None` where it would not be convex.
    pub fn new(length: f64, fullness: f64) -> Option<Self> {
        let tangents_meet = fullness * (length * length + 1.0) / (2.0 * length);
        (tangents_meet > 0.0 && tangents_meet < length).then_some(Self { length, tangents_meet })
    }

    /// Returns the place at a part of the way from the side to the point. At the point, the normal is +y.
    ///
    /// The curve is a conic section, written as a rational Bézier curve of degree 2 (Farin, Curves and Surfaces for CAGD); the
    /// weight of its middle point is the cosine of half the angle by which it turns, as for an arc.
    pub fn at(&self, part: f64) -> GirdlePlace {
        let middle = DVec2::new(1.0, self.tangents_meet);
        let (start, end) = (DVec2::X, DVec2::Y * self.length);
        let turn = DVec2::Y.angle_to(end - middle);
        let weight = (0.5 * turn).cos();
        let (back, on) = (1.0 - part, part);
        let sum = back * back + 2.0 * back * on * weight + on * on;
        let at = (start * (back * back) + middle * (2.0 * back * on * weight) + end * (on * on)) / sum;
        let along = (middle - start) * (weight * back * back)
            + (end - start) * (back * on)
            + (end - middle) * (weight * on * on);
        let is_corner = part == 1.0;
        let normal = if is_corner { DVec2::Y } else { -along.perp().normalize_or(DVec2::NEG_X) };
        GirdlePlace { at, normal, is_corner }
    }
}

/// An arc of a circle.
#[derive(Debug, Clone, Copy)]
struct Arc {
    centre: DVec2,
    radius: f64,
    /// The angle of the normal from +x at the first end, in radians.
    from: f64,
    /// The angle of the normal from +x at the last end, in radians.
    to: f64,
}

impl Arc {
    fn length(&self) -> f64 {
        self.radius * (self.to - self.from)
    }
}

/// A quarter of a rectangle with bulged sides and rounded corners, made of three arcs.
pub struct RoundedQuarter {
    /// The arcs at +x, at the corner and at +y.
    arcs: [Arc; 3],
}

impl RoundedQuarter {
    /// Makes the quarter of an outline that is 2 wide and `2 * length` long. `bulge` is the bulge of the sides
    /// between the corners that they would have without rounding, and `corner` is the radius of the corners. `None`
    /// where the arcs do not follow one another.
    pub fn new(length: f64, bulge: f64, corner: f64) -> Option<Self> {
        let radius = |half: f64| (half * half + bulge * bulge) / (2.0 * bulge);
        let (right, upper) = (radius(length), radius(1.0));
        let (a, b) = (DVec2::new(1.0 - right, 0.0), DVec2::new(0.0, length - upper));
        // The corner's centre has the same distance from both sides.
        let ([to_a, to_b], between) = ([right - corner, upper - corner], b - a);
        let apart = between.length();
        let along = (to_a * to_a - to_b * to_b + apart * apart) / (2.0 * apart);
        let off = (to_a * to_a - along * along).sqrt();
        let centre = a + between / apart * along + between.perp() / apart * off;
        let [begin, end] = [(centre - a).to_angle(), (centre - b).to_angle()];
        let quarter = std::f64::consts::FRAC_PI_2;
        let is_whole = to_a > 0.0 && to_b > 0.0 && begin > 0.0 && begin < end && end < quarter;
        let arcs = [
            Arc { centre: a, radius: right, from: 0.0, to: begin },
            Arc { centre, radius: corner, from: begin, to: end },
            Arc { centre: b, radius: upper, from: end, to: quarter },
        ];
        is_whole.then_some(Self { arcs })
    }

    /// Returns the place at a part of the way from +x to +y; the middle of the corner is at half of the way.
    pub fn at(&self, part: f64) -> GirdlePlace {
        let [side, corner, end] = self.arcs;
        let middle = 0.5 * (corner.from + corner.to);
        let halves = [[side, Arc { to: middle, ..corner }], [Arc { from: middle, ..corner }, end]];
        let half = halves[usize::from(part > 0.5)];
        let lengths = half.map(|arc| arc.length());
        let mut way = (2.0 * part - f64::from(part > 0.5)) * (lengths[0] + lengths[1]);
        let arc = usize::from(way > lengths[0]);
        if arc == 1 {
            way -= lengths[0];
        }
        let Arc { centre, radius, from, .. } = half[arc];
        let normal = match part {
            0.0 => DVec2::X,
            1.0 => DVec2::Y,
            _ => DVec2::from_angle(from + way / radius),
        };
        GirdlePlace { at: centre + normal * radius, normal, is_corner: false }
    }
}
