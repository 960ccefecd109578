//! Cells: a subdivision of the image, without overlaps, read off the tree of nested beams.

use super::tree::{Beam, Beams, ROOT};

/// One cell of the map of strongest exits: the whole outline of one beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cell {
    /// The id of the beam whose outline the cell has.
    pub outline: u32,
    /// The id of the beam with the strongest of all exits seen through the cell, the surface's glare left aside; the first
    /// of equals. `None` where no light has left the stone yet.
    pub strongest: Option<u32>,
    /// Whether a stronger exit may lie in the light that was left unresolved.
    pub undecided: bool,
}

/// The strongest of the exits on the way of a beam, from where it enters to its end.
#[derive(Debug, Clone, Copy)]
pub(in crate::trace) struct StrongestExit<E> {
    pub weight: f64,
    /// What is known of the exit; `None` where no light has left the stone yet.
    pub exit: Option<E>,
    /// Whether no light that is still inside can outshine it.
    pub is_decided: bool,
}

impl<E: Copy> StrongestExit<E> {
    /// Returns the strongest exit on the way of a beam, given that of its parent and what is to be known of its own exit.
    pub fn of(beam: &Beam, before: Option<&Self>, exit: Option<E>) -> Self {
        let mut best = match before {
            None => Self { weight: 0.0, exit: None, is_decided: false },
            Some(before) if beam.weight > before.weight => Self { weight: beam.weight, exit, ..*before },
            Some(before) => *before,
        };
        best.is_decided |= beam.onward <= best.weight;
        best
    }
}

impl Beams {
    /// Returns the map of strongest exits of one domain of the symmetry: at each point, the exit direction that lights it
    /// most.
    ///
    /// A cell is complete as soon as no light that is still inside can outshine the best exit so far. In a stone that
    /// absorbs, weights are means over outlines, so that the map is exact only as far as absorption is even in each.
    pub fn strongest_exits(&self) -> Vec<Cell> {
        let (best, parted) = (self.strongest_so_far(), self.parted());
        let open_above = |id: usize| match self.nodes[id as u32].parent {
            ROOT => true,
            parent => !best[parent as usize].is_decided,
        };
        (0..best.len())
            .filter(|&id| open_above(id) && (best[id].is_decided || !parted[id]))
            .map(|id| Cell { outline: id as u32, strongest: best[id].exit, undecided: !best[id].is_decided })
            .collect()
    }

    /// Returns, for each beam, the strongest exit on its way, by the id of the beam that ends at it.
    fn strongest_so_far(&self) -> Vec<StrongestExit<u32>> {
        let mut best: Vec<StrongestExit<u32>> = Vec::with_capacity(self.len());
        for beam in self.iter() {
            let before = beam.parent.map(|parent| &best[parent as usize]);
            best.push(StrongestExit::of(&beam, before, Some(beam.id)));
        }
        best
    }

    /// Returns, for each beam, whether it was split further.
    fn parted(&self) -> Vec<bool> {
        let mut parted = vec![false; self.len()];
        for parent in self.nodes.iter().map(|n| n.parent).filter(|&p| p != ROOT) {
            parted[parent as usize] = true;
        }
        parted
    }

    /// Returns the share of the silhouette's area in cells whose strongest exit is not certain, or that have none.
    pub fn undecided(&self, cells: &[Cell]) -> f64 {
        let open = cells.iter().filter(|c| c.undecided || c.strongest.is_none());
        // Not `sum`, which makes -0 of nothing.
        let area = open.fold(0.0, |area, c| area + self.nodes[c.outline].area);
        area * f64::from(self.symmetry.order()) / self.silhouette_area
    }

    /// Returns the ids of the beams that were not split further, in one domain: the finest subdivision of the image. The
    /// light of a point is that of such a beam and of all beams that this one came from.
    pub fn leaves(&self) -> impl Iterator<Item = u32> {
        let parted = self.parted();
        (0..self.len() as u32).filter(move |&id| !parted[id as usize])
    }
}
