//! Cells: a subdivision of the image, without overlaps, read off the tree of nested beams.

use super::tree::{Beams, ROOT};

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

impl Beams {
    /// Returns the map of strongest exits of one domain of the symmetry: at each point, the exit direction that lights it
    /// most.
    ///
    /// A cell is complete as soon as no light that is still inside can outshine the best exit so far. In a stone that
    /// absorbs, weights are means over outlines, so that the map is exact only as far as absorption is even in each.
    pub fn strongest_exits(&self) -> Vec<Cell> {
        let n = self.nodes.len();
        let mut best: Vec<(f64, u32)> = vec![(0.0, ROOT); n];
        let mut decided = vec![false; n];
        let mut parted = vec![false; n];
        for (id, beam) in self.iter().enumerate() {
            if let Some(parent) = beam.parent.map(|p| p as usize) {
                parted[parent] = true;
                best[id] = best[parent];
                decided[id] = decided[parent];
                if beam.weight > best[id].0 {
                    best[id] = (beam.weight, id as u32);
                }
            }
            decided[id] |= beam.onward <= best[id].0;
        }
        let open_above = |id: usize| match self.nodes[id].parent {
            ROOT => true,
            parent => !decided[parent as usize],
        };
        (0..n)
            .filter(|&id| open_above(id) && (decided[id] || !parted[id]))
            .map(|id| Cell {
                outline: id as u32,
                strongest: (best[id].1 != ROOT).then_some(best[id].1),
                undecided: !decided[id],
            })
            .collect()
    }

    /// Returns the share of the silhouette's area in cells whose strongest exit is not certain, or that have none.
    pub fn undecided(&self, cells: &[Cell]) -> f64 {
        let open = cells.iter().filter(|c| c.undecided || c.strongest.is_none());
        // Not `sum`, which makes -0 of nothing.
        let area = open.fold(0.0, |area, c| area + self.nodes[c.outline as usize].area);
        area * f64::from(self.symmetry.order()) / self.silhouette_area
    }

    /// Returns the ids of the beams that were not split further, in one domain: the finest subdivision of the image. The
    /// light of a point is that of such a beam and of all beams that this one came from.
    pub fn leaves(&self) -> impl Iterator<Item = u32> {
        let mut parted = vec![false; self.nodes.len()];
        for parent in self.nodes.iter().map(|n| n.parent).filter(|&p| p != ROOT) {
            parted[parent as usize] = true;
        }
        (0..self.nodes.len() as u32).filter(move |&id| !parted[id as usize])
    }
}
