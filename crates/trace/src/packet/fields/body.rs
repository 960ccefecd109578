//! The bodies of glass shapes in f32, before any shear. It is the twin of `math/implicit/body.rs` and `profile.rs`.
//!
//! Points are in the axes of the body: the first two span its outline, and the third is the axis along which the
//! outline is extruded. Bodies are symmetric, so functions are computed for folded points, which are mirrored to the
//! positive side of each axis of symmetry.

use super::super::lanes::{Lanes, Mask, Vectors};
use brillianteer_math::{ImplicitSurface, SurfaceParts};
use pulp::Simd;

/// A convex body around the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct PacketBody {
    pub outline: PacketOutline,
    /// Half the length of the core along the axis.
    pub half: f32,
    /// The radius of the ball that rounds the edges.
    pub edge: f32,
}

/// A convex outline.
#[derive(Debug, Clone, Copy)]
pub(super) enum PacketOutline {
    /// A rectangle with its corners at ±`half`, and a disc of radius `round` rolled around it.
    Rectangle { half: [f32; 2], round: f32 },
    /// An isosceles triangle with its base below.
    Triangle {
        /// The end of the base on the positive side.
        corner: [f32; 2],
        /// The height of the apex.
        apex: f32,
        /// The outward unit normal of the flank on the positive side.
        normal: [f32; 2],
        /// The length of a flank.
        flank: f32,
    },
}

/// The signed distance from a body at a point, with its derivatives.
pub(super) struct PacketJet<S: Simd> {
    pub value: Lanes<S>,
    pub gradient: Vectors<S>,
    /// The change of the gradient over the given displacement.
    pub change: Vectors<S>,
    /// The radius of the ball, cylinder or torus that this piece of the surface belongs to.
    pub radius: Lanes<S>,
}

/// A distance in the plane, with its derivatives.
struct FlatJet<S: Simd> {
    value: Lanes<S>,
    gradient: [Lanes<S>; 2],
    change: [Lanes<S>; 2],
}

/// The least divisor, so that no direction is exactly parallel to a plane.
const LEAST: f32 = 1e-20;

impl PacketBody {
    /// Converts the body of a shape to single precision.
    pub fn new(surface: &ImplicitSurface) -> Self {
        let SurfaceParts { corner, round, flank, half, edge, .. } = surface.parts();
        let length = |x: f64| (x * surface.reach()) as f32;
        let corner = [length(corner.x), length(corner.y)];
        let outline = match flank {
            None => PacketOutline::Rectangle { half: corner, round: length(round) },
            Some((normal, flank)) => PacketOutline::Triangle {
                corner,
                apex: length(round),
                normal: normal.as_vec2().to_array(),
                flank: length(flank),
            },
        };
        Self { outline, half: length(half), edge: length(edge) }
    }

    /// Returns a vector of the shape's frame in the axes of the body.
    #[inline(always)]
    pub fn own_axes<S: Simd>(&self, Vectors([x, y, z]): Vectors<S>) -> Vectors<S> {
        Vectors(if self.is_triangular() { [y, z, x] } else { [x, y, z] })
    }

    /// Returns a vector in the axes of the body in the shape's frame: the inverse of [`own_axes`](Self::own_axes).
    #[inline(always)]
    pub fn shape_axes<S: Simd>(&self, Vectors([a, b, c]): Vectors<S>) -> Vectors<S> {
        Vectors(if self.is_triangular() { [c, a, b] } else { [a, b, c] })
    }

    #[inline(always)]
    fn is_triangular(&self) -> bool {
        matches!(self.outline, PacketOutline::Triangle { .. })
    }

    /// Returns a vector, mirrored as its point is when that is folded; a second call undoes it.
    #[inline(always)]
    fn folded<S: Simd>(&self, v: Vectors<S>, point: Vectors<S>) -> Vectors<S> {
        let second = if self.is_triangular() { v[1] } else { v[1].times_sign_of(point[1]) };
        Vectors([v[0].times_sign_of(point[0]), second, v[2].times_sign_of(point[2])])
    }

