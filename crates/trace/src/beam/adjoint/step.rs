//! One landing of a beam, and the derivatives by its quantities before it, from those after it.

use super::super::grow::entry_points;
use super::super::split::Ray;
use super::super::tree::Beams;
use crate::coherency::{Coherency, s_axis};
use brillianteer_math::{Affine, Moments, Plane};
use brillianteer_optics::{Fresnel, Real, fresnel, reflect, refract};
use glam::{DVec2, DVec3};

/// The light that goes on from a facet, without its outline.
#[derive(Debug, Clone, Copy)]
pub(super) struct BeamState {
    /// The starts of the rays, as in [`Ray::origin`].
    pub origin: [DVec3; 3],
    pub direction: DVec3,
    pub light: Coherency,
    pub s: DVec3,
}

/// The derivatives of a sum by each number of a [`BeamState`].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StateAdjoint {
    pub origin: [DVec3; 3],
    pub direction: DVec3,
    /// The derivatives by `ss`, `pp`, `re` and `im` of the light.
    pub light: [f64; 4],
    pub s: DVec3,
    /// The derivatives by the length of the path so far: by its constant and by both components of its gradient.
    pub path: [f64; 3],
}

impl StateAdjoint {
    /// Adds the derivative by the weight of the light.
    pub fn add_weight(&mut self, by: f64) {
        self.light[0] += by;
        self.light[1] += by;
    }

    /// Adds the derivatives by the length of the path at each point of the image.
    pub fn add_path(&mut self, by: Moments) {
        self.path[0] += by.sum;
        self.path[1] += by.first.x;
        self.path[2] += by.first.y;
    }

    pub fn add(&mut self, other: &Self) {
        for (own, by) in self.origin.iter_mut().zip(other.origin) {
            *own += by;
        }
        for (own, by) in self.light.iter_mut().zip(other.light) {
            *own += by;
        }
        for (own, by) in self.path.iter_mut().zip(other.path) {
            *own += by;
        }
        self.direction += other.direction;
        self.s += other.s;
    }
}

/// Fresnel's coefficients, and their derivatives by the cosine of incidence and by the ratio of the indices.
struct FresnelChange {
    surface: Fresnel,
    /// The derivatives of the reflectances of s and p, and of the real and imaginary part of r_s r_p*; each by the
    /// cosine and by the ratio.
    of: [[f64; 2]; 4],
    /// The derivatives of the cosine of refraction; 0 in total reflection.
    of_cos_t: [f64; 2],
}

impl FresnelChange {
    /// Differentiates the formulae of `optics::fresnel`.
    fn new(cos_i: f64, eta: f64) -> Self {
        let surface = fresnel(cos_i, eta);
        let sin_sq = 1.0 - cos_i * cos_i;
        let [of_squared_i, of_squared_eta] = [eta * eta * cos_i, -eta * sin_sq];
        if let Some(cos_t) = surface.cos_t() {
            let of_cos_t = [of_squared_i / cos_t, of_squared_eta / cos_t];
            // r = (a - b) / (a + b)
            let change =
                |a: f64, b: f64, (of_a, of_b): (f64, f64)| 2.0 * (b * of_a - a * of_b) / (a + b).powi(2);
            let of = |k: usize| {
                let [own_i, own_eta] = [[1.0, 0.0], [0.0, 1.0]].map(|unit| unit[k]);
                let of_s = change(eta * cos_i, cos_t, (own_eta * cos_i + eta * own_i, of_cos_t[k]));
                let of_p = change(cos_i, eta * cos_t, (own_i, own_eta * cos_t + eta * of_cos_t[k]));
                let (r_s, r_p) = (surface.r_s.re, surface.r_p.re);
                [2.0 * r_s * of_s, 2.0 * r_p * of_p, of_s * r_p + r_s * of_p, 0.0]
            };
            let (by_i, by_eta) = (of(0), of(1));
            return Self { surface, of: std::array::from_fn(|k| [by_i[k], by_eta[k]]), of_cos_t };
        }
        let decay = (eta * eta * sin_sq - 1.0).max(f64::MIN_POSITIVE).sqrt();
        let of_decay = [-of_squared_i / decay, -of_squared_eta / decay];
        // The phase is -2 atan(b / a).
        let change =
            |a: f64, b: f64, (of_a, of_b): (f64, f64)| -2.0 * (a * of_b - b * of_a) / (a * a + b * b);
        let cross = surface.r_s * surface.r_p.conj();
        let of = |k: usize| {
            let [own_i, own_eta] = [[1.0, 0.0], [0.0, 1.0]].map(|unit| unit[k]);
            let of_s = change(eta * cos_i, decay, (own_eta * cos_i + eta * own_i, of_decay[k]));
            let of_p = change(cos_i, eta * decay, (own_i, own_eta * decay + eta * of_decay[k]));
            [0.0, 0.0, -cross.im * (of_s - of_p), cross.re * (of_s - of_p)]
        };
        let (by_i, by_eta) = (of(0), of(1));
        Self { surface, of: std::array::from_fn(|k| [by_i[k], by_eta[k]]), of_cos_t: [0.0; 2] }
    }

