//! A handle in the user's hand: how far it has been pulled since it was taken, and the proportions that result.

use super::handle::Handle;
use super::quantity::ValueGrid;
use super::sight::{ProfileBox, ProfileProjection};
use crate::cut::RoundBrilliant;
use egui::{Pos2, Vec2};
use glam::DVec2;

/// The part of the pointer's movement that the handle follows while Shift is down.
const FINE: f64 = 0.1;
/// The length of a pull, in points, after which it is clear whether the tip is to move up and down or sideways.
const DECIDED: f32 = 4.0;

/// The drag of a handle, from press to release.
///
/// The resulting proportions depend only on those at the start and on the whole pull. So nothing drifts, and what was lost
/// at a limit comes back when the hand does.
#[derive(Debug, Clone)]
pub struct Grab {
    handle: Handle,
    mirrored: bool,
    /// The proportions when the handle was taken.
    pub start: RoundBrilliant,
    /// The part of the profile that was shown when the handle was taken: the drawing keeps its size during a drag.
    shown: ProfileBox,
    from: Pos2,
    last: Pos2,
    /// The pull in points; movement with Shift down counts by [`FINE`].
    pull: DVec2,
    grid: ValueGrid,
    undecided: bool,
}

impl Grab {
    /// Takes a handle at a point of the screen. `mirrored` says that it is the copy on the stone's other side.
    pub fn new(handle: Handle, mirrored: bool, start: RoundBrilliant, shown: ProfileBox, at: Pos2) -> Self {
        Self {
            handle,
            mirrored,
            start,
            shown,
            from: at,
            last: at,
            pull: DVec2::ZERO,
            grid: ValueGrid::COARSE,
            undecided: handle == Handle::PavilionDepth,
        }
    }

    /// Returns the handle that is being dragged.
    pub fn handle(&self) -> Handle {
        self.handle
    }

    /// Whether it is not clear yet in which direction the handle is to move.
    pub fn is_undecided(&self) -> bool {
        self.undecided
    }

    /// Follows the pointer. A pull that was once fine keeps its fine steps, because releasing Shift would lose them
    /// otherwise.
    pub fn follow(&mut self, to: Pos2, fine: bool) {
        let by = to - self.last;
        self.pull += DVec2::new(f64::from(by.x), f64::from(by.y)) * if fine { FINE } else { 1.0 };
        self.last = to;
        if fine {
            self.grid = ValueGrid::FINE;
        }
        let way = (to - self.from).abs();
        if self.undecided && way.max_elem() > DECIDED {
            self.undecided = false;
            self.handle = if way.x > way.y { Handle::Culet } else { Handle::PavilionDepth };
        }
    }

    /// Returns the proportions that result from the pull.
    pub fn proportions(&self, sight: &ProfileProjection) -> RoundBrilliant {
        if self.undecided {
            return self.start;
        }
        let mut travel = sight.travel(Vec2::new(self.pull.x as f32, self.pull.y as f32));
        if self.mirrored {
            travel.x = -travel.x;
        }
        self.handle.dragged(&self.start, travel, self.grid)
    }

    /// Returns the part of the profile to show while the stone has these proportions.
    ///
    /// Heights are measured from the girdle's upper edge. Where that edge itself is pulled, the part shown is shifted so
    /// that the edge moves with the hand.
    pub fn shown(&self, now: &RoundBrilliant) -> ProfileBox {
        match self.handle {
            Handle::GirdleUpper => {
                self.shown.raised((self.start.girdle_thickness - now.girdle_thickness) / 50.0)
            }
            _ => self.shown,
        }
    }
}
