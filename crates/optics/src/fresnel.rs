//! Fresnel's formulae: the share of light that a surface reflects, and the phase of the reflected light.
//!
//! Source: M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999): §1.5.2, eq. 21 for the amplitudes,
//! §1.5.4, eq. 60 for the phases of total reflection. Their convention is kept:
//! - time runs as exp(-i omega t), so an evanescent wave has cos_t = +i sqrt(eta² sin² - 1);
//! - s is along e_s, across the plane of incidence, the same for the incident, the reflected and the transmitted wave; p of
//!   *each* wave is along e_s × (its own direction of travel). Hence r_p = -r_s at normal incidence, where the two p axes
//!   point opposite ways.

use super::real::{Real, Truth};
use super::snell::{cos_t_squared, cos_transmitted, is_refracted};
use num_complex::Complex;

/// The amplitude reflection coefficients of light that meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fresnel<N = f64> {
    /// The reflected over the incident amplitude, with the electric field across the plane of incidence.
    pub r_s: Complex<N>,
    /// The reflected over the incident amplitude, with the electric field in the plane of incidence.
    pub r_p: Complex<N>,
    /// The cosine of the angle of refraction; 0 where reflection is total.
    cos_t: N,
}

impl<N: Real> Fresnel<N> {
    /// Returns the cosine of the angle of refraction; 0 where reflection is total.
    #[inline(always)]
    pub fn cos_t_or_zero(&self) -> N {
        self.cos_t
    }

    /// Returns the share of s-polarised power that is reflected, 0..=1; the rest is transmitted.
    #[inline(always)]
    pub fn reflectance_s(&self) -> N {
        self.power(self.r_s)
    }

    /// Returns the share of p-polarised power that is reflected, 0..=1; the rest is transmitted.
    #[inline(always)]
    pub fn reflectance_p(&self) -> N {
        self.power(self.r_p)
    }

    /// Returns |r|², but exactly 1 in total reflection. Only total reflection has complex amplitudes.
    #[inline(always)]
    fn power(&self, r: Complex<N>) -> N {
        let zero = self.cos_t.constant(0.0);
        zero.less(self.cos_t).select(r.re * r.re, zero.constant(1.0))
    }
}

impl Fresnel {
    /// Returns the cosine of the angle of refraction; `None` where reflection is total.
    #[inline]
    pub fn cos_t(&self) -> Option<f64> {
        (self.cos_t > 0.0).then_some(self.cos_t)
    }

    /// Returns the share of unpolarised power that is reflected, 0..=1; the rest is transmitted.
    #[inline]
    pub fn reflectance(&self) -> f64 {
        0.5 * (self.reflectance_s() + self.reflectance_p())
    }

    /// Returns the transmitted amplitude of s-polarised light, normalised to flux: its square is exactly 1 -
    /// [`Self::reflectance_s`].
    ///
    /// The amplitude is real and not negative, as in Born & Wolf's eq. 20: refraction shifts no phase.
    #[inline]
    pub fn transmission_s(&self) -> f64 {
        (1.0 - self.reflectance_s()).sqrt()
    }

    /// Returns the transmitted amplitude of p-polarised light, normalised to flux as [`Self::transmission_s`] is.
    #[inline]
    pub fn transmission_p(&self) -> f64 {
        (1.0 - self.reflectance_p()).sqrt()
    }

    /// Returns whether the surface reflects all light.
    #[inline]
    pub fn is_total(&self) -> bool {
        self.cos_t <= 0.0
    }
}

/// Returns Fresnel's coefficients for light that meets a surface at an angle of cosine `cos_i`.
///
/// `cos_i` is in 0..=1; values slightly beyond, from rounding, are clamped. `eta` is the incident index / the
/// transmitted index, > 0. Exactly at the critical angle, and at grazing incidence, all light is reflected.
#[inline(always)]
pub fn fresnel<N: Real>(cos_i: N, eta: N) -> Fresnel<N> {
    let zero = cos_i.constant(0.0);
    let cos_i = cos_i.clamped();
    let squared = cos_t_squared(cos_i, eta);
    let is_partial = is_refracted(squared);
    // In total reflection the root is the decay of the evanescent wave.
    let root = is_partial.select(squared, (-squared).max(zero)).sqrt();
    Fresnel {
        r_s: amplitude(is_partial, eta * cos_i, root),
        r_p: amplitude(is_partial, cos_i, eta * root),
        cos_t: is_partial.select(root, zero),
    }
}

