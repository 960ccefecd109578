//! The corners of the stone to which a tier can be cut, for the views that mark them.

use super::pane_view::PaneView;
use crate::app::model::meet_pick::MeetPick;
use crate::cut::{Cut, Meet, TierCorner};
use crate::scene::Specimen;
use crate::trace::ray::Camera;
use egui::{Color32, Pos2};
use glam::DVec3;
use std::sync::Arc;

/// The colour of corners that a tier can be cut to: bright on any picture, and different from that of a finding.
pub const MEETING: Color32 = Color32::from_rgb(90, 220, 255);

/// A plane is invisible where its normal leans to the eye by less than this (cosine).
const IN_SIGHT: f64 = 1e-6;

/// The corners of the pick that was queried last.
#[derive(Default)]
pub struct KnownCorners(Option<CornersOfTier>);

/// The corners of a tier of a stone.
pub struct CornersOfTier {
    specimen: Arc<Specimen>,
    pick: MeetPick,
    /// The corners, each with the meet that leads there: the outer `None` means that no meet was sought yet, the
    /// inner that none leads there.
    pub corners: Vec<(TierCorner, Option<Option<Meet>>)>,
}

impl KnownCorners {
    /// Returns the corners that a pick can take next; `None` where the stone is not cut by tiers.
    pub fn of(&mut self, specimen: &Arc<Specimen>, pick: &MeetPick) -> Option<&mut CornersOfTier> {
        let is_known = |known: &CornersOfTier| Arc::ptr_eq(&known.specimen, specimen) && known.pick == *pick;
        if !self.0.as_ref().is_some_and(is_known) {
            self.0 = Some(CornersOfTier::of_pick(specimen, pick)?);
        }
        self.0.as_mut()
    }
}

impl CornersOfTier {
    /// Finds the corners that a tier can be cut to; `None` where the stone is not cut by tiers.
    pub fn of(specimen: &Arc<Specimen>, place: usize) -> Option<Self> {
        Self::of_pick(specimen, &MeetPick::new(place, 1))
    }

    fn of_pick(specimen: &Arc<Specimen>, pick: &MeetPick) -> Option<Self> {
        let Cut::Tiers(tiers) = &specimen.design.cut else { return None };
        let corners = match pick.wanted {
            ..=1 => tiers.tier_corners(pick.place),
            _ => tiers.corners_beside(pick.place),
        };
        let corners = corners.into_iter().map(|corner| (corner, None)).collect();
        Some(Self { specimen: Arc::clone(specimen), pick: pick.clone(), corners })
    }

    /// Returns the corners that have been picked, each with its number here.
    pub fn picked(&self) -> Vec<usize> {
        let number = |at: &DVec3| self.corners.iter().position(|(corner, _)| corner.at == *at);
        self.pick.corners.iter().filter_map(number).collect()
    }

    /// Returns the place of a corner in the frame of the stone.
    pub fn at(&self, corner: &TierCorner) -> DVec3 {
        self.specimen.frame.place(corner.at)
    }

    /// Returns the corners that face the eye, each with its number and its place in the window.
    pub fn seen(&self, sight: &PaneView) -> Vec<(usize, Pos2)> {
        let camera = Camera::reaching(&sight.view, 1.0);
        let seen = |(number, (corner, _)): (usize, &(TierCorner, _))| {
            let at = self.at(corner);
            let toward = camera.toward_eye(at);
            let is_in_sight = corner.normals.iter().any(|normal| normal.dot(toward) > IN_SIGHT);
            Some((number, sight.point(camera.project(at).filter(|_| is_in_sight)?.0)))
        };
        self.corners.iter().enumerate().filter_map(seen).collect()
    }

    /// Returns the meet that leads to a corner, and to those that have been picked; `None` where none does.
    pub fn meet(&mut self, number: usize) -> Option<Meet> {
        let Cut::Tiers(tiers) = &self.specimen.design.cut else { return None };
        let numbers: Vec<usize> = self.picked().into_iter().chain([number]).collect();
        let (corner, known) = self.corners.get(number)?;
        if let Some(known) = known {
            return known.clone();
        }
        let through: Vec<&TierCorner> = numbers.iter().map(|&number| &self.corners[number].0).collect();
        let found = match self.pick.wanted {
            ..=1 => tiers.meet_at(self.pick.place, corner),
            _ => tiers.meet_through(self.pick.place, &through),
        };
        self.corners[number].1 = Some(found.clone());
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::document::Document;
    use crate::io::as_tiers;

    #[test]
    fn corners_that_tiers_can_be_cut_to_lie_on_the_stone() {
        let mut document = Document::first().unwrap();
        assert!(CornersOfTier::of(document.specimen(), 0).is_none(), "a brilliant is not cut by tiers");
        let mut tiers = as_tiers(document.specimen()).unwrap().with_own_meets();
        // Another unit than that of the stone's frame.
        tiers.tiers.iter_mut().for_each(|tier| tier.distance *= 3.5);
        let table = tiers.tiers.iter().position(|tier| tier.angle == 0.0).unwrap();
        document.work.design.cut = Cut::Tiers(tiers);
        assert!(document.update());
        let specimen = document.specimen();
        let known = CornersOfTier::of(specimen, table).unwrap();
        let is_corner = |at: DVec3| specimen.solid().vertices().iter().any(|v| v.distance(at) < 1e-9);
        let now = known.corners.iter().filter(|(corner, _)| is_corner(known.at(corner)));
        assert!(now.count() >= 8, "the corners of the table are corners of the stone");
        assert!((specimen.frame.scale * 3.5 - 1.0).abs() < 0.05, "{:?}", specimen.frame);
    }
}
