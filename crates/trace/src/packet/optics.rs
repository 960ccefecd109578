//! Snell's law, Fresnel's formulae and polarisation in lanes, in single precision. These are the twins of
//! `crates/optics/src` and of `shaders/optics.wgsl`, where the sources are named.

use super::lanes::{Lanes, Mask, Vectors};
use pulp::Simd;

/// The sine of the angle between a ray and a facet's normal below which the ray counts as perpendicular to the facet.
const SQUARE_ON: f32 = 1e-4;

/// The least cosine by which a change is divided.
pub(super) const LEAST_COS: f32 = 1e-4;

/// The amplitudes of reflection of s- and p-polarised light, each as its real and imaginary part.
#[derive(Clone, Copy)]
pub(super) struct Reflection<S: Simd> {
    s: [Lanes<S>; 2],
    p: [Lanes<S>; 2],
    /// The cosine of the angle of refraction; 0 where reflection is total.
    pub cos_t: Lanes<S>,
    /// The lanes in which a part of the light passes the surface.
    pub is_partial: Mask<S>,
}

/// The light of rays: its coherency matrix along the axes `s` and direction × `s`.
#[derive(Clone, Copy)]
pub(super) struct PacketLight<T> {
    pub ss: T,
    pub pp: T,
    pub re: T,
    pub im: T,
}

/// Directions of light that meets a surface, and their changes over the range that each ray represents.
#[derive(Clone, Copy)]
pub(super) struct Incidence<S: Simd> {
    pub direction: Vectors<S>,
    /// The unit normal on the side that the light comes from.
    pub normal: Vectors<S>,
    /// The cosine of the angle of incidence.
    pub cos_i: Lanes<S>,
    /// The change of the direction.
    pub of_direction: Vectors<S>,
    /// The change of the normal; `None` on flat facets.
    pub of_normal: Option<Vectors<S>>,
}

impl<S: Simd> Reflection<S> {
    /// Returns the coefficients for light that meets a surface at an angle of cosine `cos_i`; `eta` is the incident
    /// index over the transmitted index.
    #[inline(always)]
    pub fn of(cos_i: Lanes<S>, eta: Lanes<S>) -> Self {
        let (zero, one) = (cos_i.all(0.0), cos_i.all(1.0));
        let cos_i = cos_i.max(zero).min(one);
        let normal_part = eta * cos_i;
        let squared = (one - eta) * (one + eta) + normal_part * normal_part;
        let is_partial = squared.is_positive();
        let root = squared.abs().sqrt();
        let [s, p] = [[normal_part, root], [cos_i, eta * root]];
        Self {
            s: amplitude(is_partial, s),
            p: amplitude(is_partial, p),
            cos_t: is_partial.select(root, zero),
            is_partial,
        }
    }

    /// Returns the reflected shares of the power of s- and of p-polarised light.
    #[inline(always)]
    fn powers(&self) -> [Lanes<S>; 2] {
        let one = self.cos_t.all(1.0);
        let [s, p] = [self.s[0] * self.s[0], self.p[0] * self.p[0]];
        [self.is_partial.select(s, one), self.is_partial.select(p, one)]
    }
}

/// Returns (a - b) / (a + b) where a part of the light passes, else (a - ib) / (a + ib).
#[inline(always)]
fn amplitude<S: Simd>(is_partial: Mask<S>, [a, b]: [Lanes<S>; 2]) -> [Lanes<S>; 2] {
    let (tiny, two) = (a.all(1e-30), a.all(2.0));
    let (aa, bb) = (a * a, b * b);
    let divisor = is_partial.select(a + b, aa + bb).max(tiny);
    let per = a.all(1.0) / divisor;
    let re = is_partial.select(a - b, aa - bb) * per;
    let im = is_partial.select(a.all(0.0), -(two * a * b)) * per;
    [re, im]
}

impl<S: Simd> PacketLight<Lanes<S>> {
    #[inline(always)]
    pub fn weight(&self) -> Lanes<S> {
        self.ss + self.pp
    }

    /// Returns unpolarised light of this weight.
    #[inline(always)]
    pub fn unpolarised(weight: Lanes<S>) -> Self {
        let (half, none) = (weight * weight.all(0.5), weight.all(0.0));
        Self { ss: half, pp: half, re: none, im: none }
    }

    /// Returns the light in axes that are turned from s toward p by the angle with this cosine and sine.
    #[inline(always)]
    pub fn turned(self, cos: Lanes<S>, sin: Lanes<S>) -> Self {
        let (cc, ss, cs) = (cos * cos, sin * sin, cos * sin);
        let twice = cs * self.re * cs.all(2.0);
        Self {
            ss: cc * self.ss + ss * self.pp + twice,
            pp: ss * self.ss + cc * self.pp - twice,
            re: (cc - ss) * self.re + cs * (self.pp - self.ss),
            im: self.im,
        }
    }

