//! The corners of the stone to which a tier can be cut, as the views show them.

use super::pane_view::PaneView;
use crate::app::model::tier_frame::TierFrame;
use crate::cut::{Cut, Meet, TierCorner};
use crate::scene::Specimen;
use crate::trace::ray::Camera;
use egui::{Color32, Pos2};
use std::sync::Arc;

/// The colour of corners that a tier can be cut to: bright on any picture, and not that of a finding.
pub const MEETING: Color32 = Color32::from_rgb(90, 220, 255);

/// A plane whose normal leans to the eye by less than this (cosine) shows nothing.
const IN_SIGHT: f64 = 1e-6;

/// The corners of the tier that was asked about last.
#[derive(Default)]
pub struct KnownCorners(Option<CornersOfTier>);

/// The corners of a tier of a stone.
pub struct CornersOfTier {
    specimen: Arc<Specimen>,
    place: usize,
    /// Where the corners lie in the stone's frame.
    pub frame: TierFrame,
    /// The corners, each with the meet that leads there, once that was looked for.
    pub corners: Vec<(TierCorner, Option<Option<Meet>>)>,
}

impl KnownCorners {
    /// Returns the corners of a tier; `None` where the stone is not cut by tiers.
    pub fn of(&mut self, specimen: &Arc<Specimen>, place: usize) -> Option<&mut CornersOfTier> {
        let is_known = |known: &CornersOfTier| Arc::ptr_eq(&known.specimen, specimen) && known.place == place;
        if !self.0.as_ref().is_some_and(is_known) {
            let (Cut::Tiers(tiers), frame) = (&specimen.design.cut, TierFrame::of(specimen)?) else {
                return None;
            };
            let corners = tiers.tier_corners(place).into_iter().map(|corner| (corner, None)).collect();
            self.0 = Some(CornersOfTier { specimen: Arc::clone(specimen), place, frame, corners });
        }
        self.0.as_mut()
    }
}

impl CornersOfTier {
    /// Returns the corners that face the eye, each with its number and its place in the window.
    pub fn seen(&self, sight: &PaneView) -> Vec<(usize, Pos2)> {
        let camera = Camera::reaching(&sight.view, 1.0);
        let seen = |(number, (corner, _)): (usize, &(TierCorner, _))| {
            let at = self.frame.place(corner.at);
            let toward = camera.toward_eye(at);
            let is_in_sight = corner.normals.iter().any(|normal| normal.dot(toward) > IN_SIGHT);
            Some((number, sight.point(camera.project(at).filter(|_| is_in_sight)?.0)))
        };
        self.corners.iter().enumerate().filter_map(seen).collect()
    }

    /// Returns the meet that leads to a corner; `None` where none does.
    pub fn meet(&mut self, number: usize) -> Option<Meet> {
        let Cut::Tiers(tiers) = &self.specimen.design.cut else { return None };
        let (corner, meet) = self.corners.get_mut(number)?;
        meet.get_or_insert_with(|| tiers.meet_at(self.place, corner)).clone()
    }
}
