//! The pane's outline, and the dome over it.
//!
//! Both come from one field: 0 in the middle, 1 on the outline. It joins a ramp along each axis as M. Fernández-Guasti's
//! squircle joins squares (*Analytic geometry of some rectilinear figures*, 1992). Each ramp has a square, which makes the
//! dome round, and a cube, which begins at the rim. The field therefore has two continuous derivatives and the dome's
//! normal has one: no crease runs from the corners to the middle.

use glam::{DVec2, DVec3};

/// The least width of the rim, as a part of half of the shorter side. With narrower rims panes look flat.
const RIM: f64 = 0.5;

/// The share of the square in the ramps of a pane that has straight sides: with less its middle is flatter, with more its
/// sides bulge.
const ROUND: f64 = 0.12;

/// The length of a straight side below which its ramp turns into a pure square, as a part of half of the shorter side. So
/// a circle is exactly a circle.
const STRAIGHT: f64 = 0.1;

/// The least slope of the field by which a distance from the outline is divided.
const FLAT: f64 = 1e-9;

/// A rectangle with rounded corners around the origin. Its curvature is continuous; on the diagonal of a corner it meets
/// the circle of the corner's radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PaneOutline {
    /// Half the width and height, above 0.
    pub half: DVec2,
    /// The place along each axis at which the rim begins.
    pub level: DVec2,
    /// The share of the square in the ramp along each axis; the rest is the cube.
    pub round: DVec2,
    /// The degree to which the ramps exclude each other at the corners: 1 makes the corners sharp, 0 makes them those
    /// of an ellipse.
    pub corner: f64,
}

/// The field at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PaneField {
    /// 0 in the middle, 1 on the outline.
    pub value: f64,
    /// The derivative of the field along x and y.
    pub slope: DVec2,
}

/// A point of the dome over an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DomePoint {
    /// Relative distance from the middle: the field's root; 0 in the middle, 1 on the outline and beyond.
    pub distance: f64,
    /// Unit direction from the middle; zero in the middle itself.
    pub radial: DVec2,
    /// Unit normal, z toward the eye: upright in the middle, level on the outline and square to it. Over a circle the dome
    /// is half a ball.
    pub normal: DVec3,
}

impl PaneOutline {
    /// Returns the outline of these half sides, whose corners have a radius from 0 to the lesser half.
    pub fn new(half: DVec2, radius: f64) -> Self {
        let least = half.min_element();
        let level = (half - radius.max(RIM * least)).max(DVec2::ZERO);
        let straight = (level / (STRAIGHT * least)).min(DVec2::ONE);
        let round = DVec2::ONE + (ROUND - 1.0) * straight;
        let sharp = Self { half, level, round, corner: 1.0 };
        let on_circle = half - (1.0 - std::f64::consts::FRAC_1_SQRT_2) * radius;
        let [(across, _), (down, _)] = [sharp.ramp(on_circle, 0), sharp.ramp(on_circle, 1)];
        Self { corner: (across + down - 1.0) / (across * down), ..sharp }
    }

    /// Returns the ramp along an axis, 0 in the middle and 1 on the side, and its slope.
    fn ramp(&self, at: DVec2, axis: usize) -> (f64, f64) {
        let (half, level, round) = (self.half[axis], self.level[axis], self.round[axis]);
        let part = at[axis].abs() / half;
        let rim = (at[axis].abs() - level).max(0.0) / (half - level);
        let value = round * part * part + (1.0 - round) * rim * rim * rim;
        let slope = 2.0 * round * part / half + 3.0 * (1.0 - round) * rim * rim / (half - level);
        (value, slope.copysign(at[axis]))
    }

    /// Returns the field at a place of the rectangle around the outline.
    pub fn field(&self, at: DVec2) -> PaneField {
        let [(across, by_x), (down, by_y)] = [self.ramp(at, 0), self.ramp(at, 1)];
        let slope = DVec2::new(by_x * (1.0 - self.corner * down), by_y * (1.0 - self.corner * across));
        PaneField { value: across + down - self.corner * across * down, slope }
    }

    /// Returns the distance of a place from the outline, negative inside; it is right to first order at the outline.
    pub fn distance(&self, at: DVec2) -> f64 {
        let PaneField { value, slope } = self.field(at);
        let beside = (at.abs() - self.half).max_element();
        ((value - 1.0) / slope.length().max(FLAT)).max(beside)
    }

    /// Returns the dome's point at a place; beyond the outline it is as on the outline.
    pub fn dome(&self, at: DVec2) -> DomePoint {
        let PaneField { value, slope } = self.field(at.clamp(-self.half, self.half));
        let value = value.clamp(0.0, 1.0);
        let level = slope * (0.5 * self.half.min_element());
        DomePoint {
            distance: value.sqrt(),
            radial: at.try_normalize().unwrap_or(DVec2::ZERO),
            normal: level.extend((1.0 - value).sqrt()).try_normalize().unwrap_or(DVec3::Z),
        }
    }
}
