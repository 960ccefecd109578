//! The facets or the triangles of a cut that a family's function makes, after its limits have been checked.

use super::design::DesignError;
use super::facet_net::{FacetNet, NoRoom};
use super::family_cut::FamilyCut;
use super::proportion_error::ProportionError;
use super::shape::Cut;
use crate::math::{NotConvex, Plane, TriangleMesh};

impl FamilyCut {
    /// Returns every facet's name, no two alike, and its plane with a unit normal. Half of the stone's width is 1.
    ///
    /// # Errors
    /// The first limit crossed, and by how much; [`DesignError::NotConvex`] where the stone is a [`mesh`](Self::mesh).
    pub fn facets(&self) -> Result<Vec<(String, Plane)>, DesignError> {
        let net = self.checked()?;
        if net.is_half() { Err(NotConvex.into()) } else { Ok(net.named()) }
    }

    /// Returns the triangles of a stone that is not convex, with the names of its facets; `None` for a family whose stones
    /// are convex. Half of the stone's width is 1.
    ///
    /// # Errors
    /// The first limit crossed, and by how much.
    pub fn mesh(&self) -> Result<Option<TriangleMesh>, ProportionError> {
        let net = self.checked()?;
        if !net.is_half() {
            return Ok(None);
        }
        let mesh = net
            .both_halves()
            .and_then(|surface| TriangleMesh::of_groups(surface).map_err(|_| NoRoom::default()));
        mesh.map(Some).map_err(|unfit| Cut::Family(*self).without_room(unfit))
    }

    /// Returns the net of a cut that crosses no limit.
    fn checked(&self) -> Result<FacetNet, ProportionError> {
        let cut = Cut::Family(*self);
        cut.check()?;
        self.net().map_err(|unfit| cut.without_room(unfit))
    }
}
