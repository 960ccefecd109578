//! A stone: a polytope whose facets have names.

use brillianteer_cut::Outline;
use brillianteer_math::{Plane, Polytope, PolytopeError, Pose};
use glam::DVec2;
use std::borrow::Cow;

/// A stone whose middle lies nearer to the axis than this part of its width is centred. This is more than the
/// rounding to six digits in cutters' files, and invisible.
const CENTRED: f64 = 1e-4;

/// A convex stone. Lengths are in girdle radii; +z points out of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Stone {
    /// The stone's shape.
    pub polytope: Polytope,
    names: Vec<String>,
}

impl Stone {
    /// Makes the solid between named planes.
    ///
    /// # Errors
    /// The planes enclose no solid; [`PolytopeError`] refers to the planes by their place in the list.
    pub fn new(facets: &[(String, Plane)]) -> Result<Self, PolytopeError> {
        let planes: Vec<Plane> = facets.iter().map(|(_, plane)| *plane).collect();
        let polytope = Polytope::from_planes(&planes)?;
        let names = polytope.facets().iter().map(|f| facets[f.source].0.clone()).collect();
        Ok(Self { polytope, names })
    }

    /// Makes a stone of a solid and the names of its facets, in their order.
    pub fn named(polytope: Polytope, names: Vec<String>) -> Self {
        Self { polytope, names }
    }

    /// Returns the name of a facet of the polytope, by its place in [`Polytope::facets`]; facets without names are numbered
    /// from 1.
    pub fn name(&self, facet: u32) -> Cow<'_, str> {
        match self.names.get(facet as usize) {
            Some(name) => name.into(),
            None => format!("facet {}", facet + 1).into(),
        }
    }

    /// Makes a stone whose facets have no names.
    pub fn nameless(polytope: Polytope) -> Self {
        Self { polytope, names: vec![] }
    }

    /// Returns the same stone in the frame of all stones, if its own frame had another unit.
    ///
    /// The stone is scaled so that half its diameter is 1, and moved so that its middle lies on the axis and the
    /// girdle's upper edge at z = 0. It is returned with the pose that carries its own frame into that one.
    pub fn girdled(&self) -> (Self, Pose) {
        let outline = Outline::of(&self.polytope);
        let scale = 2.0 / outline.diameter;
        // A stone that lies on the axis except for the last digits is not shifted, so that no digit changes.
        let off =
            if outline.middle.length() > CENTRED * outline.width { outline.middle } else { DVec2::ZERO };
        let at = -scale * off.extend(outline.girdle_top);
        let pose = Pose { at, scale, ..Pose::STILL };
        (Self { polytope: self.polytope.reframed(&pose), names: self.names.clone() }, pose)
    }

    /// Returns the same stone with frosted facets, as [`Polytope::frosted`] says.
    pub fn frosted(self, of_plane: impl Fn(usize) -> f64) -> Self {
        Self { polytope: self.polytope.frosted(of_plane), ..self }
    }

    /// Returns all names, in the order of the facets; none where facets have no names.
    pub fn names(&self) -> &[String] {
        &self.names
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn facets_without_names_are_numbered() {
        let sides = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|normal| [normal, -normal]);
        let facets: Vec<(String, Plane)> =
            sides.map(|normal| ("side".to_owned(), Plane { normal, offset: 1.0 })).collect();
        let named = Stone::new(&facets).unwrap();
        let nameless = Stone::nameless(named.polytope.clone());
        assert_eq!([named.name(5), nameless.name(0), nameless.name(5)], ["side", "facet 1", "facet 6"]);
    }
}
