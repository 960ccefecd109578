//! A solid of either kind: between planes, or within triangles.

use super::{Plane, Polytope, Shell};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// What a stone's shape can be.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// Convex, between planes.
    Convex(Polytope),
    /// Within triangles; it need not be convex. Shared, as it may be large.
    Triangles(Arc<Shell>),
}

/// A solid that something else owns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SolidRef<'a> {
    /// Convex, between planes.
    Convex(&'a Polytope),
    /// Within triangles.
    Triangles(&'a Arc<Shell>),
}

/// What only a convex stone between planes has: facets to name and draw, and exact beams.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("this takes a convex stone, given by its planes, and this one is made of triangles: rays show it")]
pub struct NotConvex;

/// An edge between two facets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Its ends.
    pub ends: [DVec3; 2],
    /// The facets on both sides.
    pub facets: [u32; 2],
}

impl Solid {
    /// The same, to be lent.
    pub fn by_ref(&self) -> SolidRef<'_> {
        match self {
            Self::Convex(polytope) => SolidRef::Convex(polytope),
            Self::Triangles(shell) => SolidRef::Triangles(shell),
        }
    }

    /// The polytope of a convex solid, for what needs one.
    ///
    /// # Errors
    /// Of triangles, even where they are convex.
    pub fn polytope(&self) -> Result<&Polytope, NotConvex> {
        match self {
            Self::Convex(polytope) => Ok(polytope),
            Self::Triangles(_) => Err(NotConvex),
        }
    }

    /// Its corners.
    pub fn vertices(&self) -> &[DVec3] {
        self.by_ref().vertices()
    }

    /// The smallest box with sides along the axes that holds it: (least, greatest) coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.by_ref().bounds()
    }

    /// Enclosed volume.
    pub fn volume(&self) -> f64 {
        self.by_ref().volume()
    }

    /// The same solid elsewhere: scaled by a factor above 0, turned, then shifted.
    pub fn moved(&self, scale: f64, turn: DQuat, shift: DVec3) -> Self {
        match self {
            Self::Convex(polytope) => Self::Convex(polytope.moved(scale, turn, shift)),
            Self::Triangles(shell) => Self::Triangles(Arc::new(shell.moved(scale, turn, shift))),
        }
    }
}

impl<'a> SolidRef<'a> {
    /// Its corners.
    pub fn vertices(self) -> &'a [DVec3] {
        match self {
            Self::Convex(polytope) => polytope.vertices(),
            Self::Triangles(shell) => shell.vertices(),
        }
    }

    /// The smallest box with sides along the axes that holds it: (least, greatest) coordinates.
    pub fn bounds(self) -> (DVec3, DVec3) {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        self.vertices().iter().fold(start, |(low, high), &v| (low.min(v), high.max(v)))
    }

    /// Enclosed volume.
    pub fn volume(self) -> f64 {
        match self {
            Self::Convex(polytope) => polytope.volume(),
            Self::Triangles(shell) => shell.volume(),
        }
    }

    /// A solid of one's own.
    pub fn owned(self) -> Solid {
        match self {
            Self::Convex(polytope) => Solid::Convex(polytope.clone()),
            Self::Triangles(shell) => Solid::Triangles(Arc::clone(shell)),
        }
    }

    /// The plane of a facet.
    pub fn plane(self, facet: u32) -> Plane {
        match self {
            Self::Convex(polytope) => polytope.facets()[facet as usize].plane,
            Self::Triangles(shell) => shell.planes()[facet as usize],
        }
    }

    /// Triangles that cover a facet.
    pub fn triangles_of(self, facet: u32) -> Vec<[DVec3; 3]> {
        match self {
            Self::Convex(polytope) => {
                let corners: Vec<DVec3> = polytope.corners(&polytope.facets()[facet as usize]).collect();
                corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]).collect()
            }
            Self::Triangles(shell) => {
                shell.triangles_of(facet).map(|t| t.map(|v| shell.vertices()[v as usize])).collect()
            }
        }
    }

    /// The edges around a facet.
    pub fn rim(self, facet: u32) -> Vec<[DVec3; 2]> {
        match self {
            Self::Convex(polytope) => {
                let corners: Vec<DVec3> = polytope.corners(&polytope.facets()[facet as usize]).collect();
                (0..corners.len()).map(|i| [corners[i], corners[(i + 1) % corners.len()]]).collect()
            }
            Self::Triangles(shell) => shell.rim(facet),
        }
    }

    /// Its edges, each once.
    pub fn edges(self) -> Vec<Edge> {
        match self {
            Self::Convex(polytope) => edges_of_polytope(polytope),
            Self::Triangles(shell) => shell.edges(),
        }
    }
}

fn edges_of_polytope(polytope: &Polytope) -> Vec<Edge> {
    let mut edges = vec![];
    for (k, facet) in (0..).zip(polytope.facets()) {
        let corners: Vec<DVec3> = polytope.corners(facet).collect();
        for (i, &other) in facet.neighbours.iter().enumerate() {
            // Each edge once: its other facet has it too.
            if other >= k {
                edges.push(Edge { ends: [corners[i], corners[(i + 1) % corners.len()]], facets: [k, other] });
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

impl From<Shell> for Solid {
    fn from(shell: Shell) -> Self {
        Self::Triangles(Arc::new(shell))
    }
}

impl<'a> From<&'a Polytope> for SolidRef<'a> {
    fn from(polytope: &'a Polytope) -> Self {
        Self::Convex(polytope)
    }
}

impl<'a> From<&'a Arc<Shell>> for SolidRef<'a> {
    fn from(shell: &'a Arc<Shell>) -> Self {
        Self::Triangles(shell)
    }
}

impl<'a> From<&'a Solid> for SolidRef<'a> {
    fn from(solid: &'a Solid) -> Self {
        solid.by_ref()
    }
}
