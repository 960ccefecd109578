//! Parts that are turned on a lathe, or bent to a circle.

use super::skin::{chords, skin};
use brillianteer_math::ShadedSurface;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Turns a closed line of (distance from the z axis, height), counter-clockwise with the axis on the left, about the axis.
pub(super) fn turned(line: &[DVec2]) -> ShadedSurface {
    let widest = line.iter().map(|at| at.x).fold(0.0, f64::max);
    let steps = chords(widest, TAU);
    let row = |k: usize| {
        let way = DVec2::from_angle(TAU * k as f64 / steps as f64);
        line.iter().rev().map(|at| (way * at.x).extend(at.y)).collect()
    };
    skin(&(0..steps).map(row).collect::<Vec<Vec<DVec3>>>(), true)
}

/// Returns the circle of a rail's wire, as a line to be turned.
pub(super) fn wire(middle: DVec2, radius: f64) -> Vec<DVec2> {
    let steps = chords(radius, TAU);
    (0..steps).map(|k| middle + DVec2::from_angle(TAU * k as f64 / steps as f64) * radius).collect()
}
