//! A ray that represents a band of wavelengths and a stretch of its pixel, in any number type, and what surfaces make of
//! it. Rays in f64 and packets in f32 share these formulae; `shaders/trace.wgsl` is their twin.

use brillianteer_optics::{Incidence, Real, Vector, reflect, refract};
use glam::DVec3;

/// A ray from the eye, between two facets, or away from a stone. It includes its change over the range that it
/// represents: the wavelengths of a band, and a stretch of its pixel
/// ([`SamplePass::footprint`](super::sampling::SamplePass::footprint)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DispersedRay<V = DVec3> {
    /// The point where the ray begins.
    pub origin: V,
    /// The direction in which the ray travels, of length 1.
    pub direction: V,
    /// The change of the direction from one end of the range that the ray represents to the other.
    pub fan: V,
    /// The displacement of the origin from one end of that range to the other.
    pub shift: V,
}

/// The point where a ray meets a surface, with its change over the range that the ray represents.
pub(crate) struct Arrival<V: Vector> {
    pub point: V,
    /// The unit normal at the point.
    pub normal: V,
    /// The displacement of the point.
    pub shift: V,
    /// The change of the normal; `None` where the surface is flat.
    pub of_normal: Option<V>,
}

/// The refraction of a ray.
pub(crate) struct Refraction<N> {
    /// The incident index over the transmitted one, and its change over the range that the ray represents.
    pub eta: [N; 2],
    /// The cosines of the angles of incidence and of refraction.
    pub cosines: (N, N),
}

impl<V: Vector> Arrival<V> {
    /// Returns the same arrival with the normal on the other side.
    #[inline(always)]
    pub fn turned_over(&self) -> Self {
        let Self { point, normal, shift, of_normal } = *self;
        #[expect(
            clippy::manual_map,
            reason = "closures would not be compiled for a processor's widest instructions"
        )]
        let of_normal = match of_normal {
            Some(of_normal) => Some(-of_normal),
            None => None,
        };
        Self { point, normal: -normal, shift, of_normal }
    }
}

impl<V: Vector> DispersedRay<V> {
    /// Returns the displacement, along a surface with this normal, of the point where the ray meets it at this distance.
    #[inline(always)]
    pub(crate) fn along_surface(&self, distance: V::Real, normal: V) -> V {
        let by = self.shift + self.fan * distance;
        let speed = self.direction.dot(normal);
        let divisor = speed.abs().max(speed.constant(V::Real::LEAST_COS)).times_sign_of(speed);
        (by - self.direction * (normal.dot(by) / divisor)).limited()
    }

    /// Returns the ray that a surface reflects. The arrival's normal is on the ray's side, and `cos_i` is the cosine of
    /// the angle between them. Where `is_fanned` is false, the ray has no fan and stays without one.
    #[inline(always)]
    pub(crate) fn reflected(&self, at: &Arrival<V>, cos_i: V::Real, is_fanned: bool) -> Self {
        let direction = reflect(self.direction, at.normal, cos_i);
        let fan = if is_fanned { self.incidence(at, cos_i).reflected_change() } else { self.fan };
        Self { origin: at.point, direction, fan, shift: at.shift }
    }

    /// Returns the ray that a surface refracts, with the arguments of [`reflected`](Self::reflected).
    #[inline(always)]
    pub(crate) fn refracted(&self, at: &Arrival<V>, into: &Refraction<V::Real>, is_fanned: bool) -> Self {
        let Refraction { eta: [eta, of_eta], cosines } = *into;
        let (cos_i, cos_t) = cosines;
        let direction = refract(self.direction, at.normal, eta, cosines);
        let fan =
            if is_fanned { self.incidence(at, cos_i).refracted_change(eta, of_eta, cos_t) } else { self.fan };
        Self { origin: at.point, direction, fan, shift: at.shift }
    }

    #[inline(always)]
    fn incidence(&self, at: &Arrival<V>, cos_i: V::Real) -> Incidence<V> {
        let Arrival { normal, of_normal, .. } = *at;
        Incidence { direction: self.direction, normal, cos_i, of_direction: self.fan, of_normal }
    }
}

impl DispersedRay {
    /// Returns a ray that represents one wavelength and one point of the pixel.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, fan: DVec3::ZERO, shift: DVec3::ZERO }
    }

    /// Returns whether the ray changes at all over the range that it represents.
    pub fn is_fanned(&self) -> bool {
        self.fan != DVec3::ZERO || self.shift != DVec3::ZERO
    }

    /// Returns the same ray with its origin moved ahead by this distance.
    pub fn ahead(&self, distance: f64) -> Self {
        Self {
            origin: self.origin + self.direction * distance,
            shift: self.shift + self.fan * distance,
            ..*self
        }
    }
}