    /// Returns the distances at which a line enters and leaves the solid between the planes of the flat faces.
    ///
    /// `lift` is the distance by which the faces along the axis are moved outward.
    #[inline(always)]
    pub fn between<S: Simd>(&self, o: Vectors<S>, v: Vectors<S>, lift: f32) -> [Lanes<S>; 2] {
        let ends = slab(o[2], v[2], self.half + self.edge + lift);
        match self.outline {
            PacketOutline::Rectangle { half, round } => {
                let (a, b) = (half[0] + round + self.edge, half[1] + round + self.edge);
                common(ends, common(slab(o[0], v[0], a), slab(o[1], v[1], b)))
            }
            PacketOutline::Triangle { corner, normal, .. } => {
                let base = half_space(-o[1], -v[1], self.edge - corner[1]);
                let offset = normal[0] * corner[0] + normal[1] * corner[1] + self.edge;
                let (across, up) = (o[0] * normal[0], o[1] * normal[1]);
                let (across_v, up_v) = (v[0] * normal[0], v[1] * normal[1]);
                let right = half_space(up + across, up_v + across_v, offset);
                let left = half_space(up - across, up_v - across_v, offset);
                common(common(ends, base), common(right, left))
            }
        }
    }

    /// Returns the function at a point on the surface or outside, with the change of its gradient over a
    /// displacement.
    #[inline(always)]
    pub fn jet<S: Simd>(&self, p: Vectors<S>, by: Vectors<S>) -> PacketJet<S> {
        let jet = self.folded_jet(self.folded(p, p), self.folded(by, p));
        PacketJet { gradient: self.folded(jet.gradient, p), change: self.folded(jet.change, p), ..jet }
    }

    #[inline(always)]
    fn folded_jet<S: Simd>(&self, p: Vectors<S>, by: Vectors<S>) -> PacketJet<S> {
        let zero = p[2].all(0.0);
        let (outline, round) = match self.outline {
            PacketOutline::Rectangle { half, round } => (self.rectangle(half, round, p, by), round),
            PacketOutline::Triangle { .. } => (self.triangle(p, by), 0.0),
        };
        let FlatJet { value: level, gradient: [ga, gb], change: [ca, cb] } = outline;
        let end = p[2] - self.half;
        // Where the edges are sharp, only the faces count.
        let is_edge = if self.edge > 0.0 { level.min(end).is_positive() } else { level.less(level) };
        let is_side = end.less(level);

        let distance = (level * level + end * end).sqrt();
        let per = p[2].all(1.0) / distance;
        let (to_side, to_end) = (level * per, end * per);
        let rim = Vectors([ga * to_side, gb * to_side, to_end]);
        // The derivatives follow from d² = a² + b², differentiated twice.
        let along = rim.dot(by);
        let across = ga * by[0] + gb * by[1];
        let rim_change = [
            (ga * across + ca * level - rim[0] * along) * per,
            (gb * across + cb * level - rim[1] * along) * per,
            (by[2] - to_end * along) * per,
        ];

        PacketJet {
            value: is_edge.select(distance, level.max(end)) - self.edge,
            gradient: Vectors([
                is_edge.select(rim[0], is_side.select(ga, zero)),
                is_edge.select(rim[1], is_side.select(gb, zero)),
                is_edge.select(to_end, is_side.select(zero, zero + 1.0)),
            ]),
            change: Vectors([
                is_edge.select(rim_change[0], is_side.select(ca, zero)),
                is_edge.select(rim_change[1], is_side.select(cb, zero)),
                is_edge.select(rim_change[2], zero),
            ]),
            radius: is_edge.select(zero + self.edge, zero + (self.edge + round)),
        }
    }

