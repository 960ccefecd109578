//! What only beams ask of the polarisation of light: means, fields and derivatives.

use crate::coherency::Coherency;
use brillianteer_optics::Fresnel;
use num_complex::Complex64;

impl Coherency {
    /// Light of weight 0.
    pub const NONE: Self = Self { ss: 0.0, pp: 0.0, re: 0.0, im: 0.0 };

    /// Returns unpolarised light of weight 1 after it has entered through a surface, and the weight that the surface
    /// reflects (its glare).
    pub fn entered(fresnel: &Fresnel) -> (Self, f64) {
        let (s, p) = (fresnel.reflectance_s(), fresnel.reflectance_p());
        (Self { ss: (1.0 - s) / 2.0, pp: (1.0 - p) / 2.0, re: 0.0, im: 0.0 }, (s + p) / 2.0)
    }

    /// Returns two fields, each given by its components along s and p, whose mean coherency matrix is this one (its
    /// Cholesky decomposition).
    pub fn fields(&self) -> [[Complex64; 2]; 2] {
        // Rounding may have made the number slightly negative.
        let s = (2.0 * self.ss.max(0.0)).sqrt();
        let p = if s > 0.0 { Complex64::new(self.re, -self.im) * 2.0 / s } else { Complex64::ZERO };
        let p = p * (2.0 * self.pp.max(0.0) / p.norm_sqr()).sqrt().min(1.0);
        let rest = (2.0 * self.pp - p.norm_sqr()).max(0.0).sqrt();
        [[s.into(), p], [Complex64::ZERO, rest.into()]]
    }

    /// Returns the light at a part of the way from this one to another, 0 to 1, in the same axes.
    pub fn between(&self, other: &Self, part: f64) -> Self {
        let mix = |a: f64, b: f64| a + part * (b - a);
        Self {
            ss: mix(self.ss, other.ss),
            pp: mix(self.pp, other.pp),
            re: mix(self.re, other.re),
            im: mix(self.im, other.im),
        }
    }

    /// Returns light of the same polarisation with another weight.
    pub fn scaled_to(&self, weight: f64) -> Self {
        let own = self.weight();
        let by = if own > 0.0 { weight / own } else { 0.0 };
        Self { ss: self.ss * by, pp: self.pp * by, re: self.re * by, im: self.im * by }
    }

    /// Splits the light at a surface: returns the reflected light and the weight of the light that passes.
    pub fn split(&self, fresnel: &Fresnel) -> (Self, f64) {
        let (s, p) = (fresnel.reflectance_s(), fresnel.reflectance_p());
        (self.reflected(fresnel), self.ss * (1.0 - s) + self.pp * (1.0 - p))
    }

    /// Returns the derivatives of a sum by the light (`ss`, `pp`, `re`, `im`) and by cosine and sine, from its
    /// derivatives by the [`turned`](Self::turned) light.
    pub fn pull_back_turned(&self, cos: f64, sin: f64, per: [f64; 4]) -> ([f64; 4], [f64; 2]) {
        let (cc, ss, cs) = (cos * cos, sin * sin, cos * sin);
        let [per_ss, per_pp, per_re, per_im] = per;
        let light = [
            cc * per_ss + ss * per_pp - cs * per_re,
            ss * per_ss + cc * per_pp + cs * per_re,
            2.0 * cs * (per_ss - per_pp) + (cc - ss) * per_re,
            per_im,
        ];
        let per_cc = self.ss * per_ss + self.pp * per_pp + self.re * per_re;
        let per_sin_sq = self.pp * per_ss + self.ss * per_pp - self.re * per_re;
        let per_cs = 2.0 * self.re * (per_ss - per_pp) + (self.pp - self.ss) * per_re;
        (light, [2.0 * cos * per_cc + sin * per_cs, 2.0 * sin * per_sin_sq + cos * per_cs])
    }

    /// Returns the derivatives of a sum by the light, and by the reflectances of s and p and r_s r_p* (real and
    /// imaginary part), from its derivatives by the reflected light and by the weight that passes. See
    /// [`split`](Self::split).
    pub fn pull_back_split(&self, fresnel: &Fresnel, per: [f64; 4], per_weight: f64) -> ([f64; 4], [f64; 4]) {
        let (s, p) = (fresnel.reflectance_s(), fresnel.reflectance_p());
        let cross = fresnel.r_s * fresnel.r_p.conj();
        let [per_ss, per_pp, per_re, per_im] = per;
        let light = [
            per_ss * s + per_weight * (1.0 - s),
            per_pp * p + per_weight * (1.0 - p),
            per_re * cross.re + per_im * cross.im,
            per_im * cross.re - per_re * cross.im,
        ];
        let surface = [
            (per_ss - per_weight) * self.ss,
            (per_pp - per_weight) * self.pp,
            per_re * self.re + per_im * self.im,
            per_im * self.re - per_re * self.im,
        ];
        (light, surface)
    }
}