    /// Returns the derivatives of a sum by the cosine and by the ratio, from those by the reflectances of s and p and
    /// by r_s r_p*.
    fn pull_back(&self, per: [f64; 4]) -> [f64; 2] {
        std::array::from_fn(|k| self.of.iter().zip(per).map(|(of, per)| of[k] * per).sum())
    }
}

/// Adds to the derivatives by the direction and by the normal those that follow from the derivative by the axis s;
/// returns false where the axis depends on neither.
fn pull_back_s_axis(
    (direction, normal): (DVec3, DVec3),
    s: DVec3,
    per_s: DVec3,
    (per_direction, per_normal): (&mut DVec3, &mut DVec3),
) -> bool {
    let length = direction.cross(normal).length();
    if length <= f64::SQUARE_ON {
        return false;
    }
    let per_cross = (per_s - s * s.dot(per_s)) / length;
    *per_direction += normal.cross(per_cross);
    *per_normal += per_cross.cross(direction);
    true
}

impl BeamState {
    /// Returns the state of light that has entered through a facet.
    pub fn entered(beams: &Beams, plane: &Plane) -> Self {
        let view = &beams.view;
        let cos_i = plane.normal.dot(view.toward);
        let eta = 1.0 / beams.medium.index;
        let surface = fresnel(cos_i, eta);
        let (light, _) = Coherency::entered(&surface);
        let light = if beams.polarised { light } else { light.unpolarised() };
        let direction = refract(-view.toward, plane.normal, eta, (cos_i, surface.cos_t_or_zero()));
        let s = s_axis(direction, plane.normal, view.right);
        Self { origin: entry_points(view, plane), direction, light, s }
    }

    /// Returns the derivatives by normal and offset of the facet by which the light has entered, and by the index.
    ///
    /// `leaving` is the derivative by the weight and by the direction of the glare.
    pub fn pull_back_entry(
        &self,
        beams: &Beams,
        plane: &Plane,
        after: &StateAdjoint,
        leaving: (f64, DVec3),
    ) -> (DVec3, f64, f64) {
        let (n, toward) = (plane.normal, beams.view.toward);
        let cos_i = n.dot(toward);
        let eta = 1.0 / beams.medium.index;
        let change = FresnelChange::new(cos_i, eta);
        let cos_t = change.surface.cos_t_or_zero();
        let (mut per_n, mut per_cos, mut per_eta) = (DVec3::ZERO, 0.0, 0.0);
        let per_o = toward.dot(after.origin[0]);
        let per_offset = per_o / cos_i;
        per_cos -= per_o * plane.offset / (cos_i * cos_i);
        for (axis, per) in [(beams.view.right, after.origin[1]), (beams.view.up, after.origin[2])] {
            let per_slide = -toward.dot(per);
            per_n += axis * (per_slide / cos_i);
            per_cos -= per_slide * n.dot(axis) / (cos_i * cos_i);
        }
        let mut per_direction = after.direction;
        pull_back_s_axis((self.direction, n), self.s, after.s, (&mut per_direction, &mut per_n));
        let along = n.dot(per_direction);
        per_n += per_direction * (eta * cos_i - cos_t);
        per_eta += along * cos_i - toward.dot(per_direction);
        per_cos += along * (eta - change.of_cos_t[0]);
        per_eta -= along * change.of_cos_t[1];
        let [mut ss, mut pp, ..] = after.light;
        if !beams.polarised {
            (ss, pp) = ((ss + pp) / 2.0, (ss + pp) / 2.0);
        }
        let (per_glare, per_exit) = leaving;
        let [by_cos, by_eta] = change.pull_back([(per_glare - ss) / 2.0, (per_glare - pp) / 2.0, 0.0, 0.0]);
        per_cos += by_cos;
        per_eta += by_eta;
        per_n += per_exit * (2.0 * cos_i);
        per_cos += 2.0 * n.dot(per_exit);
        per_n += toward * per_cos;
        (per_n, per_offset, -per_eta * eta * eta)
    }
}

/// A beam that lands on a facet, with everything on which its derivatives depend.
pub(super) struct LandingStep<'a> {
    before: &'a BeamState,
    plane: &'a Plane,
    beams: &'a Beams,
    cos_i: f64,
    distance: Affine,
    s: DVec3,
    turned: Coherency,
    pub after: BeamState,
}

/// The derivatives of a sum by the quantities on which a landing depends.
pub(super) struct LandingAdjoint {
    pub before: StateAdjoint,
    pub normal: DVec3,
    pub offset: f64,
    pub index: f64,
}

