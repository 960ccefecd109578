//! The light of a ray, and how a surface splits it.

use crate::optics::{Fresnel, fresnel, reflectance};
use glam::DVec3;
use num_complex::Complex64;

/// The light of a ray between two facets: a weight, or the fields that the eye's two polarisations have become.
#[derive(Clone, Copy)]
pub(in crate::trace) enum PathLight {
    Unpolarised(f64),
    Fields([ElectricField; 2]),
}

/// A complex electric field in space, perpendicular to its ray.
#[derive(Clone, Copy)]
pub(in crate::trace) struct ElectricField {
    re: DVec3,
    im: DVec3,
}

impl ElectricField {
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

    /// Returns the field that goes on along `onward` from a surface of these amplitudes.
    fn onward(&self, (to_s, to_p): Amplitudes, s: DVec3, (ray, onward): (DVec3, DVec3)) -> Self {
        let (p, p_onward) = (s.cross(ray), s.cross(onward));
        Self::of([(to_s * self.along(s), s), (to_p * self.along(p), p_onward)])
    }
}

/// The complex amplitudes of s and p.
type Amplitudes = (Complex64, Complex64);

/// Returns the amplitudes of light that passes a surface.
fn passing(surface: &Fresnel) -> Amplitudes {
    (surface.transmission_s().into(), surface.transmission_p().into())
}

impl PathLight {
    /// Returns the light of a ray from the eye: all polarisations alike.
    pub fn of_eye(direction: DVec3, weight: f64, is_polarised: bool) -> Self {
        if !is_polarised {
            return Self::Unpolarised(weight);
        }
        let (a, b) = direction.any_orthonormal_pair();
        Self::Fields([a, b].map(|axis| ElectricField { re: axis * weight.sqrt(), im: DVec3::ZERO }))
    }

    /// Returns light of two fields, each given by its parts along two axes.
    pub fn of_fields(fields: [[Complex64; 2]; 2], [x, y]: [DVec3; 2]) -> Self {
        Self::Fields(fields.map(|[a, b]| ElectricField::of([(a, x), (b, y)])))
    }

    #[inline]
    pub fn weight(&self) -> f64 {
        match self {
            Self::Unpolarised(weight) => *weight,
            Self::Fields([a, b]) => (a.power() + b.power()) / 2.0,
        }
    }

    /// Splits light at a surface: returns the light that goes on inside along `onward`, and the weight that is left on the
    /// outer side. Light that enters goes on through the surface; light inside is reflected.
    pub fn split(&self, ray: DVec3, onward: DVec3, normal: DVec3, eta: f64, enters: bool) -> (Self, f64) {
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
        let to = if enters { passing(&surface) } else { (surface.r_s, surface.r_p) };
        let s = across(ray, normal);
        let p = s.cross(ray);
        let inside = fields.map(|f| f.onward(to, s, (ray, onward)));
        let lost = |f: &ElectricField| {
            let part = |r: Complex64, e: Complex64| {
                if surface.is_total() { 0.0 } else { (1.0 - r.norm_sqr()) * e.norm_sqr() }
            };
            part(to.0, f.along(s)) + part(to.1, f.along(p))
        };
        (Self::Fields(inside), (lost(&fields[0]) + lost(&fields[1])) / 2.0)
    }

    /// Returns the light that [`split`](Self::split) leaves on the outer side, going along `outward`.
    pub fn outer(&self, (ray, outward): (DVec3, DVec3), normal: DVec3, eta: f64, enters: bool) -> Self {
        let cos_i = ray.dot(normal).abs();
        let fields = match self {
            Self::Unpolarised(weight) => {
                let reflected = reflectance(cos_i, eta).unwrap_or(1.0);
                let inside = if enters { 1.0 - reflected } else { reflected };
                return Self::Unpolarised(weight * (1.0 - inside));
            }
            Self::Fields(fields) => fields,
        };
        let surface = fresnel(cos_i, eta);
        let to = if enters { (surface.r_s, surface.r_p) } else { passing(&surface) };
        let s = across(ray, normal);
        Self::Fields(fields.map(|f| f.onward(to, s, (ray, outward))))
    }

    /// Returns this light at another weight, which is `factor` times as large.
    pub fn scaled(&self, factor: f64) -> Self {
        match self {
            Self::Unpolarised(weight) => Self::Unpolarised(weight * factor),
            Self::Fields(fields) => {
                let root = factor.sqrt();
                Self::Fields(fields.map(|f| ElectricField { re: f.re * root, im: f.im * root }))
            }
        }
    }
}

/// The sine of the angle between a ray and a facet's normal below which the ray counts as square to the facet: the cross
/// product there is mostly rounding.
const SQUARE_ON: f64 = 1e-9;

/// Returns a unit vector perpendicular to the ray and to the normal; to the ray alone where the two are one line.
fn across(ray: DVec3, normal: DVec3) -> DVec3 {
    let s = ray.cross(normal);
    let length = s.length();
    if length > SQUARE_ON { s / length } else { ray.any_orthonormal_vector() }
}
