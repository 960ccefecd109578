//! The radiance of the parts of a light by direction, in the light's own frame.

use crate::optics::linear_from_encoded;
use crate::scene::{Dome, Light, Panorama, SoftBox, toward};
use glam::{DVec3, DVec4, Vec4Swizzles as _};

/// Returns a radiance of 1 by channel, of the key illuminant or of a colour in encoded sRGB.
pub fn channels(colour: Option<[u8; 3]>) -> DVec4 {
    colour.map_or(DVec4::X, |rgb| {
        DVec3::from_array(rgb.map(|c| linear_from_encoded(f64::from(c) / 255.0))).extend(0.0).wxyz()
    })
}

/// Returns the radiance of the broad light from a direction of the light's own frame. The broad light is all light
/// except the lamps.
pub fn shine(light: &Light, panorama: Option<&Panorama>, d: DVec3) -> DVec4 {
    let domes = light.dome.iter().map(|dome| channels(dome.colour) * belt(dome, d));
    let boxes = light.boxes.iter().map(|b| channels(b.colour) * b.radiance * box_cover(b, d));
    let picture = light.panorama.as_ref().zip(panorama).map(|(how, picture)| {
        let turn = glam::DQuat::from_rotation_z(-how.turn.to_radians());
        (picture.toward(turn * d) * how.exposure.exp2()).extend(0.0).wxyz()
    });
    domes.chain(boxes).chain(picture).sum()
}

/// Rises smoothly from 0 to 1 over this width while `x` rises through 0.
fn step(x: f64, width: f64) -> f64 {
    if width <= 0.0 {
        return if x >= 0.0 { 1.0 } else { 0.0 };
    }
    let t = (x / width + 0.5).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Returns the radiance that a dome gives from a direction.
fn belt(dome: &Dome, d: DVec3) -> f64 {
    let elevation = d.z.clamp(-1.0, 1.0).asin().to_degrees();
    // A belt that reaches a pole has no edge at that pole.
    let above = if dome.from <= -90.0 { 1.0 } else { step(elevation - dome.from, dome.soft) };
    let below = if dome.to >= 90.0 { 1.0 } else { step(dome.to - elevation, dome.soft) };
    let (low, high) = (dome.from.to_radians().sin(), dome.to.to_radians().sin());
    let part = if high > low { ((d.z - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
    let end = dome.end.unwrap_or(dome.radiance);
    (dome.radiance + (end - dome.radiance) * part) * above * below
}

/// Returns the coverage of a direction by a soft box: 1 inside, 0 outside, between these along its soft edge.
fn box_cover(b: &SoftBox, d: DVec3) -> f64 {
    let middle = toward(b.azimuth, b.elevation);
    let (sin, cos) = b.azimuth.to_radians().sin_cos();
    let across = DVec3::new(-sin, cos, 0.0);
    let up = middle.cross(across);
    let (sin, cos) = b.turn.to_radians().sin_cos();
    let (u, v) = (across * cos + up * sin, up * cos - across * sin);
    let ahead = d.dot(middle);
    let inside =
        |axis: DVec3, width: f64| step(width / 2.0 - d.dot(axis).atan2(ahead).to_degrees().abs(), b.soft);
    if ahead <= 0.0 { 0.0 } else { inside(u, b.width) * inside(v, b.height) }
}
