//! The photograph behind the bodies, on a plane perpendicular to the axis to the eye. The twins of this module are
//! `crates/trace/src/packet/backplate.rs` and `photo_at` in `shaders/environment.wgsl`.

use crate::DispersedRay;
use brillianteer_math::Basis;
use brillianteer_scene::{Film, Mipmap, View};
use glam::{DVec2, DVec3, DVec4, Vec4Swizzles as _};

/// A ray counts as parallel to the backplate if the cosine between it and the axis to the eye is below this.
pub(crate) const ALONG: f64 = 1e-6;

/// A photograph on a plane behind the stones, perpendicular to the axis to the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Backplate<'a> {
    /// The picture, in linear light, with its coarser levels.
    pub picture: &'a Mipmap,
    /// The distance of the plane behind the origin, in world units.
    pub distance: f64,
    /// The width of the picture on that plane, in world units.
    pub width: f64,
}

/// Returns the image coordinates of the point where a ray meets the plane at this distance behind the origin,
/// perpendicular to the axis to the eye; `None` where the ray does not meet the plane.
pub fn backplate_point(eye: &Basis, distance: f64, from: DVec3, direction: DVec3) -> Option<DVec2> {
    let (speed, height) = (-direction.dot(eye.toward), from.dot(eye.toward) + distance);
    let meets = speed > ALONG && height > 0.0;
    meets.then(|| eye.project(from + direction * (height / speed)))
}

impl<'a> Backplate<'a> {
    /// Places a picture at this distance behind the origin. It is wide enough to cover `span` times a view's film,
    /// whatever its shape.
    pub fn filling(picture: &'a Mipmap, span: f64, distance: f64, view: &View, film: &Film) -> Self {
        let [across, down] = film.size.map(f64::from);
        let shape = f64::from(picture.picture().width) / f64::from(picture.picture().height);
        let width = span * film.pixel * across.max(down * shape) * view.widening(distance);
        Self { picture, distance, width }
    }

    /// Returns the light of the picture along a ray, averaged over the ray's fan and shift; `None` where the ray does
    /// not meet the picture.
    pub(super) fn at(&self, eye: &Basis, ray: &DispersedRay) -> Option<Photographed> {
        let DispersedRay { origin: from, direction, .. } = *ray;
        let height = from.dot(eye.toward) + self.distance;
        let fan = fan_onto_plane(ray, eye.toward, height);
        let (speed, faster) = (-direction.dot(eye.toward), -fan.dot(eye.toward));
        let speed = |part: f64| speed + faster * part;
        // The fan reaches from half its length before the ray's direction to half after it; this is its part that
        // runs toward the plane.
        let (low, high) = (speed(-0.5), speed(0.5));
        if height <= 0.0 || low.max(high) <= ALONG {
            return None;
        }
        let meets = |of: f64, other: f64| if of > ALONG { 0.0 } else { (ALONG - of) / (other - of) };
        let (first, last) = (meets(low, high) - 0.5, 0.5 - meets(high, low));
        let picture = self.picture.picture();
        let size = DVec2::new(f64::from(picture.width), f64::from(picture.height));
        // The unit is a pixel, counted from the middle of the first one. Rows count down, and both axes have the same
        // scale.
        let pixels = |v: DVec3| eye.project(v) * DVec2::new(1.0, -1.0) * (size.x / self.width);
        let (start, way, turn) = (pixels(from) + 0.5 * size - 0.5, pixels(direction), pixels(fan));
        let place = |part: f64| start + (way + turn * part) * (height / speed(part).max(ALONG));
        let (from, to) = (place(first), if fan == DVec3::ZERO { place(first) } else { place(last) });
        let (enters, leaves) = inside(from, to, size)?;
        // The line is seen in perspective, so parts of its length are converted to parts of the fan.
        let of_fan = |q: f64| {
            let (near, far) = (q * speed(first), (1.0 - q) * speed(last));
            first + (last - first) * (near / (near + far))
        };
        let (first, last) = (of_fan(enters), of_fan(leaves));
        let length = (to - from).length() * (leaves - enters);
        let light = self.picture.along(length, |part| place(first + (last - first) * part));
        let share = if from == to { 1.0 } else { last - first };
        Some(Photographed { light: light.extend(0.0).wxyz() * share, share })
    }
}

/// Returns a fan by which a ray covers, to first order, the same stretch of a plane as by its fan and its shift
/// together. The plane is perpendicular to `toward`, and the ray's origin is at `height` before it.
fn fan_onto_plane(ray: &DispersedRay, toward: DVec3, height: f64) -> DVec3 {
    // The shift is moved along the ray until it is parallel to the plane.
    let along = ray.shift * -ray.direction.dot(toward) + ray.direction * ray.shift.dot(toward);
    if along == DVec3::ZERO { ray.fan } else { ray.fan + along / height }
}

/// The light of the picture along a ray, and the share of the ray that meets it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Photographed {
    /// The light by channel of the part of the ray's wavelengths that meets the picture, times the share.
    pub light: DVec4,
    /// The share of the ray's wavelengths that meets the picture, 0 to 1.
    pub share: f64,
}

/// Returns the parts, 0 to 1, of a line at which it enters a picture and leaves it; `None` where the line does not
/// meet the picture. Places are in pixels from the middle of the first pixel.
fn inside(from: DVec2, to: DVec2, size: DVec2) -> Option<(f64, f64)> {
    if !from.is_finite() || !to.is_finite() {
        return None;
    }
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (start, way, end) = (from[axis], to[axis] - from[axis], size[axis] - 0.5);
        if way == 0.0 {
            if !(-0.5..=end).contains(&start) {
                return None;
            }
            continue;
        }
        let (a, b) = ((-0.5 - start) / way, (end - start) / way);
        (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
    }
    (enters <= leaves).then_some((enters, leaves))
}
