//! The frosted facets of a stone, and the scattering of light at them by chance.

use super::light::PathLight;
use super::lobe_luck::LobeLuck;
use crate::DispersedRay;
use brillianteer_math::SolidRef;
use brillianteer_optics::{FrostedScatter, FrostedSurface};
use glam::DVec3;

/// The frosted facets of a stone.
#[derive(Debug)]
pub(super) struct FrostedFacets(Vec<Option<FrostedSurface>>);

/// Light that arrives at a frosted facet from inside.
pub(super) struct Arriving {
    pub facet: u32,
    pub point: DVec3,
    /// The facet's unit outward normal.
    pub normal: DVec3,
    pub direction: DVec3,
    /// The length of the path, as in [`SurfaceEvent`](super::path::SurfaceEvent).
    pub path: f64,
    /// The share that has not been absorbed, as in [`SurfaceEvent`](super::path::SurfaceEvent).
    pub left: f64,
    pub light: PathLight,
}

/// The way on which light goes on from a frosted facet.
pub(super) enum Struck {
    /// The light goes on inside, along this ray.
    Inward(DispersedRay, PathLight),
    /// The light went on outside, and has been reported.
    Outward,
    /// The light is not followed.
    Unresolved,
}

impl FrostedFacets {
    /// Returns the frosted facets of a solid; `None` where all are polished.
    pub fn of(solid: SolidRef) -> Option<Self> {
        let SolidRef::Convex(polytope) = solid else { return None };
        let surface = |frosting: f64| (frosting > 0.0).then(|| FrostedSurface::new(frosting));
        let all = || polytope.facets().iter().map(|facet| surface(facet.frosting)).collect();
        polytope.is_frosted().then(|| Self(all()))
    }

    pub fn of_facet(&self, facet: usize) -> Option<FrostedSurface> {
        self.0.get(facet).copied().flatten()
    }
}

/// Scatters light and draws the next random numbers; `None` without them, and where the walk among the microscopic
/// facets does not end.
pub(super) fn scatter(
    surface: FrostedSurface,
    (arriving, normal): (DVec3, DVec3),
    eta: f64,
    luck: &mut Option<LobeLuck>,
) -> Option<FrostedScatter> {
    let (first, later) = (*luck)?.draw();
    *luck = Some(later);
    surface.scatter(arriving, normal, eta, first, later.numbers())
}
