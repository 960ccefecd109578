//! A solid of any kind: between planes, within triangles, or within a smooth surface.

use super::{ImplicitSurface, Polytope, SmoothSolid, Surface, TriangleMesh};
use glam::{DQuat, DVec3};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The shape of a stone.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// Convex, between planes.
    Convex(Polytope),
    /// Within triangles, which need not form a convex solid. Shared, because it may be large.
    Triangles(Arc<TriangleMesh>),
    /// Within a smooth surface.
    Smooth(SmoothSolid),
}

/// A solid that is borrowed from its owner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SolidRef<'a> {
    /// Convex, between planes.
    Convex(&'a Polytope),
    /// Within triangles.
    Triangles(&'a Arc<TriangleMesh>),
    /// Within a smooth surface.
    Smooth(&'a SmoothSolid),
}

/// The error where a convex stone between planes is needed: only that has facets to name and draw, and exact beams.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("exact beams and drawings are for convex stones between planes, and this is not one: use rays")]
pub struct NotConvex;

/// An edge between two facets, or a line on a smooth surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// The two ends.
    pub ends: [DVec3; 2],
    /// The outward normals of the facets on both sides; on a smooth surface, the normals at both ends.
    pub normals: [DVec3; 2],
}

impl Solid {
    /// Borrows the solid.
    pub fn by_ref(&self) -> SolidRef<'_> {
        match self {
            Self::Convex(polytope) => SolidRef::Convex(polytope),
            Self::Triangles(shell) => SolidRef::Triangles(shell),
            Self::Smooth(smooth) => SolidRef::Smooth(smooth),
        }
    }

    /// Returns the polytope of a convex solid.
    ///
    /// # Errors
    /// Returns [`NotConvex`] for a solid of any other kind, even where it is convex.
    pub fn polytope(&self) -> Result<&Polytope, NotConvex> {
        match self {
            Self::Convex(polytope) => Ok(polytope),
            Self::Triangles(_) | Self::Smooth(_) => Err(NotConvex),
        }
    }

    /// Returns the corners; for a smooth solid, points that it lies between.
    pub fn vertices(&self) -> &[DVec3] {
        self.by_ref().vertices()
    }

    /// Returns the smallest box with sides along the axes that holds the solid, as (least, greatest) coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.by_ref().bounds()
    }

    /// Returns the enclosed volume.
    pub fn volume(&self) -> f64 {
        self.by_ref().volume()
    }

    /// Returns the same solid scaled by a factor above 0, turned, then shifted.
    pub fn moved(&self, scale: f64, turn: DQuat, shift: DVec3) -> Self {
        match self {
            Self::Convex(polytope) => Self::Convex(polytope.moved(scale, turn, shift)),
            Self::Triangles(shell) => Self::Triangles(Arc::new(shell.moved(scale, turn, shift))),
            Self::Smooth(smooth) => Self::Smooth(smooth.moved(scale, turn, shift)),
        }
    }
}

