//! The position of the eye of a view: a lean, a turn of the stone about its axis, and a zoom.

use crate::model::framing_fit::FramingFit;
use brillianteer_scene::{Film, Lean, Projection, Side, View};
use glam::{DQuat, DVec2};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The range of the zoom.
const ZOOMS: std::ops::RangeInclusive<f64> = 0.2..=200.0;

/// A lean smaller than this, radians, snaps to none: face up is where figures are compared.
const SNAP: f64 = 0.012;

/// The direction from which a stone is seen, with the zoom and the offset of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Eye {
    /// Whether the culet faces the eye when nothing leans.
    pub from_below: bool,
    /// The lean toward the image's right and up at rest, radians; its length is the tilt, at most π/2.
    pub lean: DVec2,
    /// True where the eye leans while light and stone stay; else the stone leans under eye and light.
    pub eye_leans: bool,
    /// The turn of the stone about its axis, counter-clockwise from above, radians.
    pub turn: f64,
    /// The factor by which the stone is larger than where it fits its pane.
    pub zoom: f64,
    /// The offset of the point in the pane's middle from the middle of what the view is fitted to, girdle radii.
    pub centre: DVec2,
    /// The tilt that [`back`](Self::back) goes back to; `None` where the view has had none.
    pub last: Option<Tilted>,
}

/// A tilt that a view had: its side and its lean, as in [`Eye`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Tilted {
    from_below: bool,
    lean: DVec2,
}

impl Default for Eye {
    fn default() -> Self {
        Self {
            from_below: false,
            lean: DVec2::ZERO,
            eye_leans: false,
            turn: 0.0,
            zoom: 1.0,
            centre: DVec2::ZERO,
            last: None,
        }
    }
}

impl Eye {
    /// Returns the view of the stone along parallel rays. `side` replaces the eye's own side for pictures that show
    /// one side only.
    pub fn view(&self, side: Option<Side>) -> View {
        let own = if self.from_below { Side::Culet } else { Side::Table };
        View {
            side: side.unwrap_or(own),
            lean: if self.eye_leans { Lean::Eye } else { Lean::Stone },
            tilt: self.tilt(),
            azimuth: if self.lean == DVec2::ZERO { 0.0 } else { self.lean.to_angle().rem_euclid(TAU) },
            turn: DQuat::from_rotation_z(self.turn),
            projection: Projection::Orthographic,
        }
    }

    /// Returns the tilt, radians.
    pub fn tilt(&self) -> f64 {
        self.lean.length().min(FRAC_PI_2)
    }

    /// Leans by a drag over the picture, to the right and up, radians, so that what faces the eye follows the hand.
    pub fn drag(&mut self, side: Side, by: DVec2) {
        let toward = match (side, self.eye_leans) {
            (Side::Table, false) => by,
            (Side::Table, true) => -by,
            (Side::Culet, _) => DVec2::new(by.x, -by.y),
        };
        self.lean = (self.lean + toward).clamp_length_max(FRAC_PI_2);
    }

    /// Ends a drag: a stone that is all but upright becomes upright.
    pub fn settle(&mut self) {
        if self.lean.length() < SNAP {
            self.lean = DVec2::ZERO;
        }
    }

    /// Turns the stone about its axis by a drag to the right, radians.
    pub fn spin(&mut self, side: Side, by: f64) {
        let sense = if side == Side::Table { 1.0 } else { -1.0 };
        self.turn = (self.turn + sense * by).rem_euclid(TAU);
    }

    /// Zooms by a factor around a point of the image, in girdle radii from the middle of the fit.
    pub fn zoom_at(&mut self, factor: f64, at: DVec2) {
        let zoom = (self.zoom * factor).clamp(*ZOOMS.start(), *ZOOMS.end());
        self.centre = at + (self.centre - at) * (self.zoom / zoom);
        self.zoom = zoom;
    }

    /// Resets zoom and offset, so that the whole stone is in sight.
    pub fn fit(&mut self) {
        (self.zoom, self.centre) = (1.0, DVec2::ZERO);
    }

