//! Finds the facets of a closed surface of triangles, and the convex solid that the surface represents: [`facets`].
//!
//! The steps, in their order; each is tried where the steps before it found nothing:
//!
//! 1. triangles that share a plane except for rounding are gathered into regions, whose planes are fitted by least squares
//!    (`regions`, `fit`); the solid between the planes must reproduce the surface (`search`);
//! 2. a surface with many corners is taken for a scan: planes are fitted to corners whose noise is estimated first (`scan`);
//! 3. a model with few corners is searched as in the first step, at growing tolerances. Planes that cut the hull of the
//!    corners are left out, and each triangle is assigned to the facet that it lies on (`settle`);
//! 4. the hull itself is taken, if the surface is meant to be its hull (`hull`).
//!
//! What the last two find in a surface that noise bends, or whose corners lie off the facets by more than noise, is refused where noise or
//! triangles across edges may have made the facets, and else called uncertain (`noisy`).
//!
//! Where the solid differs from the surface, `change` measures the differences. Lengths are in the surface's unit;
//! tolerances are parts of [`Surface::size`].

mod change;
mod deviation;
mod fit;
mod hull;
mod joint;
mod noisy;
mod plane_error;
mod regions;
mod scan;
mod search;
mod settle;

#[cfg(test)]
mod tests;

use super::{Facet, Plane, Polytope, Surface};
pub use change::Change;
pub use deviation::deviation;
use glam::DVec3;
use hull::Hull;
pub use hull::SWOLLEN;
pub use noisy::{MODELLED, Unfaceted};
use noisy::{Trust, is_noisy, trust};
pub use plane_error::PlaneError;
use regions::{NOWHERE, Regions};
use search::{MOST_FACETS, MatchingSolid, SAME, SolidSearch};

/// A region and a group of the file are the same facet if they share this part of the area of each.
const ONE: f64 = 0.99;

/// A facet that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// The plane of the facet, in the frame whose origin is [`Faceted::centre`].
    pub plane: Plane,
    /// The area of the facet's triangles.
    pub area: f64,
    /// The name of the facet in the file, where one of the file's groups is exactly this facet.
    pub name: Option<String>,
    /// The standard errors of the plane in the same frame, where the surface is a scan, whose noise is known.
    pub error: Option<PlaneError>,
    /// Whether the corners on the facet bend by more than the noise of a scan: it may be several facets that the noise hides.
    pub is_bent: bool,
}

/// A surface that represents a convex solid between planes. Lengths are in the surface's unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Faceted {
    /// The surface, with its `centre` moved to the origin.
    pub surface: Surface,
    /// The origin of the planes, in the surface's original frame.
    pub centre: DVec3,
    /// The facets, the largest first, in the order of the facets of `polytope`.
    pub faces: Vec<Face>,
    /// The solid between the planes, with the centre as its origin.
    pub polytope: Polytope,
    /// The greatest distance of a corner from the solid's surface.
    pub deviation: f64,
    /// The tolerance at which the facets were found: their corners lie within it of their planes.
    pub tolerance: f64,
    /// The differences between the solid and a surface that is not convex itself; `None` for a scan, and for a surface
    /// that is convex up to a thousandth.
    pub change: Option<Change>,
    /// Whether noise bends the surface, and it has too few corners to tell which of the facets are true, and how well they are known.
    pub is_uncertain: bool,
}

impl Faceted {
    /// Returns the greatest part of the surface's volume by which the solid may differ from it for the tolerance alone.
    pub fn volume_of_tolerance(&self) -> f64 {
        SAME * self.tolerance * self.surface.area() / self.surface.volume()
    }
}

/// The kind of solid that a closed surface represents.
#[derive(Debug, Clone, PartialEq)]
pub enum SurfaceKind {
    /// A convex solid between planes.
    Convex(Box<Faceted>),
    /// Any other solid. It is traced as triangles, exactly as it was given.
    Concave(Surface),
}