    #[inline(always)]
    fn rectangle<S: Simd>(&self, half: [f32; 2], round: f32, p: Vectors<S>, by: Vectors<S>) -> FlatJet<S> {
        let (zero, one) = (p[0].all(0.0), p[0].all(1.0));
        let away = [p[0] - half[0], p[1] - half[1]];
        let is_sharp = self.edge == 0.0 && round == 0.0;
        let is_corner = if is_sharp { zero.less(zero) } else { away[0].min(away[1]).is_positive() };
        let is_first = away[1].less(away[0]);
        let corner = radial(away, [by[0], by[1]]);
        FlatJet {
            value: is_corner.select(corner.value, away[0].max(away[1])) - round,
            gradient: [
                is_corner.select(corner.gradient[0], is_first.select(one, zero)),
                is_corner.select(corner.gradient[1], is_first.select(zero, one)),
            ],
            change: [is_corner.select(corner.change[0], zero), is_corner.select(corner.change[1], zero)],
        }
    }

    #[inline(always)]
    fn triangle<S: Simd>(&self, p: Vectors<S>, by: Vectors<S>) -> FlatJet<S> {
        let zero = p[0].all(0.0);
        let PacketOutline::Triangle { corner, apex, normal, flank } = self.outline else {
            return FlatJet { value: zero, gradient: [zero; 2], change: [zero; 2] };
        };
        let from_corner = [p[0] - corner[0], p[1] - corner[1]];
        let up = from_corner[1] * normal[0] - from_corner[0] * normal[1];
        // Beyond an end of a flank the nearest point is a corner; elsewhere it lies on a side.
        let is_above = zero.all(flank).less(up);
        let is_beyond = is_above | (up.is_negative() & from_corner[0].is_positive());
        let is_corner: Mask<S> = if self.edge > 0.0 { is_beyond } else { zero.less(zero) };
        let away = [is_above.select(p[0], from_corner[0]), is_above.select(p[1] - apex, from_corner[1])];
        let corner = radial(away, [by[0], by[1]]);
        let base = -from_corner[1];
        let side = from_corner[0] * normal[0] + from_corner[1] * normal[1];
        let is_base = side.less(base);
        FlatJet {
            value: is_corner.select(corner.value, base.max(side)),
            gradient: [
                is_corner.select(corner.gradient[0], is_base.select(zero, zero + normal[0])),
                is_corner.select(corner.gradient[1], is_base.select(zero - 1.0, zero + normal[1])),
            ],
            change: [is_corner.select(corner.change[0], zero), is_corner.select(corner.change[1], zero)],
        }
    }
}

/// Returns the distance from a point, for a place displaced from that point by `away`.
#[inline(always)]
fn radial<S: Simd>(away: [Lanes<S>; 2], by: [Lanes<S>; 2]) -> FlatJet<S> {
    let value = (away[0] * away[0] + away[1] * away[1]).sqrt();
    let per = value.all(1.0) / value;
    let gradient = [away[0] * per, away[1] * per];
    let along = gradient[0] * by[0] + gradient[1] * by[1];
    FlatJet {
        value,
        gradient,
        change: [(by[0] - gradient[0] * along) * per, (by[1] - gradient[1] * along) * per],
    }
}

/// Returns the stretch of a line where one coordinate is within ±`half`.
#[inline(always)]
fn slab<S: Simd>(o: Lanes<S>, v: Lanes<S>, half: f32) -> [Lanes<S>; 2] {
    let per = o.all(1.0) / v.abs().max(o.all(LEAST)).times_sign_of(v);
    let (middle, room) = (-o * per, per.abs() * half);
    [middle - room, middle + room]
}

/// Returns the stretch of a line that is no farther along a normal than `offset`; `o` and `v` are the line's
/// coordinates along the normal.
#[inline(always)]
fn half_space<S: Simd>(o: Lanes<S>, v: Lanes<S>, offset: f32) -> [Lanes<S>; 2] {
    let at = (o.all(offset) - o) / v.abs().max(o.all(LEAST)).times_sign_of(v);
    let goes_in = v.is_negative();
    [goes_in.select(at, o.all(f32::NEG_INFINITY)), goes_in.select(o.all(f32::INFINITY), at)]
}

/// Returns the common part of two stretches.
#[inline(always)]
fn common<S: Simd>(a: [Lanes<S>; 2], b: [Lanes<S>; 2]) -> [Lanes<S>; 2] {
    [a[0].max(b[0]), a[1].min(b[1])]
}
