//! The radiance of the parts of a light by direction, in the light's own frame.

use brillianteer_optics::linear_from_encoded;
use brillianteer_scene::{Dome, Light, Panorama, PanoramaRef, SoftBox, toward};
use glam::{DQuat, DVec3, DVec4, Vec4Swizzles as _};

/// Returns a radiance of 1 by channel, of the key illuminant or of a colour in encoded sRGB.
pub fn channels(colour: Option<[u8; 3]>) -> DVec4 {
    colour.map_or(DVec4::X, |rgb| {
        DVec3::from_array(rgb.map(|c| linear_from_encoded(f64::from(c) / 255.0))).extend(0.0).wxyz()
    })
}

/// The broad light of a light, which is all of it except the lamps, prepared for many directions.
pub struct BroadLight<'a> {
    belts: Vec<Belt>,
    boxes: Vec<BoxFrame>,
    /// The picture, the turn from the light's frame into its own, and the factor of its radiance.
    picture: Option<(&'a Panorama, DQuat, f64)>,
}

/// A dome, prepared for many directions.
struct Belt {
    channels: DVec4,
    /// The radiances at the lower and at the upper end.
    radiance: [f64; 2],
    /// The sines of the elevations of both ends.
    sines: [f64; 2],
    /// The edges; `None` at a pole, where a belt has no edge.
    edges: [Option<BeltEdge>; 2],
}

/// An edge of a belt, in degrees.
struct BeltEdge {
    elevation: f64,
    soft: f64,
    /// The sines of elevation between which the edge lies, with a margin for rounding.
    sines: [f64; 2],
}

/// A soft box, prepared for many directions.
struct BoxFrame {
    radiance: DVec4,
    middle: DVec3,
    /// The axes along its width and its height.
    axes: [DVec3; 2],
    edges: [BoxEdge; 2],
}

/// The two edges of a soft box across one of its axes, in degrees.
struct BoxEdge {
    half: f64,
    soft: f64,
    /// The tangents of the angles between which the edge lies, with a margin for rounding.
    tangents: [f64; 2],
}

/// The width of the margin for rounding around edges, as a sine or a tangent.
const MARGIN: f64 = 1e-9;

impl<'a> BroadLight<'a> {
    /// Prepares a light. `panorama` is the picture that the light names.
    pub fn new(light: &Light, panorama: Option<&'a Panorama>) -> Self {
        let picture = |(how, picture): (&PanoramaRef, &'a Panorama)| {
            (picture, DQuat::from_rotation_z(-how.turn.to_radians()), how.exposure.exp2())
        };
        Self {
            belts: light.dome.iter().map(Belt::new).collect(),
            boxes: light.boxes.iter().map(BoxFrame::new).collect(),
            picture: light.panorama.as_ref().zip(panorama).map(picture),
        }
    }

    /// Returns the radiance, by channel, from a unit direction of the light's own frame.
    pub fn radiance(&self, d: DVec3) -> DVec4 {
        let belts = self.belts.iter().map(|belt| belt.channels * belt.radiance(d));
        let boxes = self.boxes.iter().map(|frame| frame.radiance * frame.cover(d));
        let picture = self
            .picture
            .iter()
            .map(|(picture, turn, factor)| (picture.toward(*turn * d) * *factor).extend(0.0).wxyz());
        belts.chain(boxes).chain(picture).sum()
    }
}

