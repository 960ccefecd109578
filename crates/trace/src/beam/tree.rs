//! The result of tracing beams: a tree of nested outlines, each with the light that leaves at its end.

use super::blocks::Blocks;
use brillianteer_math::{Affine, Basis, Symmetry};
use brillianteer_scene::Medium;
use glam::{DVec2, DVec3};

/// The number that stands for the parent of a beam that has just entered.
pub(super) const ROOT: u32 = u32::MAX;

/// The number that stands for the exit of a beam under total reflection.
pub(super) const NO_EXIT: u32 = u32::MAX;

/// One beam, up to the facet that ends it.
#[derive(Debug, Clone, Copy)]
pub(super) struct BeamNode {
    pub parent: u32,
    pub facet: u32,
    /// The index of the first corner in [`Beams::corners`], and the number of corners. A beam that lands as a whole
    /// shares its corners with its parent.
    pub corners: (u32, u32),
    /// The outline's area.
    pub area: f64,
    /// The weight of the light that goes on, without absorption.
    pub onward: f64,
    /// The length of the path inside the stone up to here, over the image.
    pub path: Affine,
    /// The index in [`Beams::exits`], or [`NO_EXIT`].
    pub exit: u32,
    /// True where the light that goes on was left unresolved.
    pub open: bool,
}

/// The light that leaves where a beam ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct BeamExit {
    /// The unit direction.
    pub direction: DVec3,
    /// The weight without absorption.
    pub weight: f64,
}

/// The light that absorption takes from a beam.
#[derive(Debug, Clone, Copy)]
pub(super) struct BeamLoss {
    /// The share that absorption has left up to here, as the mean over the outline.
    pub transmittance: f64,
    /// The energy (weight times image area) absorbed between the facet before and this one.
    pub absorbed: f64,
}

impl BeamLoss {
    /// The loss of a beam where nothing absorbs.
    pub const NONE: Self = Self { transmittance: 1.0, absorbed: 0.0 };
}

/// Beams that are to be added to a tree. Their numbers continue those of the tree.
#[derive(Default)]
pub(super) struct NewBeams {
    pub nodes: Vec<BeamNode>,
    pub corners: Vec<DVec2>,
    pub exits: Vec<BeamExit>,
    /// One loss for each node; empty where nothing absorbs.
    pub losses: Vec<BeamLoss>,
}

impl NewBeams {
    pub fn clear(&mut self) {
        let Self { nodes, corners, exits, losses } = self;
        nodes.clear();
        corners.clear();
        exits.clear();
        losses.clear();
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
    /// True where polarisation was followed.
    pub polarised: bool,
    /// The area of the whole silhouette.
    pub silhouette_area: f64,
    /// The energy of one domain lost in slivers that are too small to follow; it counts as unresolved.
    pub(super) dropped: f64,
    /// True where the limit of beams or of their memory ended the tracing before as little light was unresolved as
    /// requested.
    pub is_cut_short: bool,
    pub(super) nodes: Blocks<BeamNode>,
    pub(super) corners: Vec<DVec2>,
    pub(super) exits: Blocks<BeamExit>,
    /// One loss for each node; empty where nothing absorbs.
    pub(super) losses: Blocks<BeamLoss>,
}

/// The numbers of beams, corners and exits in a tree.
#[derive(Clone, Copy)]
pub(super) struct TreeSize {
    pub nodes: u32,
    pub corners: u32,
    pub exits: u32,
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
    /// The outline in the image, convex and counter-clockwise.
    pub outline: &'a [DVec2],
    /// The outline's area.
    pub area: f64,
    /// The unit direction, in the stone's frame, of the light that leaves here, followed from the eye; for a beam
    /// that enters, that of the surface's glare. It is zero under total reflection.
    pub exit: DVec3,
    /// The share of the light from the exit direction that reaches the eye, as the mean over the outline; 0 under
    /// total reflection.
    pub weight: f64,
    /// The share of the light that goes on inside from here, as the mean over the outline.
    pub onward: f64,
    /// True where the light that goes on was left unresolved.
    pub open: bool,
    /// The length of the path inside the stone up to here, in girdle radii, over the image.
    pub path: Affine,
    /// The share that absorption has left up to here, as the mean over the outline; `weight` and `onward` include it.
    pub transmittance: f64,
    /// The energy absorbed between the facet before and this one.
    pub absorbed: f64,
}

impl Beam<'_> {
    /// Returns whether light enters the stone here; `weight` is then the glare of the surface.
    pub fn is_surface(&self) -> bool {
        self.parent.is_none()
    }
}

