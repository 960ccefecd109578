//! Derivatives of measures that are sums over exits.

use super::super::exit_sight::seen_apart;
use super::super::{MeasureName, MeasureSettings};
use super::{BeamSum, divide_by_silhouette, share};
use brillianteer_math::Polytope;
use brillianteer_scene::{DomeLight, elevation_deg};
use brillianteer_trace::beam::{Beam, BeamPartials, Beams};
use glam::DVec3;

/// The exits that a measure counts, with the parameters of their weights.
pub(super) enum CountedExits {
    Dome { dome: DomeLight, with_glare: bool },
    Below { only_straight: bool },
    Head { head_deg: f64 },
    Fire { blur_deg: f64 },
}

/// The weight of an exit, and its derivatives.
struct ExitWeight {
    value: f64,
    /// The derivative by the direction of the exit.
    per_exit: DVec3,
    /// The derivative per radian of the exit's fan.
    per_fan: f64,
}

impl ExitWeight {
    const WHOLE: Self = Self { value: 1.0, per_exit: DVec3::ZERO, per_fan: 0.0 };
}

impl CountedExits {
    pub fn of(name: &MeasureName, head_deg: f64, blur_deg: f64) -> Option<Self> {
        Some(match *name {
            MeasureName::Return(dome) => Self::Dome { dome, with_glare: false },
            MeasureName::ReturnWithGlare(dome) => Self::Dome { dome, with_glare: true },
            MeasureName::Leakage => Self::Below { only_straight: false },
            MeasureName::Windowing => Self::Below { only_straight: true },
            MeasureName::Obstruction => Self::Head { head_deg },
            MeasureName::Fire => Self::Fire { blur_deg },
            _ => return None,
        })
    }

    /// Sums the counted exits of all beams.
    pub fn sum(&self, beams: &Beams, polytope: &Polytope, settings: &MeasureSettings) -> BeamSum {
        let share = share(beams);
        let fans = match self {
            Self::Fire { .. } => beams.fans(polytope, settings.indices),
            _ => vec![],
        };
        let mut sum =
            BeamSum { value: 0.0, partials: BeamPartials::none(beams.len()), per_fan: vec![0.0; fans.len()] };
        for beam in beams.iter().filter(|beam| beam.weight > 0.0) {
            let k = beam.id as usize;
            let fan = fans.get(k).copied().unwrap_or(0.0);
            let Some(weight) = self.weight(&beam, beams, fan) else { continue };
            let energy = beam.weight * beam.area * share;
            sum.value += energy * weight.value;
            sum.partials.energy[k] = weight.value * share;
            sum.partials.exit[k] = weight.per_exit * energy;
            if let Some(per_fan) = sum.per_fan.get_mut(k) {
                *per_fan = weight.per_fan * energy;
            }
        }
        divide_by_silhouette(&mut sum.partials, beams, sum.value);
        sum
    }

    /// Returns the weight of an exit whose colours spread over an angle of `fan` radians; `None` where it is not
    /// counted.
    fn weight(&self, beam: &Beam, beams: &Beams, fan: f64) -> Option<ExitWeight> {
        let elevation = elevation_deg(beam.exit, beams.zenith);
        match *self {
            Self::Dome { dome, with_glare } => {
                let is_counted = with_glare || !beam.is_surface();
                is_counted.then(|| ExitWeight {
                    value: dome.radiance(beam.exit, beams.zenith),
                    per_exit: dome.slope(beam.exit, beams.zenith),
                    per_fan: 0.0,
                })
            }
            Self::Below { only_straight } => {
                let parent = beams.get(beam.parent?);
                let is_counted = elevation < 0.0 && (!only_straight || parent.is_surface());
                is_counted.then_some(ExitWeight::WHOLE)
            }
            Self::Head { head_deg } => {
                let is_counted =
                    !beam.is_surface() && head_deg > 0.0 && elevation >= (90.0 - head_deg).max(0.0);
                is_counted.then_some(ExitWeight::WHOLE)
            }
            Self::Fire { blur_deg } => {
                let value = seen_apart(fan, blur_deg);
                // The weight is 1 - blur / fan. Where one colour is totally reflected, the fan is π and does not
                // change.
                let changes = value > 0.0 && fan < std::f64::consts::PI;
                let per_fan = if changes { (1.0 - value) / fan } else { 0.0 };
                let is_counted = !beam.is_surface() && elevation >= 0.0;
                is_counted.then_some(ExitWeight { value, per_exit: DVec3::ZERO, per_fan })
            }
        }
    }
}

/// Sums the light that the stone absorbs.
pub(super) fn absorbed(beams: &Beams) -> BeamSum {
    let share = share(beams);
    let value = beams.iter().map(|beam| beam.absorbed * share).sum();
    let mut partials = BeamPartials::none(beams.len());
    partials.absorbed.fill(share);
    divide_by_silhouette(&mut partials, beams, value);
    BeamSum { value, partials, per_fan: vec![] }
}