/// Finds the facets of a closed surface that [`Surface::mend`] has returned.
pub fn facets(surface: Surface) -> SurfaceKind {
    let (moved, centre) = centred(&surface);
    let search = SolidSearch::of(&moved);
    let exact = search.exact().map(|solid| (trust(&moved, &solid, false), solid));
    let is_changed = exact.is_none();
    let meant = || search.meant().map(|solid| (trust(&moved, &solid, true), solid));
    match exact.or_else(meant) {
        None | Some((Trust::OfNoise, _)) => SurfaceKind::Concave(surface),
        Some((trust, solid)) => {
            let is_uncertain = trust == Trust::Uncertain;
            let found = faceted(moved, centre, solid, is_changed);
            SurfaceKind::Convex(Box::new(Faceted { is_uncertain, ..found }))
        }
    }
}

/// Returns the convex solid around the corners of a closed surface, whatever lies between them.
///
/// Its facets are the surface's own facets where the surface is convex, and otherwise those of its hull.
///
/// # Errors
/// Fails with [`NotFaceted`] where the hull has no flat facets, or those that noise makes.
pub fn faceted_hull(surface: Surface) -> Result<Box<Faceted>, NotFaceted> {
    let surface = match facets(surface) {
        SurfaceKind::Convex(found) => return Ok(found),
        SurfaceKind::Concave(surface) => surface,
    };
    if is_noisy(&surface) {
        return Err(NotFaceted::Noisy);
    }
    hull_facets(&surface).ok_or(NotFaceted::Curved)
}

/// Returns the hull of the corners of a surface as a solid between the fewest planes that fit it, even where noise makes some
/// of them; `None` where the hull is curved, or has too many facets.
pub fn hull_facets(surface: &Surface) -> Option<Box<Faceted>> {
    let (moved, centre) = centred(surface);
    let solid = Hull::of(&moved)?.solid(&moved)?;
    Some(Box::new(faceted(moved, centre, solid, true)))
}

/// The error where a surface cannot be read as a stone with flat facets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NotFaceted {
    /// The hull of the corners is curved, or has too many facets.
    #[error("its convex hull is curved, or has more than {MOST_FACETS} facets")]
    Curved,
    /// Noise hides the facets, and those of the hull would be those that noise makes.
    #[error("its noise hides any flat facets that it has")]
    Noisy,
}

/// Returns a surface with the middle of its box at the origin, and the former place of that middle.
fn centred(surface: &Surface) -> (Surface, DVec3) {
    let (low, high) = surface.bounds();
    let centre = (low + high) / 2.0;
    (surface.moved(-centre), centre)
}

/// Returns the facets of a surface with its centre at the origin. `is_changed` is true where the surface is not
/// convex but is read as this solid nevertheless.
fn faceted(surface: Surface, centre: DVec3, solid: MatchingSolid, is_changed: bool) -> Faceted {
    let MatchingSolid { found, polytope, deviation, tolerance, errors, are_bent } = solid;
    let names = names(&surface, &found);
    let face = |(facet, f): (usize, &Facet)| Face {
        plane: found.fits[f.source].plane,
        area: found.fits[f.source].area,
        name: names[f.source].clone(),
        error: errors.as_ref().map(|errors| errors[facet]),
        is_bent: are_bent.get(facet).is_some_and(|is_bent| *is_bent),
    };
    let faces = polytope.facets().iter().enumerate().map(face).collect();
    let change = is_changed.then(|| Change::of(&surface, &polytope));
    Faceted { surface, centre, faces, polytope, deviation, tolerance, change, is_uncertain: false }
}

/// Returns the name of each region that is exactly one group of the file.
fn names(surface: &Surface, found: &Regions) -> Vec<Option<String>> {
    let mut shared = std::collections::BTreeMap::<(u32, u32), f64>::new();
    let mut groups = vec![0.0; surface.names.len()];
    let mut whole = vec![0.0; found.fits.len()];
    for (t, (&group, &region)) in surface.groups.iter().zip(&found.of).enumerate() {
        let area = surface.area_vector(t).length();
        groups[group as usize] += area;
        if region != NOWHERE {
            whole[region as usize] += area;
            *shared.entry((group, region)).or_default() += area;
        }
    }
    let mut names = vec![None; found.fits.len()];
    for ((group, region), area) in shared {
        let (g, r) = (group as usize, region as usize);
        if area >= ONE * groups[g] && area >= ONE * whole[r] && !surface.names[g].trim().is_empty() {
            names[r] = Some(surface.names[g].clone());
        }
    }
    names
}