    /// Looks at the table.
    pub fn top(&mut self) {
        self.upright(false);
    }

    /// Looks at the culet.
    pub fn bottom(&mut self) {
        self.upright(true);
    }

    fn upright(&mut self, from_below: bool) {
        self.keep();
        (self.lean, self.from_below) = (DVec2::ZERO, from_below);
        self.fit();
    }

    /// Looks along the girdle plane, table up.
    pub fn side(&mut self) {
        self.keep();
        // The table ends at the top, whichever of the two leans.
        let up = if self.eye_leans { -FRAC_PI_2 } else { FRAC_PI_2 };
        (self.lean, self.from_below) = (DVec2::new(0.0, up), false);
        self.fit();
    }

    /// Goes back to the tilt before top, side or bottom, if there was one.
    pub fn back(&mut self) {
        let Some(Tilted { from_below, lean }) = self.last else { return };
        (self.from_below, self.lean) = (from_below, lean);
        self.fit();
    }

    fn keep(&mut self) {
        if self.lean.length() > SNAP && self.tilt() < FRAC_PI_2 - SNAP {
            self.last = Some(Tilted { from_below: self.from_below, lean: self.lean });
        }
    }

    /// Returns the film for a pane of `size` pixels; `fit` is the extent that the view takes in without zoom and
    /// offset.
    pub fn film(&self, size: [u32; 2], fit: &FramingFit) -> Film {
        let fitting = fit.film(size);
        Film { pixel: fitting.pixel / self.zoom, centre: fitting.centre + self.centre, ..fitting }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// Returns where the point nearest to the eye is seen after a small drag.
    fn followed(eye: Eye, side: Side, by: DVec2) -> DVec2 {
        let near = eye.view(Some(side)).basis().toward;
        let mut dragged = eye;
        dragged.drag(side, by);
        dragged.view(Some(side)).basis().project(near)
    }

    #[test]
    fn what_faces_the_eye_follows_the_hand() {
        for eye_leans in [false, true] {
            for side in [Side::Table, Side::Culet] {
                for by in [DVec2::X, DVec2::Y, DVec2::new(-0.6, 0.8)] {
                    let eye = Eye { eye_leans, ..Eye::default() };
                    let moved = followed(eye, side, by * 1e-3);
                    assert!(moved.distance(by * 1e-3) < 1e-8, "{eye_leans} {side:?} {by}: {moved}");
                }
            }
        }
    }

    #[test]
    fn side_view_has_the_table_above() {
        for eye_leans in [false, true] {
            let mut eye = Eye { eye_leans, ..Eye::default() };
            eye.side();
            let table = eye.view(None).basis().project(DVec3::Z);
            assert!(table.distance(DVec2::Y) < 1e-12, "{table}");
        }
    }

    #[test]
    fn zooming_keeps_the_point_under_the_hand() {
        let mut eye = Eye { centre: DVec2::new(0.1, 0.2), ..Eye::default() };
        let pixel = |eye: &Eye, at: DVec2| {
            eye.film([100, 80], &FramingFit::reaching(1.0))
                .pixels_from_image(glam::DMat2::IDENTITY)
                .transform_point2(at)
        };
        let at = DVec2::new(-0.4, 0.3);
        let before = pixel(&eye, at);
        eye.zoom_at(3.0, at);
        assert!(pixel(&eye, at).distance(before) < 1e-9 && (eye.zoom - 3.0).abs() < 1e-12);
    }

    #[test]
    fn the_eye_goes_back_to_the_tilt_that_it_had_and_to_no_other() {
        let mut eye = Eye::default();
        eye.bottom();
        let before = eye;
        eye.back();
        assert_eq!(eye, before, "there was no tilt");
        eye.top();
        eye.drag(Side::Table, DVec2::new(0.2, 0.1));
        let lean = eye.lean;
        eye.top();
        eye.bottom();
        eye.side();
        assert!((eye.tilt() - FRAC_PI_2).abs() < 1e-12);
        eye.bottom();
        eye.back();
        assert_eq!((eye.lean, eye.from_below), (lean, false));
    }
}
