//! Point rays: the same light as one chain of bounces, in f64.
//!
//! A convex stone never takes back a ray that has left it, so a ray needs no branching: at every facet a part
//! leaves and the rest goes on. Rays know nothing of outlines or symmetry and follow polarisation as fields in
//! space, so that where rays and beams agree it is not by a shared mistake.

mod camera;
mod company;
mod path;
mod search;
mod sight;

pub use self::camera::Camera;
pub use self::company::ByRays;
use self::path::{Exiting, Meeting};
pub use self::path::{Leaving, Path, Step};
use self::search::Search;
pub use self::sight::{Glance, Sight, facet_at};
use crate::math::{Plane, Polytope};
use crate::optics::{cos_transmitted, fresnel, reflect, reflectance, refract, refracted_change};
use crate::scene::Medium;
use glam::DVec3;
use num_complex::Complex64;
use std::sync::Arc;

/// How far to follow a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Follow polarisation; without, every surface sees unpolarised light.
    pub polarised: bool,
    /// Stop after this many bounces inside the stone.
    pub most_bounces: u32,
    /// Stop when no more than this weight is left.
    pub least_weight: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { polarised: true, most_bounces: 1000, least_weight: 1e-6 }
    }
}

/// Light that leaves the stone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exit {
    /// The facet, by its place in the polytope.
    pub facet: u32,
    /// Where it leaves.
    pub point: DVec3,
    /// Length of its path inside the stone, in girdle radii.
    pub path: f64,
    /// Unit direction in which it leaves.
    pub direction: DVec3,
    /// How far that direction moves over the medium's spread of indices.
    pub sweep: DVec3,
    /// The share of light from that direction which reaches the eye.
    pub weight: f64,
    /// The bounce inside at which it leaves, from 1; 0 for the glare of the outer surface.
    pub bounce: u32,
    /// Whether this is the glare of the outer surface.
    pub surface: bool,
}

/// What of a ray did not leave the stone.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rest {
    /// Share absorbed.
    pub absorbed: f64,
    /// Share not followed to its end.
    pub unresolved: f64,
    /// Bounces inside the stone.
    pub bounces: u32,
}

/// Follows single rays through one stone.
#[derive(Debug, Clone)]
pub struct Tracer {
    planes: Arc<[Plane]>,
    search: Arc<Search>,
    medium: Medium,
    options: Options,
}

/// The light on a stretch between two facets, as what the eye's two polarisations have become.
#[derive(Clone, Copy)]
enum Light {
    Unpolarised(f64),
    Fields([Field; 2]),
}

/// A complex field in space, square to its ray.
#[derive(Clone, Copy)]
struct Field {
    re: DVec3,
    im: DVec3,
}

impl Field {
    fn along(&self, axis: DVec3) -> Complex64 {
        Complex64::new(self.re.dot(axis), self.im.dot(axis))
    }

    fn of(axes: [(Complex64, DVec3); 2]) -> Self {
        let [(a, x), (b, y)] = axes;
        Self { re: x * a.re + y * b.re, im: x * a.im + y * b.im }
    }

    fn power(&self) -> f64 {
        self.re.length_squared() + self.im.length_squared()
    }
}

impl Light {
    #[inline]
    fn weight(&self) -> f64 {
        match self {
            Self::Unpolarised(weight) => *weight,
            Self::Fields([a, b]) => (a.power() + b.power()) / 2.0,
        }
    }

    /// Splits at a surface: what goes on inside along `onward`, and the weight that is left on the outer side.
    /// Light that enters goes on through the surface; light inside is reflected.
    fn split(&self, ray: DVec3, onward: DVec3, normal: DVec3, eta: f64, enters: bool) -> (Self, f64) {
        let cos_i = ray.dot(normal).abs();
        let fields = match self {
            Self::Unpolarised(weight) => {
                let reflected = reflectance(cos_i, eta).unwrap_or(1.0);
                let inside = if enters { 1.0 - reflected } else { reflected };
                return (Self::Unpolarised(weight * inside), weight * (1.0 - inside));
            }
            Self::Fields(fields) => fields,
        };
        let surface = fresnel(cos_i, eta);
        let (to_s, to_p) = if enters {
            (surface.transmission_s().into(), surface.transmission_p().into())
        } else {
            (surface.r_s, surface.r_p)
        };
        let s = across(ray, normal);
        let (p, p_onward) = (s.cross(ray), s.cross(onward));
        let inside = fields.map(|f| Field::of([(to_s * f.along(s), s), (to_p * f.along(p), p_onward)]));
        let lost = |f: &Field| {
            let part = |r: Complex64, e: Complex64| {
                if surface.is_total() { 0.0 } else { (1.0 - r.norm_sqr()) * e.norm_sqr() }
            };
            part(to_s, f.along(s)) + part(to_p, f.along(p))
        };
        (Self::Fields(inside), (lost(&fields[0]) + lost(&fields[1])) / 2.0)
    }
}

/// Sine of the angle below which a ray counts as square to a facet: the cross product there is mostly rounding.
const SQUARE_ON: f64 = 1e-9;

/// A unit vector square to the ray and to the normal: to the ray alone where the two are one line.
fn across(ray: DVec3, normal: DVec3) -> DVec3 {
    let s = ray.cross(normal);
    let length = s.length();
    if length > SQUARE_ON { s / length } else { ray.any_orthonormal_vector() }
}

/// The mirror image of any vector.
fn mirrored(v: DVec3, normal: DVec3) -> DVec3 {
    v - normal * (2.0 * v.dot(normal))
}