/// Returns the amplitude of partial or of total reflection.
#[inline(always)]
fn amplitude<N: Real>(is_partial: N::Truth, a: N, b: N) -> Complex<N> {
    match is_partial.of_single() {
        Some(true) => partial(a, b),
        Some(false) => total(a, b),
        None => {
            let (some, all) = (partial(a, b), total(a, b));
            Complex::new(is_partial.select(some.re, all.re), is_partial.select(some.im, all.im))
        }
    }
}

/// Returns the reflected share of unpolarised power; `None` where reflection is total.
///
/// This is [`Fresnel::reflectance`] without complex numbers, with one square root and one division, for the tracers'
/// inner loops.
#[inline]
pub fn reflectance(cos_i: f64, eta: f64) -> Option<f64> {
    let cos_i = cos_i.clamp(0.0, 1.0);
    let cos_t = cos_transmitted(cos_i, eta)?;
    let (s_sum, p_sum) = (eta * cos_i + cos_t, cos_i + eta * cos_t);
    let per_both = 1.0 / (s_sum * p_sum);
    let r_s = (eta * cos_i - cos_t) * p_sum * per_both;
    let r_p = (cos_i - eta * cos_t) * s_sum * per_both;
    Some(0.5 * (r_s * r_s + r_p * r_p))
}

/// Returns (a - b) / (a + b): Born & Wolf eq. 21 divided by the transmitted index.
#[inline(always)]
fn partial<N: Real>(a: N, b: N) -> Complex<N> {
    Complex::new((a - b).over(a + b), a.constant(0.0))
}

/// Returns (a - ib) / (a + ib), of modulus 1 and phase -2 atan(b / a), which is Born & Wolf eq. 60.
#[inline(always)]
fn total<N: Real>(a: N, b: N) -> Complex<N> {
    let zero = a.constant(0.0);
    let square = a * a + b * b;
    // Equal indices at grazing incidence: the limit is the same from a denser and from a rarer side.
    let is_there = zero.less(square);
    Complex::new(
        is_there.select((a * a - b * b).over(square), zero.constant(-1.0)),
        is_there.select((-(a + a) * b).over(square), zero),
    )
}

#[cfg(test)]
mod tests {
    use super::super::snell::{brewster_angle, critical_angle, reflect, refract};
    use super::*;
    use glam::DVec3;
    use std::f64::consts::{FRAC_PI_2, PI};

    const ETAS: [f64; 8] = [0.3, 1.0 / 2.4175, 0.75, 1.0, 1.000_000_1, 1.33, 2.4175, 2.9];

    fn for_each_case(mut check: impl FnMut(f64, f64)) {
        for eta in ETAS {
            for step in 0..=1000 {
                check((FRAC_PI_2 * f64::from(step) / 1000.0).cos(), eta);
            }
        }
    }

    /// Returns the transmitted flux T by Born & Wolf eq. 20 and the flux ratio of §1.5.3, computed without r.
    fn transmitted_flux(cos_i: f64, cos_t: f64, eta: f64) -> (f64, f64) {
        let t_s = 2.0 * eta * cos_i / (eta * cos_i + cos_t);
        let t_p = 2.0 * eta * cos_i / (cos_i + eta * cos_t);
        let flux = cos_t / (eta * cos_i);
        (flux * t_s * t_s, flux * t_p * t_p)
    }

    #[test]
    fn reflected_and_transmitted_flux_add_up_to_one() {
        for_each_case(|cos_i, eta| {
            let f = fresnel(cos_i, eta);
            let Some(cos_t) = f.cos_t() else { return };
            let (t_s, t_p) = transmitted_flux(cos_i, cos_t, eta);
            assert!((f.reflectance_s() + t_s - 1.0).abs() < 1e-14);
            assert!((f.reflectance_p() + t_p - 1.0).abs() < 1e-14);
            assert!((f.transmission_s().powi(2) - t_s).abs() < 1e-14);
            assert!((f.transmission_p().powi(2) - t_p).abs() < 1e-14);
        });
    }