impl<'a> SolidRef<'a> {
    /// Returns the corners; for a smooth solid, points that it lies between.
    pub fn vertices(self) -> &'a [DVec3] {
        match self {
            Self::Convex(polytope) => polytope.vertices(),
            Self::Triangles(shell) => shell.vertices(),
            Self::Smooth(smooth) => smooth.corners(),
        }
    }

    /// Returns the smallest box with sides along the axes that holds the solid, as (least, greatest) coordinates.
    pub fn bounds(self) -> (DVec3, DVec3) {
        if let Self::Smooth(smooth) = self {
            return smooth.field().bounds();
        }
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        self.vertices().iter().fold(start, |(low, high), &v| (low.min(v), high.max(v)))
    }

    /// Returns the enclosed volume.
    pub fn volume(self) -> f64 {
        match self {
            Self::Convex(polytope) => polytope.volume(),
            Self::Triangles(shell) => shell.volume(),
            Self::Smooth(smooth) => smooth.field().volume(),
        }
    }

    /// Returns a solid that owns its data.
    pub fn owned(self) -> Solid {
        match self {
            Self::Convex(polytope) => Solid::Convex(polytope.clone()),
            Self::Triangles(shell) => Solid::Triangles(Arc::clone(shell)),
            Self::Smooth(smooth) => Solid::Smooth(smooth.clone()),
        }
    }

    /// Returns the unit outward normal at a point of a facet.
    pub fn normal(self, facet: u32, point: DVec3) -> DVec3 {
        match self {
            Self::Convex(polytope) => polytope.facets()[facet as usize].plane.normal,
            Self::Triangles(shell) => shell.planes()[facet as usize].normal,
            Self::Smooth(smooth) => smooth.field().normal(point),
        }
    }

    /// Returns triangles that cover a facet.
    pub fn triangles_of(self, facet: u32) -> Vec<[DVec3; 3]> {
        match self {
            Self::Convex(polytope) => {
                let corners: Vec<DVec3> = polytope.corners(&polytope.facets()[facet as usize]).collect();
                corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]).collect()
            }
            Self::Triangles(shell) => picked(shell.surface(), shell.facets(), facet),
            Self::Smooth(smooth) => picked(smooth.surface(), &smooth.surface().groups, facet),
        }
    }

    /// Returns the edges around a facet.
    pub fn rim(self, facet: u32) -> Vec<[DVec3; 2]> {
        let sides: Vec<[DVec3; 2]> =
            self.triangles_of(facet).into_iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        // A side within the facet belongs to another of its triangles as well, which runs along it in the other direction.
        let key = |ends: [DVec3; 2]| ends.map(|v| v.to_array().map(f64::to_bits));
        let all: BTreeSet<_> = sides.iter().map(|ends| key(*ends)).collect();
        sides.into_iter().filter(|[a, b]| !all.contains(&key([*b, *a]))).collect()
    }

    /// Returns the edges, each once; for a smooth solid, the lines between its triangles.
    pub fn edges(self) -> Vec<Edge> {
        match self {
            Self::Convex(polytope) => edges_of_polytope(polytope),
            Self::Triangles(shell) => shell.edges(),
            Self::Smooth(smooth) => smooth.edges(),
        }
    }
}

/// Returns the triangles of one facet, where `facets` holds the facet of each triangle.
fn picked(surface: &Surface, facets: &[u32], facet: u32) -> Vec<[DVec3; 3]> {
    let all = surface.triangles.iter().zip(facets).filter(|(_, own)| **own == facet);
    all.map(|(t, _)| t.map(|v| surface.vertices[v as usize])).collect()
}

fn edges_of_polytope(polytope: &Polytope) -> Vec<Edge> {
    let mut edges = vec![];
    for (k, facet) in (0..).zip(polytope.facets()) {
        let corners: Vec<DVec3> = polytope.corners(facet).collect();
        for (i, &other) in facet.neighbours.iter().enumerate() {
            // The other facet has the edge too, so only the first of the two adds it.
            if other >= k {
                edges.push(Edge {
                    ends: [corners[i], corners[(i + 1) % corners.len()]],
                    normals: [k, other].map(|f| polytope.facets()[f as usize].plane.normal),
                });
            }
        }
    }
    edges
}

impl From<Polytope> for Solid {
    fn from(polytope: Polytope) -> Self {
        Self::Convex(polytope)
    }
}

impl From<TriangleMesh> for Solid {
    fn from(shell: TriangleMesh) -> Self {
        Self::Triangles(Arc::new(shell))
    }
}

impl From<ImplicitSurface> for Solid {
    fn from(field: ImplicitSurface) -> Self {
        Self::Smooth(SmoothSolid::new(field))
    }
}

impl<'a> From<&'a SmoothSolid> for SolidRef<'a> {
    fn from(smooth: &'a SmoothSolid) -> Self {
        Self::Smooth(smooth)
    }
}

impl<'a> From<&'a Polytope> for SolidRef<'a> {
    fn from(polytope: &'a Polytope) -> Self {
        Self::Convex(polytope)
    }
}

impl<'a> From<&'a Arc<TriangleMesh>> for SolidRef<'a> {
    fn from(shell: &'a Arc<TriangleMesh>) -> Self {
        Self::Triangles(shell)
    }
}

impl<'a> From<&'a Solid> for SolidRef<'a> {
    fn from(solid: &'a Solid) -> Self {
        solid.by_ref()
    }
}
