//! A closed mesh of triangles for tracing: its facets, their planes, and boxes around its triangles.

use super::extent::reach;
use super::regions::{neighbours, planes_of, regions};
use super::{Ball, Bvh, Edge, Plane, Polytope, Pose, Surface, triangulate};
use glam::DVec3;
use rayon::prelude::*;

/// The distance by which a solid may reach beyond the plane of a facet and still count as lying behind it, as a part
/// of its radius: the rounding of corners to f32, and less than a pixel of any picture.
const BEYOND: f64 = 1e-6;

/// A closed solid of triangles, which need not be convex. Neighbouring triangles in one plane form one facet.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleMesh {
    surface: Surface,
    facets: Vec<u32>,
    planes: Vec<Plane>,
    /// True for each facet beyond whose plane the solid reaches.
    is_overtopped: Vec<bool>,
    bvh: Bvh,
    /// A ball around all corners.
    pub(super) ball: Ball,
    /// The distance of the farthest corner from the origin.
    pub(super) reach: f64,
}

/// The reason why triangles enclose no solid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TriangleMeshError {
    /// The surface has fewer than the four triangles that a solid needs.
    #[error("{0} triangles enclose nothing; at least four are needed")]
    TooFew(usize),
    /// A triangle names a corner that does not exist.
    #[error("triangle {triangle} names corner {corner}, which is not among the {count} given")]
    NoCorner {
        /// The triangle, counted from 0.
        triangle: usize,
        /// The corner that the triangle names.
        corner: u32,
        /// The number of corners.
        count: usize,
    },
    /// A coordinate of a corner is NaN, or too large for volumes to be computed.
    #[error("corner {corner} is at {at}; coordinates must be numbers from -{LARGEST:e} to {LARGEST:e}")]
    NotFinite {
        /// The corner, counted from 0.
        corner: usize,
        /// The coordinates given for it.
        at: DVec3,
    },
    /// An edge has triangles on one side only.
    #[error(
        "the surface is open at the edge between corners {0} and {1}; close the hole or weld its corners"
    )]
    Open(u32, u32),
    /// The surface encloses nothing, or its triangles face inward.
    #[error(
        "the surface encloses a volume of {0}; its triangles must run counter-clockwise seen from outside"
    )]
    InsideOut(f64),
}

/// The largest coordinate that is accepted, so that volumes do not overflow.
const LARGEST: f64 = 1e60;

impl TriangleMesh {
    /// Finds the facets of a surface and builds the boxes around its triangles. This takes a few seconds for a
    /// million triangles.
    ///
    /// # Errors
    /// Fails where the triangles enclose nothing. The error names triangles and corners by their places in the lists
    /// that were given.
    pub fn new(surface: Surface) -> Result<Self, TriangleMeshError> {
        checked(&surface)?;
        let facets = regions(&surface)?;
        let planes = planes_of(&surface, &facets);
        let mesh = Self::of_parts(surface, facets, planes);
        let volume = mesh.volume();
        if volume > 0.0 { Ok(mesh) } else { Err(TriangleMeshError::InsideOut(volume)) }
    }

    /// Makes the mesh of a surface in which each group is one facet, flat and with at least one triangle.
    ///
    /// # Errors
    /// Fails where [`new`](Self::new) does.
    pub fn of_groups(surface: Surface) -> Result<Self, TriangleMeshError> {
        checked(&surface)?;
        neighbours(&surface.triangles)?;
        let (facets, planes) = (surface.groups.clone(), planes_of(&surface, &surface.groups));
        let mesh = Self::of_parts(surface, facets, planes);
        let volume = mesh.volume();
        if volume > 0.0 { Ok(mesh) } else { Err(TriangleMeshError::InsideOut(volume)) }
    }

    /// Makes the mesh of a convex solid; the facets keep their order.
    pub fn of_polytope(polytope: &Polytope) -> Self {
        let mesh = triangulate(polytope);
        let surface = Surface::new(mesh.vertices, mesh.triangles);
        Self::of_parts(surface, mesh.facets, polytope.planes().collect())
    }

