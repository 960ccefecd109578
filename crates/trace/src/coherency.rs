//! The polarisation of light that began unpolarised, in any number type: beams follow it in f64, packets in f32.

use brillianteer_optics::{Fresnel, Real, Truth, Vector};

/// The coherency matrix J J† / 2 of light with Jones matrix J (Born & Wolf, Principles of Optics, 7th ed., §10.9), along s
/// (perpendicular to the plane of incidence) and p = direction × s. Its trace is the light's weight.
///
/// For light that begins unpolarised, these four numbers describe everything that J describes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Coherency<N = f64> {
    pub ss: N,
    pub pp: N,
    /// The real and imaginary part of the s p* element.
    pub re: N,
    pub im: N,
}

impl<N: Real> Coherency<N> {
    /// Returns the light's weight.
    #[inline(always)]
    pub fn weight(&self) -> N {
        self.ss + self.pp
    }

    /// Returns unpolarised light of this weight.
    #[inline(always)]
    pub fn of_weight(weight: N) -> Self {
        let (half, none) = (weight * weight.constant(0.5), weight.constant(0.0));
        Self { ss: half, pp: half, re: none, im: none }
    }

    /// Returns light of the same weight without polarisation.
    #[inline(always)]
    pub fn unpolarised(&self) -> Self {
        Self::of_weight(self.weight())
    }

    /// Returns this share of the light.
    #[inline(always)]
    pub fn times(&self, share: N) -> Self {
        Self { ss: self.ss * share, pp: self.pp * share, re: self.re * share, im: self.im * share }
    }

    /// Returns the light in axes that are turned from s toward p by the angle with this cosine and sine.
    #[inline(always)]
    pub fn turned(&self, cos: N, sin: N) -> Self {
        let (cc, ss, cs) = (cos * cos, sin * sin, cos * sin);
        let twice = (cs + cs) * self.re;
        Self {
            ss: cc * self.ss + ss * self.pp + twice,
            pp: ss * self.ss + cc * self.pp - twice,
            re: (cc - ss) * self.re + cs * (self.pp - self.ss),
            im: self.im,
        }
    }

    /// Returns the light of a ray along the axes that belong to `s`, where `before` is its axis s so far.
    #[inline(always)]
    pub fn turned_to<V: Vector<Real = N>>(&self, s: V, before: V, direction: V) -> Self {
        self.turned(before.dot(s), direction.cross(before).dot(s))
    }

    /// Returns the light that a surface reflects.
    #[inline(always)]
    pub fn reflected(&self, by: &Fresnel<N>) -> Self {
        let (s, p) = (by.r_s, by.r_p);
        let (re, im) = (s.re * p.re + s.im * p.im, s.im * p.re - s.re * p.im);
        Self {
            ss: self.ss * by.reflectance_s(),
            pp: self.pp * by.reflectance_p(),
            re: self.re * re - self.im * im,
            im: self.re * im + self.im * re,
        }
    }

    /// Returns the light that passes a surface. Refraction shifts no phase.
    #[inline(always)]
    pub fn transmitted(&self, by: &Fresnel<N>) -> Self {
        let (zero, one) = (self.ss.constant(0.0), self.ss.constant(1.0));
        let (s, p) = ((one - by.reflectance_s()).max(zero), (one - by.reflectance_p()).max(zero));
        let both = (s * p).sqrt();
        Self { ss: self.ss * s, pp: self.pp * p, re: self.re * both, im: self.im * both }
    }
}

/// Returns the unit axis s, perpendicular to a ray and to a facet's normal. Where the ray is perpendicular to the facet,
/// the axis is `otherwise`; lanes make it perpendicular to the ray, so that axes in single precision do not drift.
#[inline(always)]
pub(crate) fn s_axis<V: Vector>(direction: V, normal: V, otherwise: V) -> V {
    let across = direction.cross(normal);
    let square = across.dot(across);
    let is_clear = square.constant(V::Real::SQUARE_ON * V::Real::SQUARE_ON).less(square);
    match is_clear.of_single() {
        Some(true) => across.over(square.sqrt()),
        Some(false) => otherwise,
        None => {
            let kept = otherwise - direction * direction.dot(otherwise);
            let axis = V::select(is_clear, across, kept);
            axis.over(axis.dot(axis).max(square.constant(1e-12)).sqrt())
        }
    }
}