impl Tracer {
    /// Prepares a stone.
    pub fn new(polytope: &Polytope, medium: Medium, options: Options) -> Self {
        let planes: Vec<Plane> = polytope.planes().collect();
        let search = Arc::new(Search::new(&planes));
        Self { planes: planes.into(), search, medium, options }
    }

    /// The same stone of another medium.
    pub fn made_of(&self, medium: Medium) -> Self {
        Self { medium, ..self.clone() }
    }

    /// Follows the ray from a point outside, calling `leave` for the surface's glare and for each exit; `None`
    /// where it misses the stone.
    pub fn follow(&self, origin: DVec3, direction: DVec3, leave: impl FnMut(Exit)) -> Option<Rest> {
        let met = self.meet(origin, direction)?;
        self.follow_from(met, origin, (direction, DVec3::ZERO), 1.0, leave)
    }

    /// Follows a ray that is known to [`meet`](Self::meet) the stone, of another weight than 1, whose direction moves over
    /// the spread of wavelengths: one that may have left another stone. `None` where it runs along the facet.
    pub fn follow_from(
        &self,
        met: (usize, f64),
        origin: DVec3,
        way: (DVec3, DVec3),
        weight: f64,
        mut leave: impl FnMut(Exit),
    ) -> Option<Rest> {
        self.visit(met, origin, way, weight, |meeting| {
            if let Some(exit) = meeting.exit() {
                leave(exit);
            }
        })
    }

    /// The way of a ray through the stone, from the facet where it enters: the one loop behind all that is told of rays.
    fn visit(
        &self,
        (facet, distance): (usize, f64),
        origin: DVec3,
        (direction, sweep): (DVec3, DVec3),
        weight: f64,
        mut meets: impl FnMut(Meeting),
    ) -> Option<Rest> {
        let normal = self.planes[facet].normal;
        let point = origin + direction * distance;
        let eta = 1.0 / self.medium.index;
        let cos_i = -direction.dot(normal);
        let cos_t = cos_transmitted(cos_i, eta)?;
        let inward = refract(direction, normal, eta, (cos_i, cos_t));
        let (light, glare) = self.eye_light(direction, weight).split(direction, inward, normal, eta, true);
        let of_eta = -self.medium.spread * eta * eta;
        let swept = refracted_change(direction, normal, eta, (cos_i, cos_t), (sweep, of_eta));
        let glare = Exiting {
            direction: reflect(direction, normal, cos_i),
            sweep: mirrored(sweep, normal),
            weight: glare,
        };
        meets(Meeting {
            facet: facet as u32,
            point,
            path: 0.0,
            bounce: 0,
            arriving: direction,
            leaving: Some(glare),
            onward: light.weight(),
        });
        Some(self.bounce(point, (inward, swept), light, meets))
    }

    fn eye_light(&self, direction: DVec3, weight: f64) -> Light {
        if !self.options.polarised {
            return Light::Unpolarised(weight);
        }
        let (a, b) = direction.any_orthonormal_pair();
        Light::Fields([a, b].map(|axis| Field { re: axis * weight.sqrt(), im: DVec3::ZERO }))
    }

    fn bounce(
        &self,
        mut point: DVec3,
        (mut direction, mut sweep): (DVec3, DVec3),
        mut light: Light,
        mut meets: impl FnMut(Meeting),
    ) -> Rest {
        let mut rest = Rest::default();
        let (mut left, mut path) = (1.0, 0.0);
        let mut remaining = light.weight();
        while remaining > self.options.least_weight && rest.bounces < self.options.most_bounces {
            let (facet, distance, cos_i) = self.next(point, direction);
            let normal = self.planes[facet].normal;
            point += direction * distance;
            path += distance;
            if !self.medium.is_clear() {
                let after = self.medium.transmittance(path);
                rest.absorbed += light.weight() * (left - after);
                left = after;
            }
            let reflected = reflect(direction, -normal, cos_i);
            let cos_t = cos_transmitted(cos_i, self.medium.index);
            let (onward, weight) = match (cos_t, light) {
                (None, Light::Unpolarised(_)) => (light, 0.0),
                _ => light.split(direction, reflected, normal, self.medium.index, false),
            };
            let leaving = cos_t.map(|cos_t| {
                let Medium { index, spread, .. } = self.medium;
                Exiting {
                    direction: refract(direction, -normal, index, (cos_i, cos_t)),
                    sweep: refracted_change(direction, -normal, index, (cos_i, cos_t), (sweep, spread)),
                    weight: weight * left,
                }
            });
            rest.bounces += 1;
            remaining = onward.weight() * left;
            meets(Meeting {
                facet: facet as u32,
                point,
                path,
                bounce: rest.bounces,
                arriving: direction,
                leaving,
                onward: remaining,
            });
            (light, direction, sweep) = (onward, reflected, mirrored(sweep, normal));
        }
        rest.unresolved = remaining;
        rest
    }

    /// Facet and distance at which a ray enters from outside; `None` where it misses.
    pub fn meet(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        let facet = self.search.entry(origin, direction)?;
        let plane = &self.planes[facet];
        let distance = -plane.distance(origin) / plane.normal.dot(direction);
        (distance > 0.0).then_some((facet, distance))
    }

    /// Facet, distance and cosine of incidence at which a ray inside the stone meets it next.
    #[inline]
    fn next(&self, point: DVec3, direction: DVec3) -> (usize, f64, f64) {
        let facet = self.search.next(point, direction);
        let plane = &self.planes[facet];
        let cos_i = plane.normal.dot(direction);
        (facet, -plane.distance(point) / cos_i, cos_i)
    }
}
