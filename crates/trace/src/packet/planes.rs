//! The planes of a convex stone, for packets of rays.

use super::lanes::{Lanes, Vectors};
use super::{PacketHit, PacketSurface};
use brillianteer_math::{Plane, Polytope};
use glam::{DVec3, Vec3, Vec4};
use pulp::Simd;

/// The least gap between a point and a plane; smaller gaps count as this one. So where rounding has put a point just
/// outside a plane, the ray meets that plane at once.
const LEAST_GAP: f32 = 1e-30;

/// The greatest part of a girdle facet's normal along the stone's axis.
const GIRDLE_TILT: f64 = 0.05;

/// The part of a length or a cosine that may be lost by rounding in single precision.
const ROUNDING: f64 = 1e-5;

/// The planes, each as its unit outward normal and its offset: those of the crown first, then those of the pavilion,
/// then those of the girdle.
///
/// Rays that run steeply up meet no facet of the pavilion, and rays that run steeply down meet none of the crown. Few
/// rays meet a girdle of a hundred facets: most leave through the crown or the pavilion inside a cylinder that the
/// girdle encloses.
#[derive(Debug, Clone)]
pub(super) struct PacketPlanes {
    planes: Vec<Vec4>,
    /// The number of planes of the crown, and the number of planes of crown and pavilion together.
    ends: [usize; 2],
    /// Two limits for the upward component of a direction: a ray at or below the first meets no facet of the crown,
    /// and a ray at or above the second meets no facet of the pavilion.
    steep: [f32; 2],
    cylinder: Cylinder,
}

/// An elliptical cylinder along the stone's axis, inside all planes of the girdle.
#[derive(Debug, Clone, Copy)]
struct Cylinder {
    middle: Vec3,
    /// The factors of x and y that give the cylinder the radius 1; the factor of z is 0.
    scale: Vec3,
}

impl PacketPlanes {
    pub fn new(polytope: &Polytope) -> Self {
        let all: Vec<Plane> = polytope.planes().collect();
        let is_girdle = |plane: &&Plane| plane.normal.z.abs() <= GIRDLE_TILT;
        let (girdle, faces): (Vec<&Plane>, Vec<&Plane>) = all.iter().partition(is_girdle);
        let (crown, pavilion): (Vec<&Plane>, Vec<&Plane>) = faces.iter().partition(|p| p.normal.z > 0.0);
        // Light that runs down at more than 90 degrees minus the slope of a crown facet runs away from that facet.
        let steep = |planes: &[&Plane]| {
            let least = planes.iter().map(|plane| plane.normal.z.abs()).fold(1.0, f64::min);
            ((1.0 - least * least).max(0.0).sqrt() + ROUNDING) as f32
        };
        let cylinder = Cylinder::inside(polytope, &girdle);
        Self {
            ends: [crown.len(), crown.len() + pavilion.len()],
            steep: [-steep(&crown), steep(&pavilion)],
            planes: [crown, pavilion, girdle]
                .concat()
                .iter()
                .map(|plane| plane.normal.extend(plane.offset).as_vec4())
                .collect(),
            cylinder,
        }
    }
}

impl Cylinder {
    /// Returns the largest cylinder with the outline's proportions that is inside these planes over the whole height
    /// of the stone.
    fn inside(polytope: &Polytope, planes: &[&Plane]) -> Self {
        let (low, high) = polytope.bounds();
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let part = |plane: &&Plane| {
            let across = (plane.normal * half).truncate().length();
            let gap = -plane.distance(middle) - plane.normal.z.abs() * half.z;
            gap / across
        };
        let radius = planes.iter().map(part).fold(1.0, f64::min).max(0.0) * (1.0 - ROUNDING);
        let scale = DVec3::new(1.0 / (radius * half.x), 1.0 / (radius * half.y), 0.0);
        Self { middle: middle.as_vec3(), scale: scale.as_vec3() }
    }

    /// Returns whether any of these points is outside the cylinder or is NaN.
    #[inline(always)]
    fn is_left<S: Simd>(&self, simd: S, points: Vectors<S>) -> bool {
        let from = points - Vectors::splat(simd, self.middle);
        let (x, y) = (from[0] * self.scale.x, from[1] * self.scale.y);
        !(x * x + y * y).less(x.all(1.0)).all()
    }
}