    /// Builds the same solid in the frame to which a pose carries it. Facets and triangles keep their order.
    ///
    /// This is for a mesh that is brought into the frame of all stones; scenes carry their meshes by a pose instead.
    pub fn reframed(&self, pose: &Pose) -> Self {
        let vertices = self.vertices().iter().map(|&v| pose.place(v)).collect();
        let planes = self.planes.iter().map(|plane| plane.placed(pose)).collect();
        Self::of_parts(Surface::new(vertices, self.surface.triangles.clone()), self.facets.clone(), planes)
    }

    /// Builds the boxes and the ball around the triangles of known facets.
    fn of_parts(surface: Surface, facets: Vec<u32>, planes: Vec<Plane>) -> Self {
        let normal = |triangle: u32| planes[facets[triangle as usize] as usize].normal;
        let bvh = Bvh::new(&surface.vertices, &surface.triangles).with_normals(normal);
        let (ball, reach) = (Ball::around(&surface.vertices), reach(&surface.vertices));
        let is_beyond = |plane: &Plane| bvh.reaches_beyond(plane, BEYOND * ball.radius);
        let is_overtopped = planes.par_iter().map(is_beyond).collect();
        Self { surface, facets, planes, is_overtopped, bvh, ball, reach }
    }

    /// Returns the triangles.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Returns the corners.
    pub fn vertices(&self) -> &[DVec3] {
        &self.surface.vertices
    }

    /// Returns the facet that each triangle belongs to.
    pub fn facets(&self) -> &[u32] {
        &self.facets
    }

    /// Returns the names of the facets, where the surface has one group with a name for each facet; otherwise an
    /// empty list.
    pub fn facet_names(&self) -> Vec<&str> {
        let Surface { names, groups, .. } = &self.surface;
        if names.len() != self.planes.len() || names.iter().any(String::is_empty) {
            return vec![];
        }
        let mut found = vec![""; names.len()];
        for (&facet, &group) in self.facets.iter().zip(groups) {
            found[facet as usize] = names.get(group as usize).map_or("", String::as_str);
        }
        found
    }

    /// Returns the plane of each facet; its normal points outward.
    pub fn planes(&self) -> &[Plane] {
        &self.planes
    }

    /// Returns whether light that leaves the solid through a facet may meet the solid again. It never does where the
    /// whole solid lies behind the facet's plane.
    pub fn is_overtopped(&self, facet: usize) -> bool {
        self.is_overtopped[facet]
    }

    /// Returns the boxes around the triangles.
    pub fn bvh(&self) -> &Bvh {
        &self.bvh
    }

    /// Returns the edges between facets, each once, in pieces that are sides of triangles.
    pub fn edges(&self) -> Vec<Edge> {
        let Surface { vertices, triangles, .. } = &self.surface;
        // The surface was checked to be closed when the mesh was made.
        let beside = neighbours(triangles).unwrap_or_default();
        let facet = |k: u32| self.facets[k as usize];
        let edge = |k: u32, i: usize| {
            let (own, other) = (&triangles[k as usize], beside[k as usize][i]);
            let ends = [own[i], own[(i + 1) % 3]].map(|v| vertices[v as usize]);
            let normals = || [k, other].map(|k| self.planes[facet(k) as usize].normal);
            (k < other && facet(k) != facet(other)).then(|| Edge { ends, normals: normals() })
        };
        (0..beside.len() as u32).flat_map(|k| (0..3).filter_map(move |i| edge(k, i))).collect()
    }

    /// Returns the enclosed volume.
    pub fn volume(&self) -> f64 {
        let apex = self.surface.vertices[0];
        let six_fold = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| self.surface.vertices[v as usize] - apex);
            a.dot(b.cross(c))
        };
        self.surface.triangles.iter().map(six_fold).sum::<f64>() / 6.0
    }
}

