//! The band: a cross-section that is carried around the finger and narrows toward the head.

use super::skin::{CHORD_MM, chords, skin};
use super::{OuterShape, Ring};
use brillianteer_math::ShadedSurface;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// The exponent of the superellipse that rounds the inside.
const INSIDE: f64 = 4.0;

/// The exponents of the superellipses that shape the outside.
const D_SHAPED: f64 = 2.0;
const FLAT: f64 = 9.0;

/// The least number of points of a cross-section.
const LEAST_POINTS: usize = 32;

/// Makes the band.
pub(super) fn band(ring: &Ring) -> ShadedSurface {
    let angles = section_angles(ring);
    let steps = chords(ring.outer(), TAU);
    let row = |k: usize| {
        let turn = TAU * k as f64 / steps as f64;
        let outward = DVec3::new(turn.sin(), 0.0, turn.cos());
        let place = |&angle: &f64| {
            let at = section(ring, narrowed(ring, turn), angle);
            outward * at.x + DVec3::Y * at.y
        };
        angles.iter().rev().map(place).collect()
    };
    skin(&(0..steps).map(row).collect::<Vec<_>>(), true)
}

/// Returns the width of the band at an angle from the head, as a part of its width.
pub(super) fn narrowed(ring: &Ring, turn: f64) -> f64 {
    ring.taper + (1.0 - ring.taper) * 0.5 * (1.0 - turn.cos())
}

/// Returns a point of the cross-section, as (distance from the finger's axis, place along it), for an angle that runs
/// counter-clockwise from outward. Outside and inside are halves of superellipses, which meet at right angles to the finger.
fn section(ring: &Ring, narrowed: f64, angle: f64) -> DVec2 {
    let (sin, cos) = angle.sin_cos();
    let outer = match ring.outside {
        OuterShape::D => D_SHAPED,
        OuterShape::Flat => FLAT,
    };
    let (power, height) =
        if cos >= 0.0 { (outer, ring.thickness_mm - ring.comfort_mm) } else { (INSIDE, ring.comfort_mm) };
    let radius = (sin.abs().powf(power) + cos.abs().powf(power)).powf(-1.0 / power);
    let middle = ring.hole() + ring.comfort_mm;
    DVec2::new(middle + height * radius * cos, 0.5 * ring.width_mm * narrowed * radius * sin)
}

/// Returns the angles at which the cross-section is divided, so that chords lie near enough to it where it is widest.
fn section_angles(ring: &Ring) -> Vec<f64> {
    let point = |angle| section(ring, 1.0, angle);
    let mut angles: Vec<f64> = (0..=LEAST_POINTS).map(|k| TAU * k as f64 / LEAST_POINTS as f64).collect();
    let mut k = 0;
    while k + 1 < angles.len() {
        let (a, b) = (angles[k], angles[k + 1]);
        let middle = 0.5 * (a + b);
        let off = (point(middle) - 0.5 * (point(a) + point(b))).length();
        if off > CHORD_MM && b - a > 1e-3 { angles.insert(k + 1, middle) } else { k += 1 }
    }
    angles.pop();
    angles
}
