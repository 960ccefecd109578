//! The polarisation of a beam that began unpolarised.

use crate::optics::Fresnel;

/// The coherency matrix J J† / 2 of a beam with Jones matrix J (Born & Wolf, Principles of Optics, 7th ed., §10.9), along s
/// (perpendicular to the plane of incidence) and p = direction × s. Its trace is the beam's weight.
///
/// For light that begins unpolarised these four numbers say all that J does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Coherency {
    ss: f64,
    pp: f64,
    /// Real and imaginary part of the s p* element.
    re: f64,
    im: f64,
}

impl Coherency {
    /// Returns unpolarised light of weight 1 after it has entered through a surface, and the weight that the surface
    /// reflects (its glare).
    pub fn entered(fresnel: &Fresnel) -> (Self, f64) {
        let (s, p) = (fresnel.reflectance_s(), fresnel.reflectance_p());
        (Self { ss: (1.0 - s) / 2.0, pp: (1.0 - p) / 2.0, re: 0.0, im: 0.0 }, (s + p) / 2.0)
    }

    /// Returns the beam's weight.
    pub fn weight(&self) -> f64 {
        self.ss + self.pp
    }

    /// Returns light of the same weight without polarisation.
    pub fn unpolarised(&self) -> Self {
        let half = self.weight() / 2.0;
        Self { ss: half, pp: half, re: 0.0, im: 0.0 }
    }

    /// Returns the light in axes turned from s toward p by the angle whose cosine and sine are given.
    pub fn turned(&self, cos: f64, sin: f64) -> Self {
        let (cc, ss, cs) = (cos * cos, sin * sin, cos * sin);
        Self {
            ss: cc * self.ss + ss * self.pp + 2.0 * cs * self.re,
            pp: ss * self.ss + cc * self.pp - 2.0 * cs * self.re,
            re: (cc - ss) * self.re + cs * (self.pp - self.ss),
            im: self.im,
        }
    }

    /// Splits the light at a surface: returns the reflected light and the weight of the light that passes.
    pub fn split(&self, fresnel: &Fresnel) -> (Self, f64) {
        let (s, p) = (fresnel.reflectance_s(), fresnel.reflectance_p());
        let cross = fresnel.r_s * fresnel.r_p.conj();
        let reflected = Self {
            ss: self.ss * s,
            pp: self.pp * p,
            re: self.re * cross.re - self.im * cross.im,
            im: self.re * cross.im + self.im * cross.re,
        };
        (reflected, self.ss * (1.0 - s) + self.pp * (1.0 - p))
    }
}
