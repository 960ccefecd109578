//! The directions of reflected and refracted rays, and the two angles that the trade quotes.
//!
//! `d` is the unit direction of travel, `n` the unit normal on the side that the light comes from (n·d < 0), `cos_i` = -n·d,
//! and `eta` = incident index / transmitted index. Source: M. Born and E. Wolf, *Principles of Optics*, 7th ed. (1999),
//! §1.5.1, law of refraction eq. 8; as vectors in M. Pharr, W. Jakob and G. Humphreys, *Physically Based Rendering*, 4th ed.
//! (2023), §9.3.

use super::real::{Real, Vector};

/// The greatest distance of a unit vector's length from 1, or of a grazing n·d beyond 0, that counts as rounding.
/// Anything greater counts as a caller's mistake.
const ROUNDING: f64 = 1e-9;

/// Light that meets a surface, and its change over the range that a ray represents.
#[derive(Debug, Clone, Copy)]
pub struct Incidence<V: Vector> {
    /// The unit direction of travel.
    pub direction: V,
    /// The unit normal on the side that the light comes from.
    pub normal: V,
    /// The cosine of the angle of incidence, -n·d.
    pub cos_i: V::Real,
    /// The change of the direction.
    pub of_direction: V,
    /// The change of the normal; `None` where the surface is flat.
    pub of_normal: Option<V>,
}

/// Returns the direction of the mirror-reflected ray, d + 2 cos_i n.
#[inline(always)]
pub fn reflect<V: Vector>(d: V, n: V, cos_i: V::Real) -> V {
    check(d, n, cos_i);
    (d + n * (cos_i + cos_i)).renormalised()
}

/// Returns the direction of the refracted ray, eta d + (eta cos_i - cos_t) n, with `cos_t` from [`cos_transmitted`].
///
/// The tangential part is scaled by eta (Snell), and the normal part makes it a unit vector.
#[inline(always)]
pub fn refract<V: Vector>(d: V, n: V, eta: V::Real, (cos_i, cos_t): (V::Real, V::Real)) -> V {
    check(d, n, cos_i);
    d * eta + n * (eta * cos_i - cos_t)
}

impl<V: Vector> Incidence<V> {
    /// Returns the change of the reflected direction.
    ///
    /// This is the differential of [`reflect`]; it is the same for a normal of either sign.
    #[inline(always)]
    pub fn reflected_change(&self) -> V {
        let Self { direction: d, normal: n, of_direction: of_d, .. } = *self;
        let across = of_d.dot(n);
        match self.of_normal {
            None => of_d - n * (across + across),
            Some(of_n) => {
                let (turn, along) = (across + d.dot(of_n), d.dot(n));
                of_d - n * (turn + turn) - of_n * (along + along)
            }
        }
    }

    /// Returns the change of the refracted direction where eta changes by `of_eta`.
    ///
    /// This is the differential of [`refract`]; `cos_t` must be above 0.
    #[inline(always)]
    pub fn refracted_change(&self, eta: V::Real, of_eta: V::Real, cos_t: V::Real) -> V {
        let Self { direction: d, normal: n, cos_i, of_direction: of_d, of_normal } = *self;
        let of_cos_i = match of_normal {
            None => -of_d.dot(n),
            Some(of_n) => -of_d.dot(n) - d.dot(of_n),
        };
        let square = cos_i.constant(1.0) - cos_i * cos_i;
        let divisor = cos_t.max(cos_t.constant(V::Real::LEAST_COS));
        let of_cos_t = eta * (eta * cos_i * of_cos_i - square * of_eta) / divisor;
        let change = d * of_eta + of_d * eta + n * (of_eta * cos_i + eta * of_cos_i - of_cos_t);
        match of_normal {
            None => change,
            Some(of_n) => change + of_n * (eta * cos_i - cos_t),
        }
    }
}

/// Panics on a caller's mistake, in debug builds only. Lanes are not checked, because empty ones hold any numbers.
#[inline(always)]
fn check<V: Vector>(d: V, n: V, cos_i: V::Real) {
    if !cfg!(debug_assertions) {
        return;
    }
    let squares = (d.dot(d).of_single(), n.dot(n).of_single());
    let (Some(d), Some(n), Some(cos), Some(along)) =
        (squares.0, squares.1, cos_i.of_single(), n.dot(d).of_single())
    else {
        return;
    };
    let is_near = |off: f64| off.abs() < ROUNDING;
    assert!(is_near(d - 1.0) && is_near(n - 1.0), "unit vectors are wanted, not |d|² = {d} and |n|² = {n}");
    assert!(is_near(cos + along), "cos_i is -n·d, which is {}, not {cos}", -along);
}

