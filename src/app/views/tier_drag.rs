//! A drag of a facet of a tier: where the tier goes as the pointer moves, and the corners at which it stops.

use super::known_corners::KnownCorners;
use crate::cut::{Meet, Tier, TierChange, TierCorner, Tiers};
use egui::{Pos2, Vec2};

/// A tier stops at a corner where the pointer is this near to the place that cuts the facet there, points.
const SNAP: f32 = 9.0;

/// A tier is at a corner where its distance differs by no more than this part of itself: what a meet leaves.
const THERE: f64 = 2e-5;

/// What the hand on a tier keeps from frame to frame.
#[derive(Default)]
pub struct TierHand {
    /// The corners of the tier that was asked about last.
    pub known: KnownCorners,
    /// The facet that is dragged.
    pub drag: Option<TierDrag>,
}

impl TierHand {
    /// Whether a facet is dragged.
    pub fn is_dragging(&self) -> bool {
        self.drag.is_some()
    }
}

/// A drag of a facet.
pub struct TierDrag {
    /// The view in which it is dragged.
    pub pane: usize,
    /// The design before the drag, whose corners stay while the tier moves.
    pub before: Tiers,
    /// The place of the tier, and that of the facet in it.
    pub facet: (usize, usize),
    /// Where the button was pressed.
    pub pressed: Pos2,
    /// The direction in the window, of length 1, that moves the facet outward.
    pub way: Vec2,
    /// The change of the distance for each point of the way, in the design's unit.
    pub per_point: f64,
    /// The corners of this facet, each with the meet that leads there, once that was looked for.
    pub corners: Vec<(TierCorner, Option<Option<Meet>>)>,
    /// The corner at which the facet has stopped.
    pub stopped: Option<usize>,
    /// Whether the drag has changed the design.
    pub has_changed: bool,
    /// Whether Escape has ended the drag, and the button is still down.
    pub is_over: bool,
}

impl TierDrag {
    /// Returns the change that moves the tier to where the pointer is, or to a corner near to that; `None` where it is there. A
    /// tier that is free stops at no corner.
    pub fn change(&mut self, tier: &Tier, at: Pos2, is_free: bool) -> Option<TierChange> {
        let start = self.before.tiers.get(self.facet.0)?.distance.abs();
        let along = f64::from((at - self.pressed).dot(self.way));
        let wanted = (start + along * self.per_point).max(0.0);
        let apart = |corner: &TierCorner| (corner.distance - wanted).abs() / self.per_point;
        let near = self.corners.iter().enumerate().map(|(k, (corner, _))| (k, apart(corner)));
        let near = near.filter(|(_, apart)| !is_free && *apart <= f64::from(SNAP));
        self.stopped = near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k);
        let place = self.facet.0;
        let moved = |distance: f64| {
            let distance = distance.copysign(tier.distance);
            (distance != tier.distance).then_some(TierChange::Setting(place, tier.angle, distance))
        };
        let Some(k) = self.stopped else { return moved(wanted) };
        let (corner, meet) = &mut self.corners[k];
        let meet = meet.get_or_insert_with(|| self.before.meet_at(place, corner));
        // A tier that is there by a meet keeps its words.
        let is_there = (tier.distance.abs() - corner.distance).abs() <= THERE * start;
        match meet {
            Some(_) if is_there && tier.meet.is_some() => None,
            Some(meet) => Some(TierChange::Meet(place, Some(meet.clone()))),
            None => moved(corner.distance),
        }
    }
}
