//! Light at the frosted facets of a stone. All of it goes on in one direction, which chance decides, and is
//! unpolarised from there on. So frosted facets neither add nor lose light, and a ray stays one chain of bounces.

use super::facets::FacetSearch;
use super::frosted_facets::{Arriving, Struck, scatter};
use super::lobe_luck::LobeLuck;
use super::path::{ExitLight, SurfaceEvent};
use super::tree::Inbound;
use super::{Loss, PathLight, StoneTracer};
use crate::DispersedRay;
use brillianteer_optics::{FrostedScatter, FrostedSurface};
use glam::DVec3;

impl StoneTracer {
    /// Returns whether the stone has frosted facets.
    pub(super) fn is_frosted(&self) -> bool {
        self.frosted.is_some()
    }

    /// Returns light that a frosted facet has scattered in a direction; it has the same weight and no polarisation.
    pub(super) fn scattered(&self, light: &PathLight, direction: DVec3) -> PathLight {
        PathLight::of_eye(direction, light.weight(), self.options.polarised)
    }

    /// Follows light that meets a frosted facet from outside, and goes on through the stone with the light that
    /// passes the facet.
    pub(super) fn enter_frosted<F: FacetSearch>(
        &self,
        (facets, surface): (&F, FrostedSurface),
        (point, normal): (DVec3, DVec3),
        inbound: Inbound,
        least_weight: f64,
        mut meets: impl FnMut(SurfaceEvent),
    ) -> Loss {
        let Inbound { met: (facet, _), ray, light, left, path, bounce, mut luck } = inbound;
        let weight = light.weight() * left;
        let Some(found) = scatter(surface, (ray.direction, normal), 1.0 / self.medium.index, &mut luck)
        else {
            return Loss { unresolved: weight, bounces: bounce, ..Loss::default() };
        };
        let FrostedScatter { direction, passes } = found;
        if passes {
            let (ray, light) = (DispersedRay::new(point, direction), self.scattered(&light, direction));
            return self.bounce(facets, Inbound { ray, light, luck, ..inbound }, least_weight, meets);
        }
        meets(SurfaceEvent {
            facet: facet as u32,
            point,
            normal,
            path,
            left,
            bounce,
            arriving: ray.direction,
            light: &light,
            leaving: Some(exit_light(direction, weight, surface)),
            onward: 0.0,
        });
        Loss { bounces: bounce, ..Loss::default() }
    }

    /// Scatters light that meets a frosted facet from inside, and reports it where it leaves.
    pub(super) fn leave_frosted(
        &self,
        surface: FrostedSurface,
        arriving: &Arriving,
        bounce: u32,
        luck: &mut Option<LobeLuck>,
        meets: &mut impl FnMut(SurfaceEvent),
    ) -> Struck {
        let &Arriving { facet, point, normal, direction, path, left, ref light } = arriving;
        let Some(found) = scatter(surface, (direction, -normal), self.medium.index, luck) else {
            return Struck::Unresolved;
        };
        if !found.passes {
            let onward = self.scattered(light, found.direction);
            return Struck::Inward(DispersedRay::new(point, found.direction), onward);
        }
        meets(SurfaceEvent {
            facet,
            point,
            normal,
            path,
            left,
            bounce,
            arriving: direction,
            light,
            leaving: Some(exit_light(found.direction, light.weight() * left, surface)),
            onward: 0.0,
        });
        Struck::Outward
    }
}

/// Returns scattered light that leaves. Its change over a band of wavelengths is left out, because it is small beside
/// the width of the lobe.
fn exit_light(direction: DVec3, weight: f64, surface: FrostedSurface) -> ExitLight {
    ExitLight { direction, fan: DVec3::ZERO, shift: DVec3::ZERO, weight, spread: surface.spread() }
}
