//! The facets and the stone of a cut that a family's function makes, after its limits have been checked.

use super::design::DesignError;
use super::facet_net::NoRoom;
use super::family_cut::FamilyCut;
use super::proportion_error::ProportionError;
use super::shape::Cut;
use brillianteer_math::{NotConvex, Plane, Polytope, TriangleMesh};

/// The stone of a family.
#[derive(Debug, Clone, PartialEq)]
pub enum FamilySolid {
    /// A convex stone, and the names of its facets in their order.
    Convex(Polytope, Vec<String>),
    /// A stone that is not convex: its triangles, with the names of its facets.
    Mesh(Box<TriangleMesh>),
}

impl FamilyCut {
    /// Returns every facet's name, no two alike, and its plane with a unit normal. Half of the stone's
    /// [diameter](super::Outline::diameter) is 1.
    ///
    /// # Errors
    /// The error names the first limit that is crossed, and the excess; [`DesignError::NotConvex`] where the stone is
    /// not convex.
    pub fn facets(&self) -> Result<Vec<(String, Plane)>, DesignError> {
        let cut = Cut::Family(*self);
        cut.check_numbers()?;
        let (net, _) = self.settled().map_err(|unfit| cut.without_room(unfit))?;
        if net.is_half() { Err(NotConvex.into()) } else { Ok(net.named()) }
    }

    /// Builds the stone. Half of its [diameter](super::Outline::diameter) is 1.
    ///
    /// # Errors
    /// The error names the first limit that is crossed, and the excess.
    pub fn solid(&self) -> Result<FamilySolid, ProportionError> {
        let cut = Cut::Family(*self);
        cut.check_numbers()?;
        self.made().map_err(|unfit| cut.without_room(unfit))
    }

    fn made(&self) -> Result<FamilySolid, NoRoom> {
        let (net, solid) = self.settled()?;
        if net.is_half() {
            let mesh = TriangleMesh::of_groups(net.both_halves(&solid)?).map_err(|_| NoRoom::default())?;
            return Ok(FamilySolid::Mesh(Box::new(mesh)));
        }
        let named = net.named();
        let names = solid.facets().iter().map(|facet| named[facet.source].0.clone()).collect();
        Ok(FamilySolid::Convex(solid, names))
    }
}
