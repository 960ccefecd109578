//! What tracing leaves behind: a tree of nested outlines, each with the light that left at its end.

use crate::math::{Affine, Basis, Symmetry};
use crate::scene::Medium;
use glam::{DVec2, DVec3};

/// The parent of a beam that has just entered.
pub(super) const ROOT: u32 = u32::MAX;

/// One beam at the facet that ends it.
#[derive(Debug, Clone, Copy)]
pub(super) struct BeamNode {
    pub parent: u32,
    pub facet: u32,
    /// First corner in [`Beams::corners`], and how many.
    pub corners: (u32, u32),
    /// Of the outline.
    pub area: f64,
    /// Direction and weight of what leaves here; weight 0 under total reflection.
    pub exit: DVec3,
    pub weight: f64,
    /// Weight of what goes on.
    pub onward: f64,
    /// Path inside the stone up to here.
    pub path: Affine,
    /// Mean over the outline of what absorption has left.
    pub transmittance: f64,
    /// Energy (weight times image area) absorbed on the last stretch.
    pub absorbed: f64,
    /// Whether what goes on was left unresolved.
    pub open: bool,
}

/// Every beam of one picture, as [`trace`](super::trace) answers.
///
/// Lengths in girdle radii; energies are weights times image areas, so that the silhouette's area is the whole.
/// Only one domain of the picture's symmetry is stored.
#[derive(Debug, Clone)]
pub struct Beams {
    /// The image's axes in the stone's frame.
    pub view: Basis,
    /// The scope's axis in the stone's frame.
    pub zenith: DVec3,
    /// The symmetry that stone, view and light share.
    pub symmetry: Symmetry,
    /// The stone's medium.
    pub medium: Medium,
    /// Whether polarisation was followed.
    pub polarised: bool,
    /// Area of the whole silhouette.
    pub silhouette_area: f64,
    /// Energy of one domain lost in slivers too small to follow, part of what is unresolved.
    pub(super) dropped: f64,
    pub(super) nodes: Vec<BeamNode>,
    pub(super) corners: Vec<DVec2>,
}

/// One beam: a virtual facet of the image, and the light that reaches the eye through it from one direction.
#[derive(Debug, Clone, Copy)]
pub struct Beam<'a> {
    /// Its place among the [`Beams`].
    pub id: u32,
    /// The beam that it is a part of, up to one bounce before; `None` for one that enters the stone here.
    pub parent: Option<u32>,
    /// The facet it ends on (for one that enters, the facet it enters by).
    pub facet: u32,
    /// Outline in the image, convex, counter-clockwise.
    pub outline: &'a [DVec2],
    /// Its area.
    pub area: f64,
    /// Unit direction, in the stone's frame, of the light that leaves here (seen from the eye: of the ray that
    /// escapes). For a beam that enters, of the surface's glare.
    pub exit: DVec3,
    /// The share of that light which reaches the eye, mean over the outline; 0 under total reflection.
    pub weight: f64,
    /// The share that goes on from here, mean over the outline.
    pub onward: f64,
    /// Whether the share that goes on was left unresolved.
    pub open: bool,
    /// Path inside the stone up to here, in girdle radii, over the image.
    pub path: Affine,
    /// What absorption has left up to here, mean over the outline: part of `weight` and `onward`.
    pub transmittance: f64,
    /// Energy absorbed on the stretch that ends here.
    pub absorbed: f64,
}

impl Beam<'_> {
    /// Whether this is where light enters, and `weight` the glare of the surface.
    pub fn is_surface(&self) -> bool {
        self.parent.is_none()
    }
}

impl Beams {
    /// How many beams were followed, in one domain of the symmetry.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are none: never so for a stone.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The beam with this id.
    pub fn get(&self, id: u32) -> Beam<'_> {
        let node = &self.nodes[id as usize];
        let (start, count) = (node.corners.0 as usize, node.corners.1 as usize);
        Beam {
            id,
            parent: (node.parent != ROOT).then_some(node.parent),
            facet: node.facet,
            outline: &self.corners[start..start + count],
            area: node.area,
            exit: node.exit,
            weight: node.weight * node.transmittance,
            onward: node.onward * node.transmittance,
            open: node.open,
            path: node.path,
            transmittance: node.transmittance,
            absorbed: node.absorbed,
        }
    }

    /// All beams; a beam's parent comes before it.
    pub fn iter(&self) -> impl Iterator<Item = Beam<'_>> + Clone {
        (0..self.nodes.len() as u32).map(|id| self.get(id))
    }

    /// The facets that a beam has met, from the one it entered by to the one it ends on.
    pub fn facets(&self, id: u32) -> Vec<u32> {
        let up = |&id: &u32| Some(self.nodes[id as usize].parent).filter(|&p| p != ROOT);
        let mut met: Vec<u32> =
            std::iter::successors(Some(id), up).map(|i| self.nodes[i as usize].facet).collect();
        met.reverse();
        met
    }

    /// The part of the silhouette's light that was not followed to its end: it bounds the error of every figure.
    pub fn unresolved(&self) -> f64 {
        let open = |n: &BeamNode| n.onward * n.transmittance * n.area;
        let left: f64 = self.nodes.iter().filter(|n| n.open).map(open).sum();
        (left + self.dropped) * f64::from(self.symmetry.order()) / self.silhouette_area
    }
}