    /// Returns the light that a surface reflects.
    #[inline(always)]
    pub fn reflected(self, by: &Reflection<S>) -> Self {
        let [power_s, power_p] = by.powers();
        let ([s_re, s_im], [p_re, p_im]) = (by.s, by.p);
        let (re, im) = (s_re * p_re + s_im * p_im, s_im * p_re - s_re * p_im);
        Self {
            ss: self.ss * power_s,
            pp: self.pp * power_p,
            re: self.re * re - self.im * im,
            im: self.re * im + self.im * re,
        }
    }

    /// Returns the light that passes a surface. Refraction shifts no phase.
    #[inline(always)]
    pub fn transmitted(self, by: &Reflection<S>) -> Self {
        let (zero, one) = (self.ss.all(0.0), self.ss.all(1.0));
        let [power_s, power_p] = by.powers();
        let (s, p) = ((one - power_s).max(zero), (one - power_p).max(zero));
        let both = (s * p).sqrt();
        Self { ss: self.ss * s, pp: self.pp * p, re: self.re * both, im: self.im * both }
    }
}

impl<S: Simd> Incidence<S> {
    /// Returns the direction of the reflected rays.
    #[inline(always)]
    pub fn reflected(&self) -> Vectors<S> {
        let reflected = self.direction + self.normal * (self.cos_i + self.cos_i);
        // One Newton step toward unit length prevents the drift of a chain of bounces.
        let (half, three_halves) = (self.cos_i.all(0.5), self.cos_i.all(1.5));
        reflected * (three_halves - half * reflected.dot(reflected))
    }

    /// Returns the direction of the refracted rays.
    #[inline(always)]
    pub fn refracted(&self, eta: Lanes<S>, cos_t: Lanes<S>) -> Vectors<S> {
        self.direction * eta + self.normal * (eta * self.cos_i - cos_t)
    }

    /// Returns the change of the reflected direction.
    #[inline(always)]
    pub fn reflected_change(&self) -> Vectors<S> {
        let Self { direction, normal, of_direction, .. } = *self;
        let across = of_direction.dot(normal);
        match self.of_normal {
            None => of_direction - normal * (across + across),
            Some(of_normal) => {
                let turn = across + direction.dot(of_normal);
                let along = direction.dot(normal);
                of_direction - normal * (turn + turn) - of_normal * (along + along)
            }
        }
    }

    /// Returns the change of the refracted direction, where eta changes by `of_eta`.
    #[inline(always)]
    pub fn refracted_change(&self, eta: Lanes<S>, of_eta: Lanes<S>, cos_t: Lanes<S>) -> Vectors<S> {
        let Self { direction, normal, cos_i, of_direction, of_normal } = *self;
        let mut of_cos_i = -of_direction.dot(normal);
        if let Some(of_normal) = of_normal {
            of_cos_i = of_cos_i - direction.dot(of_normal);
        }
        let (one, least) = (eta.all(1.0), eta.all(LEAST_COS));
        let square = one - cos_i * cos_i;
        let of_cos_t = eta * (eta * cos_i * of_cos_i - square * of_eta) / cos_t.max(least);
        let fanned =
            direction * of_eta + of_direction * eta + normal * (of_eta * cos_i + eta * of_cos_i - of_cos_t);
        match of_normal {
            None => fanned,
            Some(of_normal) => fanned + of_normal * (eta * cos_i - cos_t),
        }
    }
}

/// Returns the unit axes perpendicular to rays and to the facets' normals. Where a ray is perpendicular to its facet,
/// the axis is `otherwise`, made perpendicular to the ray.
#[inline(always)]
pub(super) fn s_axis<S: Simd>(
    direction: Vectors<S>,
    normal: Vectors<S>,
    otherwise: Vectors<S>,
) -> Vectors<S> {
    let across = direction.cross(normal);
    let square = across.dot(across);
    let is_clear = square.all(SQUARE_ON * SQUARE_ON).less(square);
    // The axis is made perpendicular to this ray, so that the axes do not drift.
    let kept = otherwise - direction * direction.dot(otherwise);
    let axis = Vectors([
        is_clear.select(across[0], kept[0]),
        is_clear.select(across[1], kept[1]),
        is_clear.select(across[2], kept[2]),
    ]);
    axis * (square.all(1.0) / axis.dot(axis).max(square.all(1e-12)).sqrt())
}
