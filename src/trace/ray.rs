//! Point rays: the same light as one chain of bounces, in f64.
//!
//! A convex stone never takes back a ray that has left it, so a ray needs no branching: at every facet a part
//! leaves and the rest goes on. Rays know nothing of outlines or symmetry and follow polarisation as fields in
//! space, so that where rays and beams agree it is not by a shared mistake.

mod search;

use self::search::Search;
use crate::math::{Basis, Plane, Polytope};
use crate::optics::{cos_transmitted, fresnel, reflect, reflectance, refract};
use crate::scene::{Medium, Projection, View};
use glam::{DVec2, DVec3};
use num_complex::Complex64;

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
    /// The share of light from that direction which reaches the eye.
    pub weight: f64,
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
    planes: Vec<Plane>,
    search: Search,
    medium: Medium,
    options: Options,
}

/// The image of a view: where the ray of each point begins, and which way it goes.
#[derive(Debug, Clone, Copy)]
pub struct Camera {
    basis: Basis,
    /// Distance of the eye; infinite for parallel rays.
    distance: f64,
    /// How far the stone reaches from the origin.
    reach: f64,
}

impl Camera {
    /// The camera of a view of this stone.
    pub fn new(view: &View, polytope: &Polytope) -> Self {
        let reach = polytope.vertices().iter().map(|v| v.length()).fold(0.0, f64::max);
        let distance = match view.projection {
            Projection::Orthographic => f64::INFINITY,
            Projection::Perspective { distance } => distance,
        };
        Self { basis: view.basis(), distance, reach }
    }

    /// Half the side of the smallest square around the image's origin that holds the whole stone; `None` where the
    /// eye is not in front of all of it.
    pub fn reach(&self, polytope: &Polytope) -> Option<f64> {
        polytope.vertices().iter().try_fold(0.0_f64, |reach, &v| {
            let nearness = 1.0 - self.basis.toward.dot(v) / self.distance;
            (nearness > 0.0).then(|| reach.max(self.basis.project(v).abs().max_element() / nearness))
        })
    }

    /// A point outside the stone on the ray through a point of the image plane, and the ray's unit direction.
    pub fn ray(&self, p: DVec2) -> (DVec3, DVec3) {
        let (at, toward) = (self.basis.lift(p), self.basis.toward);
        let (direction, from_eye) = if self.distance.is_infinite() {
            (-toward, f64::INFINITY)
        } else {
            let ray = at - toward * self.distance;
            (ray / ray.length(), ray.length())
        };
        // From a far eye the way to the stone would cost the digits that tell where the stone is met.
        (at - direction * from_eye.min(2.0 * self.reach + at.length()), direction)
    }
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

impl Tracer {
    /// Prepares a stone.
    pub fn new(polytope: &Polytope, medium: Medium, options: Options) -> Self {
        let planes: Vec<Plane> = polytope.planes().collect();
        let search = Search::new(&planes);
        Self { planes, search, medium, options }
    }

    /// Follows the ray from a point outside, calling `leave` for the surface's glare and for each exit; `None`
    /// where it misses the stone.
    pub fn follow(&self, origin: DVec3, direction: DVec3, mut leave: impl FnMut(Exit)) -> Option<Rest> {
        let (facet, distance) = self.enter(origin, direction)?;
        let normal = self.planes[facet].normal;
        let point = origin + direction * distance;
        let eta = 1.0 / self.medium.index;
        let cos_i = -direction.dot(normal);
        let cos_t = cos_transmitted(cos_i, eta)?;
        let inward = refract(direction, normal, eta, (cos_i, cos_t));
        let (light, glare) = self.eye_light(direction).split(direction, inward, normal, eta, true);
        let reflected = reflect(direction, normal, cos_i);
        leave(Exit {
            facet: facet as u32,
            point,
            path: 0.0,
            direction: reflected,
            weight: glare,
            surface: true,
        });
        Some(self.bounce(point, inward, light, leave))
    }

    fn eye_light(&self, direction: DVec3) -> Light {
        if !self.options.polarised {
            return Light::Unpolarised(1.0);
        }
        let (a, b) = direction.any_orthonormal_pair();
        Light::Fields([a, b].map(|re| Field { re, im: DVec3::ZERO }))
    }

    fn bounce(&self, from: DVec3, along: DVec3, mut light: Light, mut leave: impl FnMut(Exit)) -> Rest {
        let (mut point, mut direction) = (from, along);
        let mut rest = Rest::default();
        let (mut left, mut path) = (1.0, 0.0);
        while light.weight() * left > self.options.least_weight && rest.bounces < self.options.most_bounces {
            let (facet, distance, cos_i) = self.next(point, direction);
            let normal = self.planes[facet].normal;
            point += direction * distance;
            path += distance;
            if self.medium.absorption > 0.0 {
                let after = left * self.medium.transmittance(distance);
                rest.absorbed += light.weight() * (left - after);
                left = after;
            }
            let reflected = reflect(direction, -normal, cos_i);
            let cos_t = cos_transmitted(cos_i, self.medium.index);
            let (onward, weight) = match (cos_t, light) {
                (None, Light::Unpolarised(_)) => (light, 0.0),
                _ => light.split(direction, reflected, normal, self.medium.index, false),
            };
            if let Some(cos_t) = cos_t {
                let exit = refract(direction, -normal, self.medium.index, (cos_i, cos_t));
                let weight = weight * left;
                leave(Exit { facet: facet as u32, point, path, direction: exit, weight, surface: false });
            }
            (light, direction) = (onward, reflected);
            rest.bounces += 1;
        }
        rest.unresolved = light.weight() * left;
        rest
    }

    /// Facet and distance at which a ray enters from outside.
    fn enter(&self, origin: DVec3, direction: DVec3) -> Option<(usize, f64)> {
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
