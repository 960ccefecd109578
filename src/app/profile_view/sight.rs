//! From the profile to the screen: which part of the plane is shown, and where.

use crate::picture::profile::Dimensions;
use egui::{Pos2, Rect, Vec2, pos2, vec2};
use glam::DVec2;

/// Moves of the shown part smaller than this end, radii.
const SETTLED: f64 = 1e-3;

/// A box in the profile's plane, radii, y up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileBox {
    /// Left and lowest.
    pub low: DVec2,
    /// Right and highest.
    pub high: DVec2,
}

impl ProfileBox {
    /// That of the stone.
    pub fn of(dimensions: &Dimensions) -> Self {
        let Dimensions { width, total, .. } = dimensions;
        Self { low: DVec2::new(width.from, total.to), high: DVec2::new(width.to, total.from) }
    }

    /// The same box higher or lower.
    pub fn raised(self, by: f64) -> Self {
        Self { low: self.low + DVec2::Y * by, high: self.high + DVec2::Y * by }
    }

    /// This box carried part of the way to another; wholly where little is left.
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
    /// Shows a box as large as it fits into `room`, in its middle.
    pub fn fitting(extent: ProfileBox, room: Rect) -> Self {
        let size = (extent.high - extent.low).max(DVec2::splat(SETTLED));
        let scale = (f64::from(room.width()) / size.x).min(f64::from(room.height()) / size.y);
        Self { middle: (extent.low + extent.high) / 2.0, place: room.center(), scale: scale.max(SETTLED) }
    }

    /// Where a point of the profile comes to lie.
    pub fn at(&self, p: DVec2) -> Pos2 {
        let off = (p - self.middle) * self.scale;
        self.place + vec2(off.x as f32, -off.y as f32)
    }

    /// A move on the screen as one in the profile.
    pub fn travel(&self, by: Vec2) -> DVec2 {
        DVec2::new(f64::from(by.x), -f64::from(by.y)) / self.scale
    }
}

/// White space round the stone, points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margins {
    /// Left.
    pub left: f32,
    /// Right.
    pub right: f32,
    /// Above.
    pub top: f32,
    /// Below.
    pub bottom: f32,
}

impl Margins {
    /// What they leave of a rectangle.
    pub fn within(&self, rect: Rect) -> Rect {
        let room = Rect::from_min_max(
            rect.min + vec2(self.left, self.top),
            rect.max - vec2(self.right, self.bottom),
        );
        // A rectangle too small for its margins keeps its middle.
        let least = pos2(room.max.x.max(room.min.x), room.max.y.max(room.min.y));
        Rect::from_min_max(room.min, least)
    }
}