    #[test]
    fn tangential_fields_are_continuous_across_the_surface() {
        // Both fields of both polarisations are made from the vectors that the module names, so that the test fixes the
        // signs.
        let n = DVec3::Z;
        for_each_case(|cos_i, eta| {
            let f = fresnel(cos_i, eta);
            if f.is_total() || cos_i < 1e-3 {
                return;
            }
            let d = DVec3::new((1.0 - cos_i * cos_i).max(0.0).sqrt(), 0.0, -cos_i);
            let cos_t = f.cos_t().expect("not total");
            let (r, t) = (reflect(d, n, -n.dot(d)), refract(d, n, eta, (-n.dot(d), cos_t)));
            let e_s = DVec3::Y;
            let t_s = 2.0 * eta * cos_i / (eta * cos_i - n.dot(t));
            let t_p = 2.0 * eta * cos_i / (cos_i - eta * n.dot(t));
            // B is (index) d × E; the incident index is eta, the transmitted one 1.
            for (e_i, e_r, e_t) in [
                (e_s, f.r_s.re * e_s, t_s * e_s),
                (e_s.cross(d), f.r_p.re * e_s.cross(r), t_p * e_s.cross(t)),
            ] {
                let electric = e_i + e_r - e_t;
                let magnetic = eta * (d.cross(e_i) + r.cross(e_r)) - t.cross(e_t);
                assert!(
                    n.cross(electric).length() < 1e-12,
                    "E jumps by {electric} at cos_i {cos_i}, eta {eta}"
                );
                assert!(
                    n.cross(magnetic).length() < 1e-12,
                    "B jumps by {magnetic} at cos_i {cos_i}, eta {eta}"
                );
            }
        });
    }

    #[test]
    fn no_p_light_is_reflected_at_brewsters_angle() {
        for eta in ETAS {
            let f = fresnel(brewster_angle(eta).cos(), eta);
            assert!(f.r_p.norm() < 1e-14, "r_p = {} at eta {eta}", f.r_p);
        }
    }

    #[test]
    fn both_ways_through_a_surface_reflect_the_same_share() {
        for_each_case(|cos_i, eta| {
            let there = fresnel(cos_i, eta);
            let Some(cos_t) = there.cos_t() else { return };
            let back = fresnel(cos_t, 1.0 / eta);
            // Rounding of a cosine c moves cos² by 1e-16, so the other cosine by 1e-16 / c.
            let slack = 1e-14 / cos_i.min(cos_t);
            assert!((there.r_s + back.r_s).norm() < slack && (there.r_p + back.r_p).norm() < slack);
        });
    }

    #[test]
    fn total_reflection_loses_nothing() {
        for_each_case(|cos_i, eta| {
            let f = fresnel(cos_i, eta);
            if f.is_total() {
                assert!((f.r_s.norm() - 1.0).abs() < 1e-15 && (f.r_p.norm() - 1.0).abs() < 1e-15);
                assert_eq!((f.reflectance(), f.transmission_s(), f.transmission_p()), (1.0, 0.0, 0.0));
            }
        });
    }

