//! The planes of a convex stone, as packets of rays meet them.

use super::lanes::{Lanes, Vectors};
use super::{Met, PacketSurface};
use crate::math::{Plane, Polytope};
use glam::{DVec3, Vec3, Vec4};
use pulp::Simd;

/// The least gap between a point and a plane; smaller ones count as this. So where rounding has put a point a hair outside a
/// plane, that plane is met at once.
const LEAST_GAP: f32 = 1e-30;

/// The part of a ball's radius that rounding in single precision may take.
const ROUNDING: f64 = 1e-5;

/// Planes, each its unit outward normal and its offset.
///
/// Those that lie outside a ball are tried only for rays that leave the others outside that ball. A girdle of a hundred
/// facets is met by few rays: they leave by the crown or the pavilion inside a ball that the girdle encloses.
#[derive(Debug, Clone)]
pub(super) struct PacketPlanes {
    /// The planes that are always tried come first.
    planes: Vec<Vec4>,
    always: usize,
    ball: Vec3,
    radius_squared: f32,
}

impl PacketPlanes {
    pub fn new(polytope: &Polytope) -> Self {
        let ball = polytope.vertices().iter().sum::<DVec3>() / polytope.vertices().len().max(1) as f64;
        let mut planes: Vec<Plane> = polytope.planes().collect();
        planes.sort_by(|a, b| b.distance(ball).total_cmp(&a.distance(ball)));
        let surface = Pieces::of(polytope, ball);
        let always = (0..=planes.len()).min_by(|&a, &b| {
            let cost = |always: usize| {
                let radius = planes.get(always).map_or(f64::INFINITY, |plane| -plane.distance(ball));
                let others = (planes.len() - always) as f64;
                always as f64 + others * surface.share_beyond(radius)
            };
            cost(a).total_cmp(&cost(b))
        });
        let always = always.unwrap_or(planes.len());
        let radius = planes[always..].iter().map(|plane| -plane.distance(ball)).fold(f64::INFINITY, f64::min);
        Self {
            planes: planes.iter().map(|plane| plane.normal.extend(plane.offset).as_vec4()).collect(),
            always,
            ball: ball.as_vec3(),
            radius_squared: (radius * (1.0 - ROUNDING)).max(0.0).powi(2) as f32,
        }
    }
}

/// The surface of a stone in small pieces: the distance of each from a point, and its area.
struct Pieces(Vec<(f64, f64)>);

impl Pieces {
    /// Cuts each facet into triangles at its first corner.
    fn of(polytope: &Polytope, from: DVec3) -> Self {
        let mut pieces = vec![];
        for facet in polytope.facets() {
            let corners: Vec<DVec3> = polytope.corners(facet).collect();
            for k in 2..corners.len() {
                let [a, b, c] = [corners[0], corners[k - 1], corners[k]];
                let area = 0.5 * (b - a).cross(c - a).length();
                pieces.push((from.distance((a + b + c) / 3.0), area));
            }
        }
        Self(pieces)
    }

    /// Returns the share of the surface that lies farther away than a radius.
    fn share_beyond(&self, radius: f64) -> f64 {
        let all = self.0.iter().map(|(_, area)| area).sum::<f64>();
        let beyond = self.0.iter().filter(|(distance, _)| *distance > radius);
        beyond.map(|(_, area)| area).sum::<f64>() / all
    }
}

/// The plane that each ray meets first, so far: the one with the greatest ratio of the speed toward it to the gap before it.
/// Planes behind have negative ratios.
struct Nearest<S: Simd> {
    ratio: Lanes<S>,
    plane: Lanes<S>,
}

impl<S: Simd> Nearest<S> {
    /// Tries some planes, of which the first has this number.
    #[inline(always)]
    fn among(
        self,
        simd: S,
        planes: &[Vec4],
        first: usize,
        (origin, direction): (Vectors<S>, Vectors<S>),
    ) -> Self {
        let least_gap = Lanes::all(simd, LEAST_GAP);
        let Self { mut ratio, mut plane } = self;
        let mut number = first as f32;
        for tried in planes {
            let normal = Vectors::all(simd, tried.truncate());
            let speed = normal.dot(direction);
            let gap = Lanes::all(simd, tried.w) - normal.dot(origin);
            let own = speed / gap.max(least_gap);
            plane = own.exceeds(ratio).select(Lanes::all(simd, number), plane);
            ratio = own.max(ratio);
            number += 1.0;
        }
        Self { ratio, plane }
    }
}

impl PacketSurface for PacketPlanes {
    const IS_CURVED: bool = false;

    #[inline(always)]
    fn exit<S: Simd>(&self, simd: S, origin: Vectors<S>, direction: Vectors<S>) -> Met<S> {
        let none = Nearest { ratio: Lanes::all(simd, 0.0), plane: Lanes::all(simd, 0.0) };
        let (always, others) = self.planes.split_at(self.always);
        let mut nearest = none.among(simd, always, 0, (origin, direction));
        let least_gap = Lanes::all(simd, LEAST_GAP);
        let leaves = origin + direction * (Lanes::all(simd, 1.0) / nearest.ratio.max(least_gap));
        let away = (leaves - Vectors::all(simd, self.ball)).length_squared();
        if away.exceeds(Lanes::all(simd, self.radius_squared)).any() {
            nearest = nearest.among(simd, others, self.always, (origin, direction));
        }
        let mut normal = Vectors::all(simd, Vec3::ZERO);
        let mut offset = Lanes::all(simd, 0.0);
        for (lane, &number) in nearest.plane.as_slice().iter().enumerate() {
            let plane = self.planes[number as usize];
            normal.set_lane(lane, plane.truncate());
            offset.set_lane(lane, plane.w);
        }
        let gap = (offset - normal.dot(origin)).max(Lanes::all(simd, 0.0));
        Met { distance: gap / normal.dot(direction).max(least_gap), normal }
    }

    #[inline(always)]
    fn turned<S: Simd>(&self, simd: S, _point: Vectors<S>, _by: Vectors<S>) -> Vectors<S> {
        Vectors::all(simd, Vec3::ZERO)
    }
}