/// Rises smoothly from 0 to 1 over this width while `x` rises through 0.
fn step(x: f64, width: f64) -> f64 {
    if width <= 0.0 {
        return if x >= 0.0 { 1.0 } else { 0.0 };
    }
    let t = (x / width + 0.5).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl Belt {
    fn new(dome: &Dome) -> Self {
        let edge = |elevation: f64| {
            let sine = |degrees: f64| degrees.clamp(-90.0, 90.0).to_radians().sin();
            let half = 0.5 * dome.soft.max(0.0);
            let sines = [sine(elevation - half) - MARGIN, sine(elevation + half) + MARGIN];
            BeltEdge { elevation, soft: dome.soft, sines }
        };
        Self {
            channels: channels(dome.colour),
            radiance: [dome.radiance, dome.end.unwrap_or(dome.radiance)],
            sines: [dome.from, dome.to].map(|elevation| elevation.to_radians().sin()),
            edges: [(dome.from > -90.0).then(|| edge(dome.from)), (dome.to < 90.0).then(|| edge(dome.to))],
        }
    }

    /// Returns the radiance from a direction, without the colour.
    fn radiance(&self, d: DVec3) -> f64 {
        let [above, below] = &self.edges;
        let above = above.as_ref().map_or(1.0, |edge| edge.share(d.z, 1.0));
        let below = below.as_ref().map_or(1.0, |edge| edge.share(d.z, -1.0));
        let ([low, high], [start, end]) = (self.sines, self.radiance);
        let part = if high > low { ((d.z - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
        (start + (end - start) * part) * above * below
    }
}

impl BeltEdge {
    /// Returns the share of a direction, given by its sine of elevation, that lies on one side of the edge: above it
    /// where `side` is 1, below it where `side` is -1.
    fn share(&self, sine: f64, side: f64) -> f64 {
        if sine < self.sines[0] || sine > self.sines[1] {
            return if (sine > self.sines[1]) == (side > 0.0) { 1.0 } else { 0.0 };
        }
        let elevation = sine.clamp(-1.0, 1.0).asin().to_degrees();
        step(side * (elevation - self.elevation), self.soft)
    }
}

impl BoxFrame {
    fn new(soft_box: &SoftBox) -> Self {
        let middle = toward(soft_box.azimuth, soft_box.elevation);
        let (sin, cos) = soft_box.azimuth.to_radians().sin_cos();
        let across = DVec3::new(-sin, cos, 0.0);
        let up = middle.cross(across);
        let (sin, cos) = soft_box.turn.to_radians().sin_cos();
        Self {
            radiance: channels(soft_box.colour) * soft_box.radiance,
            middle,
            axes: [across * cos + up * sin, up * cos - across * sin],
            edges: [soft_box.width, soft_box.height].map(|width| BoxEdge::new(width, soft_box.soft)),
        }
    }

    /// Returns the cover of a direction: 1 inside, 0 outside, between these along the soft edge.
    fn cover(&self, d: DVec3) -> f64 {
        let ahead = d.dot(self.middle);
        if ahead <= 0.0 {
            return 0.0;
        }
        let inside = |k: usize| self.edges[k].inside(d.dot(self.axes[k]), ahead);
        let cover = inside(0);
        if cover > 0.0 { cover * inside(1) } else { 0.0 }
    }
}

impl BoxEdge {
    fn new(width: f64, soft: f64) -> Self {
        let half = width / 2.0;
        // Beyond a right angle nothing lies ahead.
        let tangent = |degrees: f64| if degrees < 90.0 { degrees.to_radians().tan() } else { f64::INFINITY };
        let around = 0.5 * soft.max(0.0);
        let [from, to] = [tangent(half - around), tangent(half + around)];
        Self { half, soft, tangents: [from - MARGIN * (1.0 + from * from), to + MARGIN * (1.0 + to * to)] }
    }

    /// Returns the share of a direction that lies between the edges, given by its parts along the axis and ahead.
    fn inside(&self, along: f64, ahead: f64) -> f64 {
        if along.abs() > self.tangents[1] * ahead {
            return 0.0;
        }
        if along.abs() < self.tangents[0] * ahead {
            return 1.0;
        }
        step(self.half - along.atan2(ahead).to_degrees().abs(), self.soft)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Returns the cover of a direction by a soft box, from the angles to its middle in both axes.
    fn cover_by_angles(b: &SoftBox, d: DVec3) -> f64 {
        let frame = BoxFrame::new(b);
        let ahead = d.dot(frame.middle);
        let share = |k: usize, width: f64| {
            step(width / 2.0 - d.dot(frame.axes[k]).atan2(ahead).to_degrees().abs(), b.soft)
        };
        if ahead <= 0.0 { 0.0 } else { share(0, b.width) * share(1, b.height) }
    }

    /// Returns the share of a direction within a belt, from its elevation.
    fn share_by_elevation(dome: &Dome, d: DVec3) -> f64 {
        let elevation = d.z.asin().to_degrees();
        let above = if dome.from <= -90.0 { 1.0 } else { step(elevation - dome.from, dome.soft) };
        let below = if dome.to >= 90.0 { 1.0 } else { step(dome.to - elevation, dome.soft) };
        above * below
    }

    proptest! {
        #[test]
        fn shares_that_are_known_without_angles_are_those_by_angles(
            width in 1.0..180.0_f64, height in 1.0..180.0_f64, turn in 0.0..360.0_f64, elevation in -90.0..90.0_f64,
            soft in prop_oneof![Just(0.0), 0.0..60.0_f64], from in -90.0..80.0_f64, span in 1.0..100.0_f64,
        ) {
            let soft_box = SoftBox {
                azimuth: turn / 2.0, elevation, width, height, turn, soft, radiance: 1.0, colour: None,
            };
            let dome = Dome { from, to: (from + span).min(90.0), soft, radiance: 2.0, end: None, colour: None };
            let (frame, belt) = (BoxFrame::new(&soft_box), Belt::new(&dome));
            for k in 0..500 {
                // The directions are spread over the whole sphere, on a spiral.
                let z = (f64::from(k) + 0.5) / 250.0 - 1.0;
                let (sin, cos) = (2.399_963 * f64::from(k)).sin_cos();
                let d = DVec3::new(cos * (1.0 - z * z).sqrt(), sin * (1.0 - z * z).sqrt(), z);
                prop_assert!((frame.cover(d) - cover_by_angles(&soft_box, d)).abs() < 1e-12);
                prop_assert!((belt.radiance(d) - 2.0 * share_by_elevation(&dome, d)).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_box_of_another_width_covers_other_directions() {
        let soft_box = |width: f64| SoftBox {
            azimuth: 0.0,
            elevation: 0.0,
            width,
            height: 20.0,
            turn: 0.0,
            soft: 2.0,
            radiance: 1.0,
            colour: None,
        };
        let beside = toward(9.5, 0.0);
        let cover = |width: f64| BoxFrame::new(&soft_box(width)).cover(beside);
        assert_eq!((cover(16.0), cover(30.0)), (0.0, 1.0));
        assert!(cover(19.0) > 0.1 && cover(19.0) < 0.9, "{}", cover(19.0));
    }
}
