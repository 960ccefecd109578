//! Light at the frosted facets of a stone: all of it goes on in one direction that chance decides, and no longer polarised. So
//! frosted facets neither add nor lose light, and a ray stays one chain of bounces.

use super::lobe_luck::LobeLuck;
use crate::math::SolidRef;
use crate::optics::{FrostedScatter, FrostedSurface};
use glam::DVec3;

/// The frosted facets of a stone.
#[derive(Debug)]
pub(super) struct FrostedFacets(Vec<Option<FrostedSurface>>);

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

/// Scatters light, and moves the luck on; `None` without luck, and where the walk among the microscopic facets does not end.
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