impl Beams {
    /// Returns the number of beams that were followed, in one domain of the symmetry.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Returns whether there are no beams, which never happens with a stone.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Returns the beam with this id.
    pub fn get(&self, id: u32) -> Beam<'_> {
        let node = &self.nodes[id];
        let (direction, weight) = match node.exit {
            NO_EXIT => (DVec3::ZERO, 0.0),
            exit => (self.exits[exit].direction, self.exits[exit].weight),
        };
        let BeamLoss { transmittance, absorbed } = self.loss(id);
        Beam {
            id,
            parent: (node.parent != ROOT).then_some(node.parent),
            facet: node.facet,
            outline: self.outline(node),
            area: node.area,
            exit: direction,
            weight: weight * transmittance,
            onward: node.onward * transmittance,
            open: node.open,
            path: node.path,
            transmittance,
            absorbed,
        }
    }

    /// Returns the outline of one of the nodes.
    pub(super) fn outline(&self, node: &BeamNode) -> &[DVec2] {
        let (start, count) = (node.corners.0 as usize, node.corners.1 as usize);
        &self.corners[start..start + count]
    }

    fn loss(&self, id: u32) -> BeamLoss {
        if self.losses.is_empty() { BeamLoss::NONE } else { self.losses[id] }
    }

    /// Adds beams whose numbers continue those of a former state of this tree; `base` holds the numbers of beams,
    /// corners and exits in that state. Returns the difference between the new ids and those numbers.
    pub(super) fn extend(&mut self, new: &mut NewBeams, base: TreeSize) -> u32 {
        let (old, moved) = (self.size(), |number: &mut u32, base: u32, now: u32| {
            *number += if *number >= base && *number != u32::MAX { now - base } else { 0 };
        });
        for node in &mut new.nodes {
            moved(&mut node.parent, base.nodes, old.nodes);
            moved(&mut node.corners.0, base.corners, old.corners);
            moved(&mut node.exit, base.exits, old.exits);
        }
        self.nodes.extend(&new.nodes);
        // The list would double otherwise, and need three times its memory at that moment.
        if self.corners.capacity() - self.corners.len() < new.corners.len() {
            self.corners.reserve_exact(new.corners.len() + self.corners.len() / 4);
        }
        self.corners.extend_from_slice(&new.corners);
        self.exits.extend(&new.exits);
        self.losses.extend(&new.losses);
        old.nodes - base.nodes
    }

    /// Drops all beams except these, which have not been followed, and numbers them anew. Their ids must ascend. They
    /// lose their parents and exits.
    pub(super) fn keep(&mut self, ids: &[u32]) {
        self.nodes.keep(ids);
        if !self.losses.is_empty() {
            self.losses.keep(ids);
        }
        self.exits = Blocks::default();
        // Two beams that are not followed never share an outline, so that outlines can move down one after the other.
        let first = |id: u32| self.nodes[id].corners.0;
        let mut by_corners: Vec<(u32, u32)> = (0..ids.len() as u32).map(|id| (first(id), id)).collect();
        by_corners.sort_unstable();
        let mut end = 0;
        for (start, id) in by_corners {
            let node = &mut self.nodes[id];
            let (start, count) = (start as usize, node.corners.1);
            self.corners.copy_within(start..start + count as usize, end as usize);
            *node = BeamNode { parent: ROOT, corners: (end, count), exit: NO_EXIT, open: true, ..*node };
            end += count;
        }
        self.corners.truncate(end as usize);
    }

    /// Returns the memory of the beams, bytes. Corners count twice, because a list that grows is copied.
    pub fn bytes(&self) -> usize {
        self.nodes.len() * size_of::<BeamNode>()
            + 2 * self.corners.len() * size_of::<DVec2>()
            + self.exits.len() * size_of::<BeamExit>()
            + self.losses.len() * size_of::<BeamLoss>()
    }

    pub(super) fn size(&self) -> TreeSize {
        let [nodes, corners, exits] =
            [self.nodes.len(), self.corners.len(), self.exits.len()].map(|n| n as u32);
        TreeSize { nodes, corners, exits }
    }

    /// Returns all beams; a beam's parent comes before it.
    pub fn iter(&self) -> impl Iterator<Item = Beam<'_>> + Clone {
        (0..self.len() as u32).map(|id| self.get(id))
    }

    /// Returns the facets that a beam has met, from the one by which it entered to the one on which it ends.
    pub fn facets(&self, id: u32) -> Vec<u32> {
        let up = |&id: &u32| Some(self.nodes[id].parent).filter(|&p| p != ROOT);
        let mut met: Vec<u32> = std::iter::successors(Some(id), up).map(|i| self.nodes[i].facet).collect();
        met.reverse();
        met
    }

    /// Returns the share of the silhouette's light that was not followed to its end; it bounds the error of every figure.
    pub fn unresolved(&self) -> f64 {
        let ids = (0..self.len() as u32).filter(|&id| self.nodes[id].open);
        let open = |id| self.nodes[id].onward * self.loss(id).transmittance * self.nodes[id].area;
        let left: f64 = ids.map(open).sum();
        (left + self.dropped) * f64::from(self.symmetry.order()) / self.silhouette_area
    }
}