impl<'a> LandingStep<'a> {
    /// Lands on a plane, by the same formulae as [`super::super::follow`].
    pub fn new(before: &'a BeamState, plane: &'a Plane, beams: &'a Beams) -> Self {
        let (d, n) = (before.direction, plane.normal);
        let cos_i = d.dot(n);
        let [o, u, v] = before.origin.map(|o| n.dot(o));
        let distance = Affine::new((plane.offset - o) / cos_i, DVec2::new(-u / cos_i, -v / cos_i));
        let s = s_axis(d, n, before.s);
        let turned = before.light.turned(before.s.dot(s), d.cross(before.s).dot(s));
        let (reflected, _) = turned.split(&fresnel(cos_i, beams.medium.index));
        let light = if beams.polarised { reflected } else { reflected.unpolarised() };
        let ray = Ray { origin: before.origin, direction: d };
        let after = BeamState { origin: ray.advanced(distance), direction: reflect(d, -n, cos_i), light, s };
        Self { before, plane, beams, cos_i, distance, s, turned, after }
    }

    /// Returns the derivatives by the quantities before the landing, from those by the state after it and by weight
    /// and direction of the exit.
    pub fn pull_back(&self, after: &StateAdjoint, leaving: (f64, DVec3)) -> LandingAdjoint {
        let mut back =
            LandingAdjoint { before: StateAdjoint::default(), normal: DVec3::ZERO, offset: 0.0, index: 0.0 };
        let mut per_cos = self.pull_back_light(after, leaving, &mut back);
        per_cos += self.pull_back_path(after, &mut back);
        back.before.direction += self.plane.normal * per_cos;
        back.normal += self.before.direction * per_cos;
        back
    }

    /// Adds the derivatives that follow from the reflected light, the exit and the axis s; returns the derivative by
    /// the cosine of incidence.
    fn pull_back_light(
        &self,
        after: &StateAdjoint,
        (per_weight, per_exit): (f64, DVec3),
        back: &mut LandingAdjoint,
    ) -> f64 {
        let (d, n, index) = (self.before.direction, self.plane.normal, self.beams.medium.index);
        let change = FresnelChange::new(self.cos_i, index);
        let mut per_cos = 0.0;
        if let Some(cos_t) = change.surface.cos_t() {
            let per_normal_part = -n.dot(per_exit);
            back.before.direction += per_exit * index;
            back.normal -= per_exit * (index * self.cos_i - cos_t);
            back.index += d.dot(per_exit) + per_normal_part * (self.cos_i - change.of_cos_t[1]);
            per_cos += per_normal_part * (index - change.of_cos_t[0]);
        }
        let [mut ss, mut pp, mut re, mut im] = after.light;
        if !self.beams.polarised {
            [ss, pp, re, im] = [(ss + pp) / 2.0, (ss + pp) / 2.0, 0.0, 0.0];
        }
        let (per_light, per_surface) =
            self.turned.pull_back_split(&change.surface, [ss, pp, re, im], per_weight);
        let [by_cos, by_index] = change.pull_back(per_surface);
        per_cos += by_cos;
        back.index += by_index;
        let (s, s_before) = (self.s, self.before.s);
        let p_before = d.cross(s_before);
        let (light, [per_a, per_b]) =
            self.before.light.pull_back_turned(s_before.dot(s), p_before.dot(s), per_light);
        back.before.light = light;
        back.before.s += s * per_a + s.cross(d) * per_b;
        back.before.direction += s_before.cross(s) * per_b;
        let per_s = after.s + s_before * per_a + p_before * per_b;
        let LandingAdjoint { before, normal, .. } = back;
        if !pull_back_s_axis((d, n), s, per_s, (&mut before.direction, normal)) {
            before.s += per_s;
        }
        per_cos
    }

    /// Adds the derivatives that follow from the point reached and the reflected direction; returns the derivative by
    /// the cosine of incidence.
    fn pull_back_path(&self, after: &StateAdjoint, back: &mut LandingAdjoint) -> f64 {
        let (d, n) = (self.before.direction, self.plane.normal);
        back.before.direction += after.direction;
        back.normal -= after.direction * (2.0 * self.cos_i);
        let mut per_cos = -2.0 * n.dot(after.direction);
        let Affine { constant, gradient } = self.distance;
        let distances = [constant, gradient.x, gradient.y];
        for (k, distance) in distances.into_iter().enumerate() {
            let (start, per) = (self.before.origin[k], after.origin[k]);
            back.before.direction += per * distance;
            back.before.path[k] += after.path[k];
            let per_distance = (d.dot(per) + after.path[k]) / self.cos_i;
            if k == 0 {
                back.offset += per_distance;
            }
            back.normal -= start * per_distance;
            back.before.origin[k] += per - n * per_distance;
            per_cos -= per_distance * distance;
        }
        per_cos
    }
}
