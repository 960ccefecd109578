//! The weight and polarisation of light that a group of wavelengths shares.

use super::slanted_light::{Slant, SlantedLight};
use crate::coherency::{Coherency, s_axis};
use brillianteer_optics::fresnel;
use glam::DVec3;

/// Axes s of a group's ends whose cosine is below this are not averaged.
const ALIKE: f64 = 0.9;

/// The light of one wavelength, without absorption.
#[derive(Debug, Clone, Copy)]
pub(super) struct EndLight {
    /// The slant of this wavelength.
    pub slant: Slant,
    /// The weight and polarisation.
    pub coherency: Coherency,
    /// The axis s of `coherency`: a unit vector perpendicular to the ray.
    pub s: DVec3,
}

/// The light of a group of wavelengths.
///
/// Reflectances change with the index, by some percent from red to violet in diamond. One weight for all wavelengths would
/// make red light too weak and blue light too strong, or the other way round. So the weights of the first and of the last
/// wavelength are followed, and those between them lie on a straight line over the index.
#[derive(Debug, Clone, Copy)]
pub(super) struct GroupLight {
    /// The light of the first wavelength.
    pub first: EndLight,
    /// The light of the last wavelength; `None` in a group of one.
    pub last: Option<EndLight>,
}

/// The light of a group that arrives at a facet, in the axes of that facet.
#[derive(Debug, Clone, Copy)]
pub(super) struct ArrivingLight {
    first: (f64, Coherency),
    last: Option<(f64, Coherency)>,
}

impl EndLight {
    /// Returns the light that arrives at a facet, in its axes, and the light that the facet reflects.
    fn landed(&self, light: &SlantedLight, normal: DVec3, is_polarised: bool) -> (Coherency, Self) {
        let direction = light.direction(&self.slant);
        let s = s_axis(direction, normal, self.s);
        let arriving = self.coherency.turned_to(s, self.s, direction);
        let (reflected, _) = arriving.split(&fresnel(direction.dot(normal), self.slant.index));
        let coherency = if is_polarised { reflected } else { reflected.unpolarised() };
        (arriving, Self { slant: self.slant, coherency, s })
    }
}

impl GroupLight {
    /// Returns light of weight 0.
    pub fn none(slant: Slant) -> Self {
        let first = EndLight { slant, coherency: Coherency::NONE, s: DVec3::X };
        Self { first, last: None }
    }

    /// Returns the mean weight of the group.
    pub fn weight(&self) -> f64 {
        let first = self.first.coherency.weight();
        self.last.map_or(first, |last| 0.5 * (first + last.coherency.weight()))
    }

    /// Returns the light that arrives at a facet with this normal, and the light that the facet reflects.
    pub fn landed(&self, light: &SlantedLight, normal: DVec3, is_polarised: bool) -> (ArrivingLight, Self) {
        let landed = |end: &EndLight| {
            let (arriving, onward) = end.landed(light, normal, is_polarised);
            ((end.slant.index, arriving), onward)
        };
        let (first, first_onward) = landed(&self.first);
        let (last, last_onward) = self.last.as_ref().map(landed).unzip();
        (ArrivingLight { first, last }, Self { first: first_onward, last: last_onward })
    }

    /// Returns the weight and polarisation in the middle of the group, and its axis s, which is perpendicular to the direction
    /// of the light there.
    pub fn middle(&self, direction: DVec3) -> (Coherency, DVec3) {
        let (coherency, s) = match &self.last {
            Some(last) if last.s.dot(self.first.s) > ALIKE => {
                (self.first.coherency.between(&last.coherency, 0.5), self.first.s + last.s)
            }
            _ => (self.first.coherency.scaled_to(self.weight()), self.first.s),
        };
        let s = s - direction * s.dot(direction);
        (coherency, s.try_normalize().unwrap_or_else(|| direction.any_orthonormal_vector()))
    }
}

impl ArrivingLight {
    /// Returns a number of the light at an index, from that of the first and that of the last wavelength.
    pub fn at(&self, index: f64, of: impl Fn(&Coherency) -> f64) -> f64 {
        let ((from, first), value) = (self.first, of(&self.first.1));
        let Some((to, last)) = &self.last else { return value };
        // Media may have one index and differ in their absorption.
        let part = if *to == from { 0.0 } else { (index - from) / (to - from) };
        value + part * (of(last) - of(&first))
    }
}