    #[test]
    fn phases_of_total_reflection_match_the_closed_form() {
        // Born & Wolf eq. 60 with n = 1 / eta, and their eq. 61 for the difference.
        for (eta, step) in
            [1.54, 2.4175, 2.9].into_iter().flat_map(|eta| (1..90).map(move |step| (eta, step)))
        {
            let angle = f64::from(step).to_radians();
            let (sin, cos) = angle.sin_cos();
            let Some(root) = (sin * sin > 1.0 / (eta * eta)).then(|| (sin * sin - 1.0 / (eta * eta)).sqrt())
            else {
                continue;
            };
            let f = fresnel(cos, eta);
            assert!((f.r_s.arg() + 2.0 * (root / cos).atan()).abs() < 1e-12);
            assert!((f.r_p.arg() + 2.0 * (root * eta * eta / cos).atan()).abs() < 1e-12);
            let delta = (f.r_s * f.r_p.conj()).arg();
            assert!(((0.5 * delta).tan() - cos * root / (sin * sin)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_fresnel_rhomb_retards_by_an_eighth_of_a_wave_a_bounce() {
        // Born & Wolf §1.5.4: in crown glass of 1.51, at 54 deg 37 min or 48 deg 37 min, two bounces make a quarter wave.
        for angle in [54.0 + 37.0 / 60.0, 48.0 + 37.0 / 60.0] {
            let f = fresnel(f64::to_radians(angle).cos(), 1.51);
            let delta = (f.r_s * f.r_p.conj()).arg();
            assert!((delta.to_degrees() - 45.0).abs() < 0.1, "{} deg at {angle} deg", delta.to_degrees());
        }
    }

    #[test]
    fn normal_incidence_reflects_the_square_of_the_index_contrast() {
        for eta in ETAS {
            let f = fresnel(1.0, eta);
            let r = (eta - 1.0) / (eta + 1.0);
            assert!((f.r_s.re - r).abs() < 1e-15 && (f.r_p.re + r).abs() < 1e-15);
        }
        // A diamond's table reflects 17.2 % of the light that meets it head on.
        assert!((fresnel(1.0, 1.0 / 2.4175).reflectance() - 0.172).abs() < 5e-4);
    }

    #[test]
    fn equal_indices_reflect_nothing_short_of_grazing() {
        for cos_i in [1.0, 0.5, 1e-3, 1e-9, 1e-100] {
            assert_eq!(fresnel(cos_i, 1.0).reflectance(), 0.0);
            assert_eq!(reflectance(cos_i, 1.0), Some(0.0));
        }
    }

    #[test]
    fn grazing_incidence_reflects_everything() {
        for eta in ETAS {
            let f = fresnel(0.0, eta);
            assert!((f.reflectance() - 1.0).abs() < 1e-15);
            assert!((f.r_s + 1.0).norm() < 1e-15 && (f.r_p + 1.0).norm() < 1e-15);
        }
    }

    #[test]
    fn the_critical_angle_itself_reflects_everything_in_phase() {
        // eta = 1.25 and cos_i = 0.6 are at the critical angle exactly, but for the last bit of each.
        for cos_i in [0.6_f64.next_down(), 0.6, 0.6_f64.next_up()] {
            let f = fresnel(cos_i, 1.25);
            assert!(f.reflectance() > 1.0 - 1e-6 && f.reflectance() <= 1.0);
            assert!(f.r_s.arg().abs() < 1e-6 && f.r_p.arg().abs() < 1e-6);
        }
        let critical = critical_angle(2.4175).expect("diamond is denser than air");
        assert!(fresnel(critical.cos(), 2.4175).reflectance() > 1.0 - 1e-6);
    }

    #[test]
    fn the_quick_form_equals_the_complex_one() {
        for_each_case(|cos_i, eta| {
            let f = fresnel(cos_i, eta);
            match reflectance(cos_i, eta) {
                Some(quick) => assert!(!f.is_total() && (quick - f.reflectance()).abs() < 1e-14),
                None => assert!(f.is_total()),
            }
        });
    }

    #[test]
    fn no_cosine_gives_nan_or_a_share_outside_zero_to_one() {
        let tiny = [0.0, f64::MIN_POSITIVE, 1e-200, 1e-160, 1e-155, 1e-150, 1e-100, 1e-17, 1e-8];
        let cosines = tiny.iter().flat_map(|&c| [c, -c, 1.0 - c, 1.0 + c]).chain([-1e-9, 1.0 + 1e-9]);
        for (cos_i, eta) in cosines.flat_map(|c| ETAS.map(|eta| (c, eta))) {
            let f = fresnel(cos_i, eta);
            assert!((0.0..=1.0).contains(&f.reflectance()) && f.r_s.is_finite() && f.r_p.is_finite());
            assert!(
                f.r_s.arg().abs() <= PI && f.transmission_s().is_finite() && f.transmission_p().is_finite()
            );
            assert!(reflectance(cos_i, eta).is_none_or(|r| (0.0..=1.0 + 1e-15).contains(&r)));
        }
    }
}
