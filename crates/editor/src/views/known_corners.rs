//! The corners of the stone to which a tier can be cut, and why it cannot be cut to the others, for the views that mark them.

use super::pane_view::PaneView;
use brillianteer_cut::{CornerFault, Cut, Meet, TierCorner};
use brillianteer_scene::Specimen;
use brillianteer_session::model::meet_pick::MeetPick;
use brillianteer_trace::ray::Camera;
use egui::{Color32, Pos2};
use glam::DVec3;
use std::sync::Arc;
use std::time::{Duration, Instant};

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
    /// The corners, also those that the tier cannot be cut to.
    pub corners: Vec<KnownCorner>,
}

/// A corner and what is known about it.
pub struct KnownCorner {
    /// The corner.
    pub corner: TierCorner,
    /// The meet that leads the tier there and to the corners that have been picked, or why none does; `None` where no meet was sought
    /// yet.
    found: Option<Result<Meet, CornerFault>>,
}

impl KnownCorner {
    fn new(corner: TierCorner, fault: Option<CornerFault>) -> Self {
        Self { corner, found: fault.map(Err) }
    }

    /// Returns why the tier cannot be cut to the corner; `None` where it can, or where no meet was sought yet.
    pub fn fault(&self) -> Option<&CornerFault> {
        self.found.as_ref().and_then(|found| found.as_ref().err())
    }
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
    /// Finds the corners that each facet of a tier can be cut to; `None` where the stone is not cut by tiers.
    pub fn of(specimen: &Arc<Specimen>, place: usize) -> Option<Self> {
        let Cut::Tiers(tiers) = &specimen.design.cut else { return None };
        let corners = tiers.tier_corners(place).into_iter().map(|corner| KnownCorner::new(corner, None));
        let (specimen, pick) = (Arc::clone(specimen), MeetPick::new(place, 1));
        Some(Self { specimen, pick, corners: corners.collect() })
    }

    /// Finds all corners of the stone for a pick; `None` where the stone is not cut by tiers.
    fn of_pick(specimen: &Arc<Specimen>, pick: &MeetPick) -> Option<Self> {
        let Cut::Tiers(tiers) = &specimen.design.cut else { return None };
        let corners = tiers.corners_to_pick(pick.place, pick.wanted).into_iter();
        let corners = corners.map(|(corner, fault)| KnownCorner::new(corner, fault)).collect();
        Some(Self { specimen: Arc::clone(specimen), pick: pick.clone(), corners })
    }

    /// Returns the corners that have been picked, each with its number here.
    pub fn picked(&self) -> Vec<usize> {
        let number = |at: &DVec3| self.corners.iter().position(|known| known.corner.at == *at);
        self.pick.corners.iter().filter_map(number).collect()
    }

    /// Returns the place of a corner in the frame of the stone.
    pub fn at(&self, corner: &TierCorner) -> DVec3 {
        self.specimen.frame.place(corner.at)
    }

    /// Returns the corners that face the eye, each with its number and its place in the window.
    pub fn seen(&self, sight: &PaneView) -> Vec<(usize, Pos2)> {
        let camera = Camera::reaching(&sight.view, 1.0);
        let seen = |(number, known): (usize, &KnownCorner)| {
            let at = self.at(&known.corner);
            let toward = camera.toward_eye(at);
            let is_in_sight = known.corner.normals.iter().any(|normal| normal.dot(toward) > IN_SIGHT);
            Some((number, sight.point(camera.project(at).filter(|_| is_in_sight)?.0)))
        };
        self.corners.iter().enumerate().filter_map(seen).collect()
    }

    /// Returns the meet that leads to a corner, and to those that have been picked, or why none does; `None` for a number past the last
    /// corner.
    pub fn meet(&mut self, number: usize) -> Option<Result<Meet, CornerFault>> {
        let Cut::Tiers(tiers) = &self.specimen.design.cut else { return None };
        let numbers: Vec<usize> = self.picked().into_iter().chain([number]).collect();
        let KnownCorner { corner, found } = self.corners.get(number)?;
        if let Some(found) = found {
            return Some(found.clone());
        }
        let through: Vec<&TierCorner> = numbers.iter().map(|&number| &self.corners[number].corner).collect();
        let found = match self.pick.wanted {
            ..=1 => tiers.meet_at(self.pick.place, corner),
            _ => tiers.meet_through(self.pick.place, &through),
        };
        self.corners[number].found = Some(found.clone());
        Some(found)
    }

    /// Seeks the meets of corners for at most about `time`, where one more corner completes the pick; returns whether some are still
    /// to be sought.
    pub fn seek(&mut self, time: Duration) -> bool {
        if !self.pick.is_last() {
            return false;
        }
        let (begun, picked) = (Instant::now(), self.picked());
        let is_unknown = |k: &usize| self.corners[*k].found.is_none() && !picked.contains(k);
        let unknown: Vec<usize> = (0..self.corners.len()).filter(is_unknown).collect();
        let mut left = unknown.into_iter();
        while begun.elapsed() < time {
            let Some(number) = left.next() else { return false };
            self.meet(number);
        }
        left.next().is_some()
    }

    /// Returns whether the meets of all corners were sought and none leads to any beside those that have been picked.
    pub fn is_hopeless(&self) -> bool {
        let picked = self.picked();
        let others = self.corners.iter().enumerate().filter(|(k, _)| !picked.contains(k));
        self.pick.is_last()
            && others.clone().next().is_some()
            && others.clone().all(|(_, known)| known.fault().is_some())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_files::as_tiers;
    use brillianteer_session::model::document::Document;

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
        let now = known.corners.iter().filter(|of| is_corner(known.at(&of.corner)));
        assert!(now.count() >= 8, "the corners of the table are corners of the stone");
        assert!((specimen.frame.scale * 3.5 - 1.0).abs() < 0.05, "{:?}", specimen.frame);
    }
}
