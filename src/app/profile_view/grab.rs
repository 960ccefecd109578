//! A handle in hand: how far it has been pulled since it was taken, and what that makes of the stone.

use super::handle::Handle;
use super::quantity::ValueGrid;
use super::sight::{ProfileBox, ProfileProjection};
use crate::cut::RoundBrilliant;
use egui::{Pos2, Vec2};
use glam::DVec2;

/// How much slower the handle follows while Shift is down.
const FINE: f64 = 0.1;
/// The pull, points, after which it is clear whether the tip is meant to go up and down or sideways.
const DECIDED: f32 = 4.0;

/// From press to release. What the stone becomes depends on where it began and on the whole of the pull alone, so that
/// nothing drifts, and what was lost at a limit comes back with the hand.
#[derive(Debug, Clone)]
pub struct Grab {
    handle: Handle,
    mirrored: bool,
    /// The proportions when it was taken.
    pub start: RoundBrilliant,
    /// What was shown when it was taken: the drawing keeps its size while anything is in hand.
    shown: ProfileBox,
    from: Pos2,
    last: Pos2,
    /// Points, finer ones counted as what they are worth.
    pull: DVec2,
    grid: ValueGrid,
    undecided: bool,
}

impl Grab {
    /// Takes a handle at a point of the screen; `mirrored` where it is the one on the stone's other side.
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

    /// What is in hand.
    pub fn handle(&self) -> Handle {
        self.handle
    }

    /// Whether it is not clear yet which way it is meant to go.
    pub fn is_undecided(&self) -> bool {
        self.undecided
    }

    /// Follows the pointer. A pull that was once fine keeps its fine steps, or letting go of Shift would throw them away.
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

    /// What the stone becomes.
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

    /// What is shown of the profile while the stone has these proportions. The girdle's upper edge, from which heights
    /// are measured, rises with the hand that pulls it.
    pub fn shown(&self, now: &RoundBrilliant) -> ProfileBox {
        match self.handle {
            Handle::GirdleUpper => {
                self.shown.raised((self.start.girdle_thickness - now.girdle_thickness) / 50.0)
            }
            _ => self.shown,
        }
    }
}