/// Returns the cosine of the angle of refraction; `None` where reflection is total.
///
/// Reflection is total beyond the critical angle and exactly at it, where the refracted ray would run along the
/// surface and carry no light through. A `cos_i` slightly outside 0..=1 is taken as rounding.
#[inline]
pub fn cos_transmitted(cos_i: f64, eta: f64) -> Option<f64> {
    let squared = cos_t_squared(cos_i, eta);
    is_refracted(squared).then(|| squared.sqrt())
}

/// Returns whether light is refracted at an angle whose cosine has this square; otherwise reflection is total. Only this
/// function decides between the two, so that the tracers, [`fresnel`](super::fresnel()) and
/// [`reflectance`](super::reflectance) agree.
#[inline(always)]
pub(super) fn is_refracted<N: Real>(cos_t_squared: N) -> N::Truth {
    cos_t_squared.constant(N::LEAST_COS_T_SQUARED).less(cos_t_squared)
}

/// Returns 1 - eta² sin²(i), negative beyond the critical angle. The sum is written so that equal indices give
/// exactly cos²(i).
#[inline(always)]
pub(super) fn cos_t_squared<N: Real>(cos_i: N, eta: N) -> N {
    let one = eta.constant(1.0);
    let normal_part = eta * cos_i.clamped();
    (one - eta) * (one + eta) + normal_part * normal_part
}

/// Returns the angle of incidence in radians beyond which reflection is total, asin(1 / eta) (Born & Wolf §1.5.4).
///
/// For a stone in air `eta` is its index. `None` where reflection is never total (`eta` <= 1).
#[inline]
pub fn critical_angle(eta: f64) -> Option<f64> {
    (eta > 1.0).then(|| (1.0 / eta).asin())
}

