//! The view of the stone in a pane, and the conversion between points of its picture and of the window.

use brillianteer_math::SolidRef;
use brillianteer_scene::{Body, Film, View};
use brillianteer_trace::ray::Camera;
use egui::{Color32, Pos2, Rect, Stroke, Ui, vec2};
use glam::{DMat2, DVec2, DVec3};

/// The present view of the stone in a pane, and the place of its picture in the window.
pub struct PaneView {
    pub view: View,
    pub film: Film,
    /// The middle of the view's fit, girdle radii from the origin.
    pub middle: DVec2,
    /// The picture's place in the window, points.
    pub body: Rect,
    /// The pixels per point.
    pub scale: f32,
}

impl PaneView {
    /// Returns the point of the film, in its pixels, under a point of the window.
    pub fn pixel(&self, at: Pos2) -> DVec2 {
        let at = (at - self.body.min) * self.scale;
        DVec2::new(f64::from(at.x), f64::from(at.y))
    }

    /// Returns the point of the image, girdle radii, under a point of the window.
    pub fn image(&self, at: Pos2) -> DVec2 {
        self.film.image_from_pixels(self.pixel(at))
    }

    /// Returns the point of the window over a point of the image, girdle radii.
    pub fn point(&self, image: DVec2) -> Pos2 {
        let pixel = self.film.pixels_from_image(DMat2::IDENTITY).transform_point2(image);
        self.body.min + vec2(pixel.x as f32, pixel.y as f32) / self.scale
    }

    /// Returns the rectangle in the window of a picture that was taken on another film.
    pub fn place(&self, other: &Film) -> Rect {
        let corner = |pixel| self.point(other.image_from_pixels(pixel));
        Rect::from_two_pos(corner(DVec2::ZERO), corner(other.size.map(f64::from).into()))
    }

    /// Outlines the facet of a body under the pointer, whose points `place` carries to the frame of the view. The parts of
    /// a smooth glass shape are no facets, and have no outline.
    pub fn outline_face(&self, ui: &Ui, body: &Body, facet: u32, place: impl Fn(DVec3) -> DVec3) {
        if !matches!(body, Body::Glass(_)) {
            self.outline(ui, body.solid(), facet, place);
        }
    }

    /// Outlines a facet of a solid, whose points `place` carries to the frame of the view.
    pub fn outline(&self, ui: &Ui, solid: SolidRef, facet: u32, place: impl Fn(DVec3) -> DVec3) {
        self.outline_in(ui, (solid, facet), Color32::from_white_alpha(220), place);
    }

    /// Outlines a facet of a solid in a colour; `place` carries the solid's points to the frame of the view.
    pub fn outline_in(
        &self,
        ui: &Ui,
        (solid, facet): (SolidRef, u32),
        colour: Color32,
        place: impl Fn(DVec3) -> DVec3,
    ) {
        let camera = Camera::reaching(&self.view, 1.0);
        let painter = ui.painter().with_clip_rect(self.body);
        let at = |corner| Some(self.point(camera.project(place(corner))?.0));
        let rim = solid.rim(facet);
        for stroke in [Stroke::new(3.0, Color32::from_black_alpha(120)), Stroke::new(1.2, colour)] {
            for [from, to] in &rim {
                if let (Some(from), Some(to)) = (at(*from), at(*to)) {
                    painter.line_segment([from, to], stroke);
                }
            }
        }
    }

    /// Marks a point of the stone with a ring; a point behind the eye has none.
    pub fn mark_corner(&self, ui: &Ui, corner: DVec3, colour: Color32) {
        let Some((image, _)) = Camera::reaching(&self.view, 1.0).project(corner) else { return };
        let (at, painter) = (self.point(image), ui.painter().with_clip_rect(self.body));
        painter.circle_stroke(at, 7.0, Stroke::new(3.5, Color32::from_black_alpha(160)));
        painter.circle_stroke(at, 7.0, Stroke::new(1.8, colour));
    }

    /// Marks a point of the image.
    pub fn mark(&self, ui: &Ui, image: DVec2) {
        let (at, painter) = (self.point(image), ui.painter().with_clip_rect(self.body));
        painter.circle_stroke(at, 5.0, Stroke::new(3.0, Color32::from_black_alpha(160)));
        painter.circle_stroke(at, 5.0, Stroke::new(1.5, Color32::WHITE));
    }
}