/// The plane that each ray meets first among those tried so far: the plane with the greatest ratio of the speed
/// toward it to the gap before it. Planes behind the ray have negative ratios.
struct Nearest<S: Simd> {
    ratio: Lanes<S>,
    plane: Lanes<S>,
}

impl<S: Simd> Nearest<S> {
    /// Tries some planes; the first of them has the number `first`.
    #[inline(always)]
    fn among(
        self,
        simd: S,
        planes: &[Vec4],
        first: usize,
        (origin, direction): (Vectors<S>, Vectors<S>),
    ) -> Self {
        let least_gap = Lanes::splat(simd, LEAST_GAP);
        let Self { mut ratio, mut plane } = self;
        let mut number = first as f32;
        for tried in planes {
            let normal = Vectors::splat(simd, tried.truncate());
            let speed = normal.dot(direction);
            let gap = Lanes::splat(simd, tried.w) - normal.dot(origin);
            let own = speed / gap.max(least_gap);
            plane = ratio.less(own).select(Lanes::splat(simd, number), plane);
            ratio = own.max(ratio);
            number += 1.0;
        }
        Self { ratio, plane }
    }
}

impl PacketSurface for PacketPlanes {
    #[inline(always)]
    fn entry<S: Simd>(&self, simd: S, origin: Vectors<S>, direction: Vectors<S>) -> PacketHit<S> {
        let (zero, none) = (Lanes::splat(simd, 0.0), Lanes::splat(simd, f32::INFINITY));
        let (mut into, mut out) = (zero, none);
        let mut normal = Vectors::splat(simd, Vec3::ZERO);
        for plane in &self.planes {
            let own = Vectors::splat(simd, plane.truncate());
            let speed = own.dot(direction);
            let gap = Lanes::splat(simd, plane.w) - own.dot(origin);
            let distance = gap / speed;
            let is_entered = speed.is_negative() & into.less(distance);
            into = is_entered.select(distance, into);
            normal = Vectors([
                is_entered.select(own[0], normal[0]),
                is_entered.select(own[1], normal[1]),
                is_entered.select(own[2], normal[2]),
            ]);
            out = speed.is_positive().select(out.min(distance), out);
            // A ray that runs along a plane on its outer side never enters the stone.
            let is_beside = speed.at_most(zero) & zero.at_most(speed) & gap.is_negative();
            out = is_beside.select(zero, out);
        }
        let is_met = into.is_positive() & into.less(out);
        PacketHit { distance: is_met.select(into, none), normal }
    }

    #[inline(always)]
    fn exit<S: Simd>(&self, simd: S, origin: Vectors<S>, direction: Vectors<S>) -> PacketHit<S> {
        let ray = (origin, direction);
        let [crown, face] = self.ends;
        let [down, up] = [Lanes::splat(simd, self.steep[0]), Lanes::splat(simd, self.steep[1])];
        let mut nearest = Nearest { ratio: Lanes::splat(simd, 0.0), plane: Lanes::splat(simd, 0.0) };
        if down.less(direction[2]).any() {
            nearest = nearest.among(simd, &self.planes[..crown], 0, ray);
        }
        if direction[2].less(up).any() {
            nearest = nearest.among(simd, &self.planes[crown..face], crown, ray);
        }
        let distance = Lanes::splat(simd, 1.0) / nearest.ratio.max(Lanes::splat(simd, LEAST_GAP));
        if self.cylinder.is_left(simd, origin + direction * distance) {
            nearest = nearest.among(simd, &self.planes[face..], face, ray);
        }
        let mut normal = Vectors::splat(simd, Vec3::ZERO);
        let mut offset = Lanes::splat(simd, 0.0);
        for (lane, &number) in nearest.plane.as_slice().iter().enumerate() {
            let plane = self.planes[number as usize];
            normal.set_lane(lane, plane.truncate());
            offset.set_lane(lane, plane.w);
        }
        let gap = (offset - normal.dot(origin)).max(Lanes::splat(simd, 0.0));
        let speed = normal.dot(direction).max(Lanes::splat(simd, LEAST_GAP));
        PacketHit { distance: gap / speed, normal }
    }

    #[inline(always)]
    fn turned<S: Simd>(&self, _simd: S, _point: Vectors<S>, _by: Vectors<S>) -> Option<Vectors<S>> {
        None
    }
}
