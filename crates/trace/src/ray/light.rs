//! The light of a ray, and how a surface splits it.

use brillianteer_optics::{Real, fresnel, reflectance};
use glam::DVec3;
use num_complex::Complex64;

/// The light of a ray between two facets: a weight, or the two fields into which the eye's two polarisations have
/// turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PathLight {
    Unpolarised(f64),
    Fields(ElectricFields),
}

/// Two complex electric fields, each given by its components along two axes: s, and p = s × the ray's direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ElectricFields {
    /// A unit vector perpendicular to the ray.
    s: DVec3,
    parts: [[Complex64; 2]; 2],
    /// The mean power of both fields.
    weight: f64,
}

/// The two parts into which a surface splits light. The axis s of both is that of the surface.
pub(crate) struct SplitLight {
    pub reflected: PathLight,
    pub passed: PathLight,
}

impl PathLight {
    /// Returns the light of a ray from the eye, with equal parts of all polarisations.
    pub fn of_eye(direction: DVec3, weight: f64, is_polarised: bool) -> Self {
        if !is_polarised {
            return Self::Unpolarised(weight);
        }
        let (one, none) = (Complex64::from(weight.sqrt()), Complex64::ZERO);
        let (s, parts) = (direction.any_orthonormal_vector(), [[one, none], [none, one]]);
        Self::Fields(ElectricFields { s, parts, weight })
    }

    /// Returns light of two fields, each given by its components along s and along the ray's direction × s.
    pub fn of_fields(fields: [[Complex64; 2]; 2], s: DVec3) -> Self {
        let parts = fields.map(|[s, p]| [s, -p]);
        let [of_s, of_p] = powers(&parts);
        Self::Fields(ElectricFields { s, parts, weight: of_s + of_p })
    }

    #[inline]
    pub fn weight(&self) -> f64 {
        match self {
            Self::Unpolarised(weight) => *weight,
            Self::Fields(fields) => fields.weight,
        }
    }

    /// Splits light at a surface. The function is always inlined, so that the light that passes is computed only
    /// where it is used.
    #[inline(always)]
    pub fn split(&self, ray: DVec3, normal: DVec3, eta: f64) -> SplitLight {
        let cos_i = ray.dot(normal).abs();
        match self {
            Self::Unpolarised(weight) => {
                let reflected = reflectance(cos_i, eta).unwrap_or(1.0);
                SplitLight {
                    reflected: Self::Unpolarised(weight * reflected),
                    passed: Self::Unpolarised(weight * (1.0 - reflected)),
                }
            }
            Self::Fields(fields) => fields.turned(ray, normal).split(cos_i, eta),
        }
    }

    /// Returns this light at another weight, which is `factor` times as large.
    pub fn scaled(&self, factor: f64) -> Self {
        match self {
            Self::Unpolarised(weight) => Self::Unpolarised(weight * factor),
            Self::Fields(fields) => {
                let root = factor.sqrt();
                let parts = fields.parts.map(|field| field.map(|part| part * root));
                Self::Fields(ElectricFields { parts, weight: fields.weight * factor, ..*fields })
            }
        }
    }

    /// Returns light of the same polarisation at this weight. Light without weight stays as it is.
    pub fn scaled_to(&self, weight: f64) -> Self {
        let own = self.weight();
        if own > 0.0 && own != weight { self.scaled(weight / own) } else { *self }
    }

    /// Returns the light in another frame, into which `carry` rotates vectors.
    pub fn carried(&self, carry: impl Fn(DVec3) -> DVec3) -> Self {
        match self {
            Self::Unpolarised(weight) => Self::Unpolarised(*weight),
            Self::Fields(fields) => Self::Fields(ElectricFields { s: carry(fields.s), ..*fields }),
        }
    }
}

#[cfg(test)]
impl PathLight {
    /// Returns the light with other fields, each given by its components along s and along s × the ray's direction.
    pub fn of_other_fields(&self, other: impl Fn([[Complex64; 2]; 2]) -> [[Complex64; 2]; 2]) -> Self {
        match self {
            Self::Unpolarised(weight) => Self::Unpolarised(*weight),
            Self::Fields(fields) => Self::Fields(ElectricFields { parts: other(fields.parts), ..*fields }),
        }
    }
}

impl ElectricFields {
    /// Returns the same fields with an axis s that is also perpendicular to a facet's normal.
    #[inline(always)]
    fn turned(&self, ray: DVec3, normal: DVec3) -> Self {
        let across = ray.cross(normal);
        let length = across.length();
        if length <= f64::SQUARE_ON {
            return *self;
        }
        let s = across / length;
        let (cos, sin) = (self.s.dot(s), self.s.cross(ray).dot(s));
        let parts = self.parts.map(|[a, b]| [a * cos + b * sin, b * cos - a * sin]);
        Self { s, parts, ..*self }
    }

    /// Splits fields at a surface. Their axis s is perpendicular to the surface's normal.
    #[inline(always)]
    fn split(&self, cos_i: f64, eta: f64) -> SplitLight {
        let surface = fresnel(cos_i, eta);
        let [of_s, of_p] = powers(&self.parts);
        let (r_s, r_p) = (surface.reflectance_s(), surface.reflectance_p());
        let (t_s, t_p) = (surface.transmission_s(), surface.transmission_p());
        SplitLight {
            reflected: PathLight::Fields(Self {
                parts: self.parts.map(|[a, b]| [surface.r_s * a, surface.r_p * b]),
                weight: r_s * of_s + r_p * of_p,
                ..*self
            }),
            passed: PathLight::Fields(Self {
                parts: self.parts.map(|[a, b]| [a * t_s, b * t_p]),
                weight: (1.0 - r_s) * of_s + (1.0 - r_p) * of_p,
                ..*self
            }),
        }
    }
}

/// Returns the mean power of two fields along s and along p.
#[inline]
fn powers([a, b]: &[[Complex64; 2]; 2]) -> [f64; 2] {
    [0, 1].map(|axis| (a[axis].norm_sqr() + b[axis].norm_sqr()) / 2.0)
}