/// Returns the angle of incidence in radians at which no p-polarised light is reflected, atan(1 / eta) (Born & Wolf §1.5.3).
#[inline]
pub fn brewster_angle(eta: f64) -> f64 {
    (1.0 / eta).atan()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// Refracts a ray, or finds that reflection is total, as the tracers do.
    fn refract(d: DVec3, n: DVec3, eta: f64) -> Option<DVec3> {
        let cos_i = -n.dot(d);
        Some(super::refract(d, n, eta, (cos_i, cos_transmitted(cos_i, eta)?)))
    }

    fn reflect(d: DVec3, n: DVec3) -> DVec3 {
        super::reflect(d, n, -n.dot(d))
    }

    const ETAS: [f64; 7] = [0.3, 1.0 / 2.4175, 0.75, 1.0, 1.33, 2.4175, 2.9];

    /// Returns a direction that meets `n` at `angle`, turned about `n` by `turn`.
    fn incident(n: DVec3, angle: f64, turn: f64) -> DVec3 {
        let (u, v) = n.any_orthonormal_pair();
        (u * turn.cos() + v * turn.sin()) * angle.sin() - n * angle.cos()
    }

    /// Calls `check` for every eta with many angles, turns and normals.
    fn for_each_case(mut check: impl FnMut(DVec3, DVec3, f64)) {
        for k in 0..12 {
            let n = DVec3::from_array([1.3 - 0.2 * f64::from(k), 0.7, f64::from(k % 5) - 1.9]);
            let n = n / n.length();
            for step in 0..90 {
                let d = incident(n, f64::from(step).to_radians(), 0.4 * f64::from(step));
                ETAS.iter().for_each(|&eta| check(d, n, eta));
            }
        }
    }

    #[test]
    fn sines_obey_snells_law() {
        for_each_case(|d, n, eta| {
            if let Some(t) = refract(d, n, eta) {
                assert!((t.cross(n).length() - eta * d.cross(n).length()).abs() < 1e-14);
            }
        });
    }

    #[test]
    fn refracted_and_reflected_directions_are_unit_vectors() {
        for_each_case(|d, n, eta| {
            assert!((reflect(d, n).length() - 1.0).abs() < 1e-14);
            assert!(refract(d, n, eta).is_none_or(|t| (t.length() - 1.0).abs() < 1e-14));
        });
    }

    #[test]
    fn the_change_of_a_refracted_or_reflected_ray_is_what_a_small_step_makes_of_it() {
        for_each_case(|d, n, eta| {
            let (cos_i, step) = (-n.dot(d), 1e-6);
            let Some(cos_t) = cos_transmitted(cos_i, eta).filter(|&cos_t| cos_t > 0.05) else { return };
            let of_d = DVec3::new(0.3, -0.2, 0.5).reject_from_normalized(d);
            let of_n = DVec3::new(-0.1, 0.4, 0.2).reject_from_normalized(n);
            let moved = |s: f64| {
                let (d, n) = (d + of_d * s, n + of_n * s);
                let (cos_i, eta) = (-n.dot(d), eta + 0.7 * s);
                let cos_t = (1.0 - eta * eta * (1.0 - cos_i * cos_i)).sqrt();
                (d * eta + n * (eta * cos_i - cos_t), d + n * (2.0 * cos_i))
            };
            let (ahead, behind) = (moved(step), moved(-step));
            let expected = (ahead.0 - behind.0) / (2.0 * step);
            let incidence =
                Incidence { direction: d, normal: n, cos_i, of_direction: of_d, of_normal: Some(of_n) };
            let change = incidence.refracted_change(eta, 0.7, cos_t);
            assert!((change - expected).length() < 1e-5, "{change} for {expected} at {d}, {n}, {eta}");
            let expected = (ahead.1 - behind.1) / (2.0 * step);
            for n in [n, -n] {
                let of_normal = Some(if n.dot(d) == -cos_i { of_n } else { -of_n });
                let change = Incidence { normal: n, of_normal, ..incidence }.reflected_change();
                assert!((change - expected).length() < 1e-8, "{change} for {expected} at {d}, {n}");
            }
        });
    }

    #[test]
    fn the_incident_reflected_and_refracted_rays_lie_in_one_plane() {
        for_each_case(|d, n, eta| {
            let across = n.cross(d);
            assert!(reflect(d, n).dot(across).abs() < 1e-14);
            assert!(refract(d, n, eta).is_none_or(|t| t.dot(across).abs() < 1e-14));
        });
    }

    #[test]
    fn a_refracted_ray_goes_through_and_a_reflected_one_comes_back() {
        for_each_case(|d, n, eta| {
            assert!(
                (reflect(d, n).dot(n) + d.dot(n)).abs() < 1e-15,
                "the angle of reflection is that of incidence"
            );
            assert!(refract(d, n, eta).is_none_or(|t| t.dot(n) < 0.0 && t.cross(n).dot(d.cross(n)) >= 0.0));
        });
    }

    #[test]
    fn light_retraces_its_path() {
        for_each_case(|d, n, eta| {
            if let Some(t) = refract(d, n, eta) {
                let back = refract(-t, -n, 1.0 / eta).expect("the way back is open where the way in was");
                // A cosine is the root of a square that is rounded at eta² (or 1 / eta² on the way back).
                let slack = 1e-15 * (eta + 1.0 / eta).powi(2) / t.dot(n).abs().min(d.dot(n).abs());
                assert!((back + d).length() < slack, "{d} came back as {back}");
            }
        });
    }

    #[test]
    fn equal_indices_let_a_ray_pass_unbent() {
        for_each_case(|d, n, _| assert!((refract(d, n, 1.0).expect("no interface") - d).length() < 1e-15));
    }

    #[test]
    fn reflection_is_total_exactly_beyond_the_critical_angle() {
        let (n, slack) = (DVec3::Z, 1e-9);
        for eta in [1.1, 1.54, 2.4175, 2.9] {
            let critical = critical_angle(eta).expect("eta > 1");
            assert!(refract(incident(n, critical - slack, 0.3), n, eta).is_some());
            assert!(refract(incident(n, critical + slack, 0.3), n, eta).is_none());
        }
        assert_eq!(critical_angle(1.0), None);
        assert_eq!(critical_angle(0.5), None);
    }

    #[test]
    fn reflection_is_never_total_into_a_denser_medium() {
        for_each_case(|d, n, eta| assert!(eta > 1.0 || refract(d, n, eta).is_some()));
    }

    #[test]
    fn rounding_past_grazing_or_normal_incidence_is_harmless() {
        assert_eq!(cos_transmitted(1.0 + 1e-12, 2.4), cos_transmitted(1.0, 2.4));
        assert_eq!(cos_transmitted(-1e-12, 0.4), cos_transmitted(0.0, 0.4));
        assert!((cos_transmitted(1.0, 2.4).expect("normal incidence") - 1.0).abs() < 1e-15);
    }

    #[test]
    fn diamond_has_the_angles_the_books_print() {
        let degrees = |radians: f64| (radians.to_degrees() * 100.0).round() / 100.0;
        // The first is its index at sodium D; the rounder 2.4175 belongs to helium d and gives 24.43.
        assert_eq!(critical_angle(2.41726).map(degrees), Some(24.44));
        assert_eq!(critical_angle(2.4175).map(degrees), Some(24.43));
        assert_eq!([2.41726, 2.4175].map(|n| degrees(brewster_angle(n))), [22.47, 22.47]);
    }
}
