//! The result of tracing beams: a tree of nested outlines, each with the light that leaves at its end.

use crate::math::{Affine, Basis, Symmetry};
use crate::scene::Medium;
use glam::{DVec2, DVec3};
use std::ops::Range;

/// The number that stands for the parent of a beam that has just entered.
pub(super) const ROOT: u32 = u32::MAX;

/// One beam, up to the facet that ends it.
#[derive(Debug, Clone, Copy)]
pub(super) struct BeamNode {
    pub parent: u32,
    pub facet: u32,
    /// The index of the first corner in [`BeamBlock::corners`], and the number of corners.
    pub corners: (u32, u32),
    /// The outline's area.
    pub area: f64,
    /// Unit direction of the light that leaves here; zero under total reflection.
    pub exit: DVec3,
    /// Weight of the light that leaves here, without absorption; 0 under total reflection.
    pub weight: f64,
    /// Weight of the light that goes on, without absorption.
    pub onward: f64,
    /// Length of the path inside the stone up to here, over the image.
    pub path: Affine,
    /// The share that absorption has left up to here, mean over the outline.
    pub transmittance: f64,
    /// Energy (weight times image area) absorbed between the facet before and this one.
    pub absorbed: f64,
    /// Whether the light that goes on was left unresolved.
    pub open: bool,
}

/// The number of beams in a block.
const BLOCK: usize = 1024;

/// The corners for which a full block has room from the beginning: some more than most blocks need.
const CORNERS: usize = 5 * BLOCK;

/// Some beams in the order of their ids, and their outlines.
#[derive(Debug, Clone, Default)]
pub(super) struct BeamBlock {
    pub nodes: Vec<BeamNode>,
    pub corners: Vec<DVec2>,
}

impl BeamBlock {
    /// Returns the outline of one of the nodes.
    pub fn outline(&self, node: &BeamNode) -> &[DVec2] {
        let (start, count) = (node.corners.0 as usize, node.corners.1 as usize);
        &self.corners[start..start + count]
    }

    /// Moves nodes with these numbers, and their outlines, to the end of another block, whose room for nodes suffices.
    fn copy_to(&self, other: &mut Self, nodes: Range<usize>) {
        let Some((first, last)) = self.nodes[nodes.clone()].first().zip(self.nodes[..nodes.end].last()) else { return };
        let corners = first.corners.0 as usize..(last.corners.0 + last.corners.1) as usize;
        let (from, to) = (first.corners.0, other.corners.len() as u32);
        let moved = |node: &BeamNode| BeamNode { corners: (node.corners.0 - from + to, node.corners.1), ..*node };
        other.nodes.extend(self.nodes[nodes].iter().map(moved));
        other.corners.extend_from_slice(&self.corners[corners]);
    }
}

/// All beams of one picture, as [`trace`](super::trace) returns them.
///
/// Lengths are in girdle radii; energies are weights times image areas, so that the silhouette's area is the whole. Only one
/// domain of the picture's symmetry is stored.
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
    /// Energy of one domain lost in slivers too small to follow; it counts as unresolved.
    pub(super) dropped: f64,
    /// All beams, in blocks of [`BLOCK`] but for the last: so none is moved while the tree grows.
    pub(super) blocks: Vec<BeamBlock>,
}

/// One beam: a virtual facet of the image, and the light that reaches the eye through it from one direction.
#[derive(Debug, Clone, Copy)]
pub struct Beam<'a> {
    /// The beam's index among the [`Beams`].
    pub id: u32,
    /// The id of the beam, one bounce earlier, of which this one is a part; `None` for a beam that enters the stone here.
    pub parent: Option<u32>,
    /// The facet on which the beam ends; for a beam that enters, the facet by which it enters.
    pub facet: u32,
    /// Outline in the image, convex, counter-clockwise.
    pub outline: &'a [DVec2],
    /// The outline's area.
    pub area: f64,
    /// Unit direction, in the stone's frame, of the light that leaves here, followed from the eye; for a beam that enters,
    /// of the surface's glare. Zero under total reflection.
    pub exit: DVec3,
    /// The share of the light from the exit direction that reaches the eye, mean over the outline; 0 under total reflection.
    pub weight: f64,
    /// The share of the light that goes on inside from here, mean over the outline.
    pub onward: f64,
    /// Whether the light that goes on was left unresolved.
    pub open: bool,
    /// Length of the path inside the stone up to here, in girdle radii, over the image.
    pub path: Affine,
    /// The share that absorption has left up to here, mean over the outline; `weight` and `onward` contain it.
    pub transmittance: f64,
    /// Energy absorbed between the facet before and this one.
    pub absorbed: f64,
}

