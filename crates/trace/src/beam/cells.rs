//! Cells: a subdivision of the image, without overlaps, read off the tree of nested beams.

use super::tree::{Beam, Beams, ROOT};

/// One cell of the map of strongest exits: the whole outline of one beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cell {
    /// The id of the beam whose outline is the cell.
    pub outline: u32,
    /// The id of the beam with the strongest of all exits seen through the cell, without the surface's glare; the
    /// first of equals. `None` where no light has left the stone yet.
    pub strongest: Option<u32>,
    /// True where the light that was left unresolved may hold a stronger exit.
    pub undecided: bool,
}

/// The strongest of the exits along the path of a beam, from its entry to its end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StrongestExit<E> {
    pub weight: f64,
    /// The exit, in the form that the caller needs; `None` where no light has left the stone yet.
    pub exit: Option<E>,
    /// True where no light that is still inside can have a stronger exit.
    pub is_decided: bool,
}

impl<E: Copy> StrongestExit<E> {
    /// Returns the strongest exit along the path of a beam from that of the beam's parent and the beam's own exit,
    /// given in the caller's form.
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
    /// Returns the map of strongest exits of one domain of the symmetry: for each point, the exit that contributes
    /// most to its light.
    ///
    /// A cell is complete as soon as no light that is still inside can have a stronger exit. In a stone that absorbs,
    /// weights are means over outlines, so the map is exact only as far as absorption is even in each outline.
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

    /// Returns, for each beam, the strongest exit along its path, by the id of the beam that ends there.
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
        // `fold` starts at 0; `sum` would give -0 for no cells.
        let area = open.fold(0.0, |area, c| area + self.nodes[c.outline].area);
        area * f64::from(self.symmetry.order()) / self.silhouette_area
    }

    /// Returns the ids of the beams that were not split further, in one domain: the finest subdivision of the image.
    /// The light of a point is the light of such a beam and of all its ancestors.
    pub fn leaves(&self) -> impl Iterator<Item = u32> {
        let parted = self.parted();
        (0..self.len() as u32).filter(move |&id| !parted[id as usize])
    }
}