fn checked(surface: &Surface) -> Result<(), TriangleMeshError> {
    let Surface { vertices, triangles, .. } = surface;
    if triangles.len() < 4 {
        return Err(TriangleMeshError::TooFew(triangles.len()));
    }
    let is_far = |v: &DVec3| v.is_nan() || v.abs().max_element() > LARGEST;
    if let Some(corner) = vertices.iter().position(is_far) {
        return Err(TriangleMeshError::NotFinite { corner, at: vertices[corner] });
    }
    let beyond = |(triangle, t): (usize, &[u32; 3])| {
        let corner = t.iter().copied().find(|&v| v as usize >= vertices.len())?;
        Some(TriangleMeshError::NoCorner { triangle, corner, count: vertices.len() })
    };
    triangles.iter().enumerate().find_map(beyond).map_or(Ok(()), Err)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solids::{self, Triangles, extruded};
    use glam::DQuat;
    use std::sync::Arc;

    fn surface((vertices, triangles): Triangles) -> Surface {
        Surface::new(vertices, triangles)
    }

    fn heart() -> Surface {
        surface(solids::heart())
    }

    fn cube() -> TriangleMesh {
        let square = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(glam::DVec2::from);
        TriangleMesh::new(surface(extruded(&square, 1.0))).unwrap()
    }

    #[test]
    fn triangles_in_one_plane_are_one_facet() {
        let cube = cube();
        assert_eq!((cube.surface().triangles.len() > 12, cube.planes().len()), (true, 6));
        assert!((cube.volume() - 8.0).abs() < 1e-12);
        for (t, &facet) in cube.surface().triangles.iter().zip(cube.facets()) {
            let plane = cube.planes()[facet as usize];
            assert!(t.iter().all(|&v| plane.distance(cube.vertices()[v as usize]).abs() < 1e-12));
        }
        // The star of five points has a pyramid on each side: two times ten facets of one triangle each.
        assert_eq!(TriangleMesh::new(surface(solids::star())).unwrap().planes().len(), 20);
        let heart = TriangleMesh::new(heart()).unwrap();
        assert!(heart.planes().len() > 20 && heart.planes().len() <= heart.facets().len());
    }

    #[test]
    fn its_edges_are_those_between_facets() {
        let planes = [DVec3::X, DVec3::Y, DVec3::Z]
            .into_iter()
            .flat_map(|a| [Plane::new(a, 1.0), Plane::new(-a, 1.0)]);
        let polytope = Polytope::from_planes(&planes.collect::<Vec<_>>()).unwrap();
        let total = |edges: &[Edge]| edges.iter().map(|e| e.ends[0].distance(e.ends[1])).sum::<f64>();
        let (a, b) = (crate::SolidRef::from(&polytope).edges(), cube().edges());
        assert_eq!((a.len(), b.len()), (12, 12));
        assert!((total(&a) - 24.0).abs() < 1e-12 && (total(&b) - 24.0).abs() < 1e-12);
        assert!(a.iter().chain(&b).all(|e| e.normals[0].dot(e.normals[1]).abs() < 1e-12));
        let cube = Arc::new(cube());
        for solid in [crate::SolidRef::from(&polytope), crate::SolidRef::from(&cube)] {
            for facet in 0..6 {
                let rim: f64 = solid.rim(facet).iter().map(|[a, b]| a.distance(*b)).sum();
                let area = |[a, b, c]: &[DVec3; 3]| {
                    0.5 * (*b - *a).cross(*c - *a).dot(solid.normal(facet, DVec3::ZERO))
                };
                let area: f64 = solid.triangles_of(facet).iter().map(area).sum();
                assert!((rim - 8.0).abs() < 1e-12 && (area - 4.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn light_may_come_back_only_to_facets_beyond_which_the_solid_reaches() {
        assert!((0..6).all(|facet| !cube().is_overtopped(facet)));
        let mut kinds = [0; 2];
        for solid in [solids::heart(), solids::star(), solids::clasp(0.5)] {
            let mesh = TriangleMesh::new(surface(solid)).unwrap();
            let farthest =
                |plane: &Plane| mesh.vertices().iter().map(|&v| plane.distance(v)).fold(0.0, f64::max);
            let overtopped = mesh.planes().iter().map(|plane| farthest(plane) > 1e-3);
            let found = (0..mesh.planes().len()).map(|facet| mesh.is_overtopped(facet));
            assert!(found.clone().eq(overtopped));
            found.for_each(|is| kinds[usize::from(is)] += 1);
        }
        assert!(kinds.iter().all(|&count| count > 0), "{kinds:?}");
    }

    #[test]
    fn rounding_of_f32_does_not_part_a_facet_and_a_bend_that_can_be_seen_does() {
        let rough = |v: &DVec3| (*v * 1.234_567).as_vec3().as_dvec3();
        let Surface { vertices, triangles, .. } = cube().surface().clone();
        let turned = |v: &DVec3| DQuat::from_rotation_x(0.3) * DQuat::from_rotation_y(0.7) * *v;
        let rounded = vertices.iter().map(turned).map(|v| rough(&v)).collect();
        assert_eq!(TriangleMesh::new(Surface::new(rounded, triangles.clone())).unwrap().planes().len(), 6);
        // One corner of the cube, where three facets meet, is moved a little.
        let mut bent = vertices;
        bent[0] += DVec3::splat(1e-4);
        assert!(TriangleMesh::new(Surface::new(bent, triangles)).unwrap().planes().len() > 6);
    }

    #[test]
    fn a_moved_shell_is_the_shell_of_what_was_moved() {
        let (mesh, turn, shift) =
            (TriangleMesh::new(heart()).unwrap(), DQuat::from_rotation_y(0.4), DVec3::new(3.0, -1.0, 0.5));
        let moved = mesh.reframed(&Pose { scale: 2.0, turn, at: shift });
        let anew = TriangleMesh::new(moved.surface().clone()).unwrap();
        assert_eq!(moved.facets(), anew.facets());
        for (a, b) in moved.planes().iter().zip(anew.planes()) {
            assert!(a.normal.distance(b.normal) < 1e-12 && (a.offset - b.offset).abs() < 1e-12);
        }
        assert!((moved.volume() / mesh.volume() - 8.0).abs() < 1e-12);
    }

    #[test]
    fn what_encloses_nothing_is_refused_with_what_is_at_fault() {
        let good = cube().surface().clone();
        let told = |change: &dyn Fn(&mut Surface)| {
            let mut surface = good.clone();
            change(&mut surface);
            TriangleMesh::new(surface).unwrap_err()
        };
        assert_eq!(told(&|s| s.triangles.truncate(3)), TriangleMeshError::TooFew(3));
        let missing = TriangleMeshError::NoCorner { triangle: 2, corner: 99, count: good.vertices.len() };
        assert_eq!(told(&|s| s.triangles[2][1] = 99), missing);
        let missing = told(&|s| s.vertices[3] = DVec3::new(1.0, f64::NAN, 0.0)).to_string();
        assert_eq!(missing, "corner 3 is at [1, NaN, 0]; coordinates must be numbers from -1e60 to 1e60");
        let far = told(&|s| s.vertices[1].x = 1e200);
        assert!(matches!(far, TriangleMeshError::NotFinite { corner: 1, at } if at.x == 1e200), "{far}");
        assert!(matches!(
            told(&|s| s.triangles.truncate(s.triangles.len() - 1)),
            TriangleMeshError::Open(..)
        ));
        assert!(matches!(told(&|s| s.triangles[0].swap(0, 1)), TriangleMeshError::Open(..)));
        let reversed = told(&|s| s.triangles.iter_mut().for_each(|t| t.swap(0, 1)));
        assert!(matches!(reversed, TriangleMeshError::InsideOut(v) if (v + 8.0).abs() < 1e-12), "{reversed}");
    }

    #[test]
    fn a_polytopes_shell_has_its_facets() {
        let planes = [DVec3::X, DVec3::Y, DVec3::Z]
            .into_iter()
            .flat_map(|a| [Plane::new(a, 1.0), Plane::new(-a, 1.0)])
            .chain([Plane::new(DVec3::ONE, 2.2)]);
        let polytope = Polytope::from_planes(&planes.collect::<Vec<_>>()).unwrap();
        let mesh = TriangleMesh::of_polytope(&polytope);
        assert!(mesh.planes().iter().copied().eq(polytope.planes()));
        let anew = TriangleMesh::new(mesh.surface().clone()).unwrap();
        assert_eq!(anew.facets(), mesh.facets());
    }
}