impl Beam<'_> {
    /// Whether light enters the stone here; then `weight` is the glare of the surface.
    pub fn is_surface(&self) -> bool {
        self.parent.is_none()
    }
}

impl Beams {
    /// Returns the number of beams that were followed, in one domain of the symmetry.
    pub fn len(&self) -> usize {
        self.blocks.last().map_or(0, |last| (self.blocks.len() - 1) * BLOCK + last.nodes.len())
    }

    /// Whether there are no beams, which never happens with a stone.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// Returns the beam with this id.
    pub fn get(&self, id: u32) -> Beam<'_> {
        let (node, block) = self.node_in_block(id);
        Beam {
            id,
            parent: (node.parent != ROOT).then_some(node.parent),
            facet: node.facet,
            outline: block.outline(node),
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

    /// Returns the node of the beam with this id.
    pub(super) fn node(&self, id: u32) -> &BeamNode {
        self.node_in_block(id).0
    }

    /// Returns the node of the beam with this id, and the block in which it lies.
    pub(super) fn node_in_block(&self, id: u32) -> (&BeamNode, &BeamBlock) {
        let block = &self.blocks[id as usize / BLOCK];
        (&block.nodes[id as usize % BLOCK], block)
    }

    /// Returns the node of the beam with this id, to be changed.
    pub(super) fn node_mut(&mut self, id: u32) -> &mut BeamNode {
        &mut self.blocks[id as usize / BLOCK].nodes[id as usize % BLOCK]
    }

    /// Returns the nodes of all beams in the order of their ids.
    pub(super) fn nodes(&self) -> impl Iterator<Item = &BeamNode> {
        self.blocks.iter().flat_map(|block| &block.nodes)
    }

    /// Adds beams to the end of the tree.
    pub(super) fn extend(&mut self, beams: &BeamBlock) {
        let mut done = 0;
        while done < beams.nodes.len() {
            let room = self.blocks.len() * BLOCK - self.len();
            if room == 0 {
                let (nodes, corners) = (Vec::with_capacity(BLOCK), Vec::with_capacity(CORNERS));
                self.blocks.push(BeamBlock { nodes, corners });
            } else if let Some(last) = self.blocks.last_mut() {
                let next = beams.nodes.len().min(done + room);
                beams.copy_to(last, done..next);
                done = next;
            }
        }
    }

    /// Returns all beams; a beam's parent comes before it.
    pub fn iter(&self) -> impl Iterator<Item = Beam<'_>> + Clone {
        (0..self.len() as u32).map(|id| self.get(id))
    }

    /// Returns the facets that a beam has met, from the one by which it entered to the one on which it ends.
    pub fn facets(&self, id: u32) -> Vec<u32> {
        let up = |&id: &u32| Some(self.node(id).parent).filter(|&p| p != ROOT);
        let mut met: Vec<u32> =
            std::iter::successors(Some(id), up).map(|i| self.node(i).facet).collect();
        met.reverse();
        met
    }

    /// Returns the share of the silhouette's light that was not followed to its end; it bounds the error of every figure.
    pub fn unresolved(&self) -> f64 {
        let open = |n: &BeamNode| n.onward * n.transmittance * n.area;
        let left: f64 = self.nodes().filter(|n| n.open).map(open).sum();
        (left + self.dropped) * f64::from(self.symmetry.order()) / self.silhouette_area
    }
}
