//! The projection from the profile's plane to the screen, and the box of the plane that it shows.

use brillianteer_picture::profile::Dimensions;
use egui::epaint::MarginF32;
use egui::{Pos2, Rect, Vec2, vec2};
use glam::DVec2;

/// The shown part stops moving where less than this is left, in girdle radii.
const SETTLED: f64 = 1e-3;

/// A box in the profile's plane, in girdle radii, y up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileBox {
    /// The left and lowest corner.
    pub low: DVec2,
    /// The right and highest corner.
    pub high: DVec2,
}

impl ProfileBox {
    /// Returns the box around a stone of these dimensions.
    pub fn of(dimensions: &Dimensions) -> Self {
        let Dimensions { width, total, .. } = dimensions;
        Self { low: DVec2::new(width.from, total.to), high: DVec2::new(width.to, total.from) }
    }

    /// Returns the box moved up by `by`, or down where that is negative.
    pub fn raised(self, by: f64) -> Self {
        Self { low: self.low + DVec2::Y * by, high: self.high + DVec2::Y * by }
    }

    /// Returns this box moved by `part` of the way to another, or the other box itself where little of the way is left.
    pub fn toward(self, other: Self, part: f64) -> Self {
        let left = (other.low - self.low).abs().max((other.high - self.high).abs()).max_element();
        if left * (1.0 - part) < SETTLED {
            return other;
        }
        Self { low: self.low.lerp(other.low, part), high: self.high.lerp(other.high, part) }
    }
}

/// A parallel view of the profile on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileProjection {
    middle: DVec2,
    place: Pos2,
    scale: f64,
}

impl ProfileProjection {
    /// Makes the projection that shows a box as large as fits into `room`, in the middle.
    pub fn fitting(extent: ProfileBox, room: Rect) -> Self {
        let size = (extent.high - extent.low).max(DVec2::splat(SETTLED));
        let scale = (f64::from(room.width()) / size.x).min(f64::from(room.height()) / size.y);
        Self { middle: (extent.low + extent.high) / 2.0, place: room.center(), scale: scale.max(SETTLED) }
    }

    /// Returns the place of a profile point on the screen.
    pub fn at(&self, p: DVec2) -> Pos2 {
        let off = (p - self.middle) * self.scale;
        self.place + vec2(off.x as f32, -off.y as f32)
    }

    /// Converts a move on the screen, in points, into one in the profile, in girdle radii.
    pub fn travel(&self, by: Vec2) -> DVec2 {
        DVec2::new(f64::from(by.x), -f64::from(by.y)) / self.scale
    }
}

/// Returns the part of a rectangle that the margins around a stone leave.
pub fn room(rect: Rect, margins: MarginF32) -> Rect {
    let room = rect - margins;
    // A rectangle too small for its margins leaves the point in the middle between them.
    let middle = room.center();
    Rect::from_min_max(room.min.min(middle), room.max.max(middle))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn a_rectangle_too_small_for_its_margins_keeps_the_drawing_in_its_middle() {
        let margins = MarginF32::same(6.0);
        for size in [vec2(100.0, 40.0), vec2(100.0, 5.0), vec2(3.0, 40.0), vec2(3.0, 5.0)] {
            let rect = Rect::from_min_size(pos2(20.0, 30.0), size);
            let room = room(rect, margins);
            assert!(room.center() == rect.center() && !room.is_negative(), "{size}: {room}");
        }
    }
}
