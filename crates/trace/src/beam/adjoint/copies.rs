//! Derivatives for the whole picture of a symmetric stone, of which one domain was followed.

use super::super::tree::Beams;
use super::PlaneDerivatives;
use brillianteer_math::{Plane, Polytope};
use glam::{DMat2, DVec3};

impl Beams {
    /// Returns the derivatives of a number of the whole picture by each plane alone, given those of the followed domain times
    /// the order of the symmetry.
    ///
    /// The picture is made of copies of the domain, and each copy changes with the images of the planes with which the
    /// domain changes. So the derivative by a plane is the mean, over all maps of the symmetry, of the image of the
    /// derivative by the plane that the map carries to it. Only then do derivatives hold for changes that break the
    /// symmetry.
    pub fn over_copies(&self, polytope: &Polytope, of_domain: PlaneDerivatives) -> PlaneDerivatives {
        let copies = self.symmetry.copies();
        if copies.len() == 1 {
            return of_domain;
        }
        let share = 1.0 / copies.len() as f64;
        let facets = polytope.facets();
        let mut found = PlaneDerivatives { index: of_domain.index, ..PlaneDerivatives::none(facets.len()) };
        for copy in copies {
            for (place, facet) in facets.iter().enumerate() {
                let (normal, offset) = (of_domain.normals[place], of_domain.offsets[place]);
                if normal == DVec3::ZERO && offset == 0.0 {
                    continue;
                }
                let carried = self.carried(copy, facet.plane.normal);
                let image = nearest(polytope, Plane { normal: carried, offset: facet.plane.offset });
                found.normals[image] += self.carried(copy, normal) * share;
                found.offsets[image] += offset * share;
            }
        }
        found
    }

    /// Returns the image of a direction under a map of the picture.
    fn carried(&self, copy: DMat2, direction: DVec3) -> DVec3 {
        let across = copy * self.view.project(direction);
        let along = self.view.toward.dot(direction);
        self.view.lift(across) + self.view.toward * along
    }
}

/// Returns the place of the facet whose plane is nearest to a plane.
fn nearest(polytope: &Polytope, plane: Plane) -> usize {
    let apart = |own: &Plane| own.normal.distance_squared(plane.normal) + (own.offset - plane.offset).powi(2);
    let facets = polytope.facets().iter().map(|facet| apart(&facet.plane)).enumerate();
    facets.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(place, _)| place)
}
