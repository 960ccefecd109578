//! A solid of any kind: between planes, within triangles, or within a smooth surface, in its own frame or carried by a pose.

use super::extent::reach;
use super::{Ball, Edge, Polytope, Pose, SmoothSolid, Surface, TriangleMesh};
use glam::DVec3;
use std::collections::BTreeSet;
use std::sync::Arc;

/// A solid, borrowed from its owner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SolidRef<'a> {
    /// A convex solid between planes.
    Convex(&'a Polytope),
    /// A solid within triangles.
    Triangles(&'a Arc<TriangleMesh>),
    /// A solid within a smooth surface.
    Smooth(&'a SmoothSolid),
}

/// The error where a convex stone between planes is needed: only its facets can be named and drawn, and only its light can
/// be followed as exact beams.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("exact beams and drawings are for convex stones between planes, and this is not one: use rays")]
pub struct NotConvex;

/// A solid in its place in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PosedSolid<'a> {
    /// The solid in its own frame.
    pub solid: SolidRef<'a>,
    /// The pose that carries it into the world.
    pub pose: Pose,
}

impl<'a> PosedSolid<'a> {
    /// Returns the corners in the world; for a smooth solid, points whose convex hull contains it.
    pub fn vertices(&self) -> impl Iterator<Item = DVec3> + use<'a> {
        let Self { solid, pose } = *self;
        solid.vertices().iter().map(move |&v| pose.place(v))
    }

    /// Returns the smallest box with sides along the world's axes that holds the solid, as (least, greatest) coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let Pose { at, turn, scale } = self.pose;
        let reach = |axis: DVec3| self.solid.support(turn.inverse() * axis) * scale;
        let [high, low] =
            [1.0, -1.0].map(|side| DVec3::from(DVec3::AXES.map(|axis| side * reach(axis * side))));
        (low + at, high + at)
    }

    /// Returns a ball around the solid, slightly enlarged to allow for rounding.
    pub fn ball(&self) -> Ball {
        let Ball { middle, radius } = self.solid.ball();
        Ball { middle: self.pose.place(middle), radius: radius * self.pose.scale * (1.0 + 1e-5) }
    }

    /// Returns a distance from the world's origin that no corner exceeds; for a solid that is not moved, the distance
    /// of the farthest corner.
    pub fn reach(&self) -> f64 {
        self.solid.reach() * self.pose.scale + self.pose.at.length()
    }
}

impl<'a> SolidRef<'a> {
    /// Returns the corners; for a smooth solid, points whose convex hull contains it.
    pub fn vertices(self) -> &'a [DVec3] {
        match self {
            Self::Convex(polytope) => polytope.vertices(),
            Self::Triangles(mesh) => mesh.vertices(),
            Self::Smooth(smooth) => smooth.corners(),
        }
    }

    /// Returns the smallest box with sides along the axes that holds the solid, as (least, greatest) coordinates.
    pub fn bounds(self) -> (DVec3, DVec3) {
        PosedSolid { solid: self, pose: Pose::STILL }.bounds()
    }

    /// Returns the greatest coordinate along a unit direction.
    pub fn support(self, direction: DVec3) -> f64 {
        if let Self::Smooth(smooth) = self {
            return smooth.field().support(direction);
        }
        self.vertices().iter().map(|v| v.dot(direction)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns a ball around the solid.
    pub fn ball(self) -> Ball {
        if let Self::Triangles(mesh) = self { mesh.ball } else { Ball::around(self.vertices()) }
    }

    /// Returns the distance of the farthest corner from the origin.
    pub fn reach(self) -> f64 {
        if let Self::Triangles(mesh) = self { mesh.reach } else { reach(self.vertices()) }
    }

    /// Returns the solid as triangles. Those of a smooth solid approximate its surface from within; `None` where they
    /// enclose nothing.
    pub fn mesh(self) -> Option<Arc<TriangleMesh>> {
        match self {
            Self::Convex(polytope) => Some(Arc::new(TriangleMesh::of_polytope(polytope))),
            Self::Triangles(mesh) => Some(Arc::clone(mesh)),
            Self::Smooth(smooth) => TriangleMesh::new(smooth.surface().clone()).ok().map(Arc::new),
        }
    }

    /// Returns whether both are the same solid in memory, so that data built for one of them serves the other as
    /// well.
    pub fn is_same(self, other: Self) -> bool {
        match (self, other) {
            (Self::Convex(a), Self::Convex(b)) => std::ptr::eq(a, b),
            (Self::Triangles(a), Self::Triangles(b)) => Arc::ptr_eq(a, b),
            (Self::Smooth(a), Self::Smooth(b)) => std::ptr::eq(a, b),
            _ => false,
        }
    }

    /// Returns the enclosed volume.
    pub fn volume(self) -> f64 {
        match self {
            Self::Convex(polytope) => polytope.volume(),
            Self::Triangles(mesh) => mesh.volume(),
            Self::Smooth(smooth) => smooth.field().volume(),
        }
    }

    /// Returns the unit outward normal at a point of a facet.
    pub fn normal(self, facet: u32, point: DVec3) -> DVec3 {
        match self {
            Self::Convex(polytope) => polytope.facets()[facet as usize].plane.normal,
            Self::Triangles(mesh) => mesh.planes()[facet as usize].normal,
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
            Self::Triangles(mesh) => picked(mesh.surface(), mesh.facets(), facet),
            Self::Smooth(smooth) => picked(smooth.surface(), &smooth.surface().groups, facet),
        }
    }

    /// Returns the edges around a facet.
    pub fn rim(self, facet: u32) -> Vec<[DVec3; 2]> {
        let sides: Vec<[DVec3; 2]> =
            self.triangles_of(facet).into_iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        // An edge inside the facet belongs to another of its triangles as well, which runs along it in the other
        // direction.
        let key = |ends: [DVec3; 2]| ends.map(|v| v.to_array().map(f64::to_bits));
        let all: BTreeSet<_> = sides.iter().map(|ends| key(*ends)).collect();
        sides.into_iter().filter(|[a, b]| !all.contains(&key([*b, *a]))).collect()
    }

    /// Returns the edges, each once; for a smooth solid, the lines between its triangles.
    pub fn edges(self) -> Vec<Edge> {
        match self {
            Self::Convex(polytope) => edges_of_polytope(polytope),
            Self::Triangles(mesh) => mesh.edges(),
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
            // The other facet has the same edge, so only the first of the two adds it.
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
    fn from(mesh: &'a Arc<TriangleMesh>) -> Self {
        Self::Triangles(mesh)
    }
}
