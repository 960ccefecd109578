//! A handle that is dragged: the length of the pull since its press, and the resulting proportions.

use super::grips::Grip;
use super::handle::{Handle, percent_of_radius};
use super::sight::{ProfileBox, ProfileProjection};
use brillianteer_cut::{Cut, ProfileHandle};
use brillianteer_picture::profile::Dimensions;
use brillianteer_session::value_grid::ValueGrid;
use egui::{Pos2, Vec2};
use glam::DVec2;

/// The part of the pointer's movement that the handle follows while Shift is down.
const FINE: f64 = 0.1;
/// The length of a pull, in points, after which it is clear whether the tip is to move up and down or sideways.
const DECIDED: f32 = 4.0;

/// The drag of a handle, from press to release.
///
/// The resulting proportions depend only on those at the start and on the whole pull. So nothing drifts, and a change
/// that was lost at a limit comes back when the pointer does.
#[derive(Debug, Clone)]
pub struct Grab {
    pub handle: Handle,
    mirrored: bool,
    /// The cut at the press.
    pub start: Cut,
    /// The dimensions of its profile.
    dimensions: Dimensions,
    /// The visible part of the profile at the press: the drawing keeps its size during a drag.
    shown: ProfileBox,
    from: Pos2,
    last: Pos2,
    /// The pull in points; movement with Shift down counts by [`FINE`].
    pull: DVec2,
    grid: ValueGrid,
    pub is_undecided: bool,
}

impl Grab {
    /// Takes a handle of a cut, whose profile has these dimensions, at a point of the screen.
    pub fn new(grip: &Grip, start: Cut, dimensions: Dimensions, shown: ProfileBox, at: Pos2) -> Self {
        Self {
            handle: grip.handle,
            mirrored: grip.mirrored,
            start,
            dimensions,
            shown,
            from: at,
            last: at,
            pull: DVec2::ZERO,
            grid: ValueGrid::COARSE,
            is_undecided: grip.handle.part == ProfileHandle::PavilionTip,
        }
    }

    /// Follows the pointer. A pull that was once fine keeps its fine steps, because a release of Shift would
    /// otherwise lose them.
    pub fn follow(&mut self, to: Pos2, fine: bool) {
        let by = to - self.last;
        self.pull += DVec2::new(f64::from(by.x), f64::from(by.y)) * if fine { FINE } else { 1.0 };
        self.last = to;
        if fine {
            self.grid = ValueGrid::FINE;
        }
        let way = (to - self.from).abs();
        if self.is_undecided && way.max_elem() > DECIDED {
            self.is_undecided = false;
            let part = if way.x > way.y { ProfileHandle::CuletEdge } else { ProfileHandle::PavilionTip };
            self.handle = Handle::of(&self.start, part).unwrap_or(self.handle);
        }
    }

    /// Returns the cut that results from the pull.
    pub fn pulled(&self, sight: &ProfileProjection) -> Cut {
        if self.is_undecided {
            return self.start.clone();
        }
        let mut travel = sight.travel(Vec2::new(self.pull.x as f32, self.pull.y as f32));
        if self.mirrored {
            travel.x = -travel.x;
        }
        self.handle.dragged(&self.start, &self.dimensions, travel, self.grid)
    }

    /// Returns the part of the profile to show for the present cut.
    ///
    /// Heights are measured from the girdle's upper edge. Where that edge itself is pulled, the part is shifted so
    /// that the edge moves with the pointer.
    pub fn shown(&self, now: &Cut) -> ProfileBox {
        let Handle { part, row } = self.handle;
        match part {
            ProfileHandle::GirdleUpper => {
                let thinner = (row.get)(&self.start) - (row.get)(now);
                self.shown.raised(thinner / percent_of_radius(&self.dimensions))
            }
            _ => self.shown,
        }
    }
}
