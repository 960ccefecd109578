//! The direction from which the drawing shows the stone.

use crate::arrows;
use brillianteer_math::Basis;
use egui::{Key, Response, Ui, Vec2, vec2};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// Rotation for one point of dragging, in radians.
const PER_PIXEL: f64 = 0.01;

/// Length of the drag that one press of an arrow key stands for, in points.
const KEY: f32 = 10.0;

/// The place of the eye on a sphere around the stone, as two angles in radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Orbit {
    azimuth: f64,
    /// The angle above the girdle plane, -π/2 to π/2.
    elevation: f64,
}

impl Default for Orbit {
    /// Returns a three-quarter view.
    fn default() -> Self {
        Self { azimuth: -1.1, elevation: 0.35 }
    }
}

impl Orbit {
    /// Returns the axes of the image plane; `toward` points to the eye.
    pub fn eye(&self) -> Basis {
        let (sin, cos) = self.azimuth.sin_cos();
        let (up, out) = self.elevation.sin_cos();
        let toward = DVec3::new(out * cos, out * sin, up);
        let right = DVec3::new(-sin, cos, 0.0);
        Basis { right, up: toward.cross(right), toward }
    }

    /// Turns the view by the user's drag and arrow keys on the drawing; a double click or Home restores the first view.
    pub fn turned_by(&mut self, ui: &Ui, response: &Response) {
        self.turn(response.drag_delta());
        if response.double_clicked() {
            *self = Self::default();
        }
        if !response.has_focus() {
            return;
        }
        arrows::keep(ui, response.id);
        let pressed = |key| ui.input(|input| input.num_presses(key)) as f32;
        let right = pressed(Key::ArrowRight) - pressed(Key::ArrowLeft);
        let down = pressed(Key::ArrowDown) - pressed(Key::ArrowUp);
        self.turn(vec2(right, down) * KEY);
        if pressed(Key::Home) > 0.0 {
            *self = Self::default();
        }
    }

    /// Turns the view so that the near side of the stone follows a pointer that moves by `by` points.
    fn turn(&mut self, by: Vec2) {
        self.azimuth -= f64::from(by.x) * PER_PIXEL;
        self.elevation = (self.elevation + f64::from(by.y) * PER_PIXEL).clamp(-FRAC_PI_2, FRAC_PI_2);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_image_plane_is_orthonormal_wherever_the_eye_is() {
        for (azimuth, elevation) in [(0.0, 0.0), (1.0, 0.4), (-4.0, FRAC_PI_2), (2.5, -FRAC_PI_2)] {
            let Basis { right, up, toward } = Orbit { azimuth, elevation }.eye();
            assert!((right.cross(up) - toward).length() < 1e-15);
            assert!([right, up, toward].iter().all(|v| (v.length() - 1.0).abs() < 1e-15));
        }
    }

    #[test]
    fn what_is_near_the_eye_follows_the_pointer_and_no_drag_turns_past_the_poles() {
        let mut orbit = Orbit::default();
        let near = orbit.eye().toward;
        orbit.turn(vec2(10.0, 10.0));
        let moved = orbit.eye().project(near);
        assert!(moved.x > 0.0 && moved.y < 0.0, "{moved}");
        orbit.turn(vec2(0.0, 1e6));
        assert_eq!(orbit.elevation, FRAC_PI_2);
    }
}
