//! A drag of a facet of a tier: where the tier goes as the pointer moves, and the corners at which it stops.

use super::known_corners::{CornersOfTier, KnownCorners};
use brillianteer_cut::{Tier, TierChange, TierCorner};
use egui::{Pos2, Vec2};

/// A tier stops at a corner where the pointer is this near to the place that cuts the facet there, points.
const SNAP: f32 = 9.0;

/// A tier is at a corner where its distance differs by no more than this part of the design's largest: what a meet leaves.
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

/// A facet that the pointer holds: where its drag began, and where its tier may stop.
pub struct TierDrag {
    /// The view in which it is dragged.
    pub pane: usize,
    /// The number of the document that is open, so that no other is changed.
    pub document: u64,
    /// The place of the tier, and that of the facet in it.
    pub facet: (usize, usize),
    /// Where the button was pressed.
    pub pressed: Pos2,
    /// The direction in the window, of length 1, that moves the facet outward.
    pub way: Vec2,
    /// The change of the distance for each point of the way, in the design's unit.
    pub per_point: f64,
    /// The distance of the tier before the drag, and the largest distance of the design, in the design's unit and without signs.
    pub start: [f64; 2],
    /// The corners of the facet in the design before the drag; they stay while the tier moves.
    pub corners: CornersOfTier,
    /// The corner at which the facet has stopped.
    pub stopped: Option<usize>,
    /// Whether Escape has ended the drag, and the button is still down.
    pub is_over: bool,
}

impl TierDrag {
    /// Returns the change that moves the tier to where the pointer is, or to a corner near to that; `None` where it is there. A
    /// tier that is free stops at no corner.
    pub fn change(&mut self, tier: &Tier, at: Pos2, is_free: bool) -> Option<TierChange> {
        let [start, largest] = self.start;
        let along = f64::from((at - self.pressed).dot(self.way));
        let wanted = (start + along * self.per_point).max(0.0);
        let apart = |corner: &TierCorner| (corner.distance - wanted).abs() / self.per_point;
        let near = self.corners.corners.iter().enumerate().map(|(k, known)| (k, apart(&known.corner)));
        let near = near.filter(|(_, apart)| !is_free && *apart <= f64::from(SNAP));
        self.stopped = near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k);
        let place = self.facet.0;
        let moved = |distance: f64| {
            let distance = distance.copysign(tier.distance);
            (distance != tier.distance).then_some(TierChange::Setting(place, tier.angle, distance))
        };
        let Some(k) = self.stopped else { return moved(wanted) };
        let distance = self.corners.corners[k].corner.distance;
        // A tier that is there by a meet keeps its words.
        let is_there = (tier.distance.abs() - distance).abs() <= THERE * largest;
        match self.corners.meet(k).and_then(Result::ok) {
            Some(_) if is_there && tier.meet.is_some() => None,
            Some(meet) => Some(TierChange::Meet(place, Some(meet))),
            None => moved(distance),
        }
    }
}
