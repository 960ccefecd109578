//! Light from all around, as data: domes, soft boxes, lamps, a panorama.
//!
//! Directions are by azimuth and elevation in degrees, elevations counted from the plane square to the light's axis, 90
//! along it. Radiance 1 is that of a white sheet in full light. A part with a colour of its own sheds it in the smooth
//! spectra of red, green and blue; one without sheds the light's spectrum.

use crate::optics::Illuminant;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Light from all around.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Light {
    /// What it is called.
    pub name: String,
    /// One line on what it is good for.
    #[serde(default)]
    pub description: String,
    /// The spectrum of parts without a colour.
    #[serde(default = "daylight")]
    pub spectrum: Illuminant,
    /// Half angle, degrees, of the observer's head around the axis to the eye, which keeps light out; 0 for none.
    #[serde(default)]
    pub head: f64,
    /// Belts of the sky.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub dome: Vec<Dome>,
    /// Soft boxes, windows, panels.
    #[serde(default, skip_serializing_if = "Vec::is_empty", rename = "box")]
    pub boxes: Vec<SoftBox>,
    /// Lamps.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lamp: Vec<Lamp>,
    /// Many lamps, evenly spread.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub field: Vec<LampField>,
    /// A picture of the surroundings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub panorama: Option<PanoramaRef>,
}

fn daylight() -> Illuminant {
    Illuminant::D65
}

/// A belt of the sky between two elevations; where `end` is given, radiance goes over from `radiance` to it in the sine
/// of the elevation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dome {
    /// Elevation where it begins.
    #[serde(default = "nadir")]
    pub from: f64,
    /// Elevation where it ends.
    #[serde(default = "zenith")]
    pub to: f64,
    /// Width of its edges.
    #[serde(default)]
    pub soft: f64,
    /// Radiance, at `from` if there is an `end`.
    pub radiance: f64,
    /// Radiance at `to`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<f64>,
    /// Its own colour, sRGB.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<[u8; 3]>,
}

fn nadir() -> f64 {
    -90.0
}

fn zenith() -> f64 {
    90.0
}

/// A rectangle of light as seen from the stone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SoftBox {
    /// Azimuth of its middle.
    pub azimuth: f64,
    /// Elevation of its middle.
    pub elevation: f64,
    /// Along the horizon.
    pub width: f64,
    /// Upward.
    pub height: f64,
    /// By how much it is turned about its middle.
    #[serde(default)]
    pub turn: f64,
    /// Width of its edges.
    #[serde(default = "soft_edge")]
    pub soft: f64,
    /// Radiance.
    pub radiance: f64,
    /// Its own colour, sRGB.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<[u8; 3]>,
}

fn soft_edge() -> f64 {
    4.0
}

/// A disc of even light.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lamp {
    /// Azimuth of its middle.
    pub azimuth: f64,
    /// Elevation of its middle.
    pub elevation: f64,
    /// Angle from its middle to its edge.
    pub radius: f64,
    /// Radiance.
    pub radiance: f64,
    /// Its own colour, sRGB.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<[u8; 3]>,
}

/// Equal lamps, evenly spread between two elevations.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LampField {
    /// How many.
    pub count: u32,
    /// Elevation where they begin.
    pub from: f64,
    /// Elevation where they end.
    pub to: f64,
    /// Angle from the middle of each to its edge.
    pub radius: f64,
    /// Radiance.
    pub radiance: f64,
    /// Their own colour, sRGB.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<[u8; 3]>,
}

/// An HDR picture of the surroundings, and how it is used.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PanoramaRef {
    /// The file, .hdr or .exr.
    pub file: PathBuf,
    /// Brighter by so many stops.
    #[serde(default)]
    pub exposure: f64,
    /// Turned about the axis by so many degrees.
    #[serde(default)]
    pub turn: f64,
}

/// What is wrong with a light.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LightError {
    /// A number that makes no sense where it stands.
    #[error("{part} {number}: {key} is {value}; {wanted}")]
    Value {
        /// Which kind of part.
        part: &'static str,
        /// Which of them, from 1.
        number: usize,
        /// The key.
        key: &'static str,
        /// What was given.
        value: f64,
        /// What is wanted.
        wanted: &'static str,
    },
    /// More lamps than there is room for.
    #[error("{count} lamps in all; {most} at most are taken")]
    TooManyLamps {
        /// How many.
        count: u64,
        /// How many there is room for.
        most: usize,
    },
    /// Nothing shines.
    #[error("nothing shines: give a dome, a box, a lamp, a field of lamps or a panorama")]
    Dark,
}

/// Lamps that a light may have.
pub const MOST_LAMPS: usize = 256;

/// The unit vector to an azimuth and elevation, degrees.
pub fn toward(azimuth: f64, elevation: f64) -> DVec3 {
    let ((sin_a, cos_a), (sin_e, cos_e)) = (azimuth.to_radians().sin_cos(), elevation.to_radians().sin_cos());
    DVec3::new(cos_e * cos_a, cos_e * sin_a, sin_e)
}

impl Light {
    /// All single lamps, those of its fields included.
    pub fn lamps(&self) -> Vec<Lamp> {
        self.lamp.iter().cloned().chain(self.field.iter().flat_map(LampField::lamps)).collect()
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The first at fault.
    pub fn validate(&self) -> Result<(), LightError> {
        const ANGLE: &str = "give 0.5 to 180 degrees";
        const WIDTH: &str = "give 0 to 180 degrees";
        const RADIUS: &str = "give 0.001 to 90 degrees";
        const ELEVATION: &str = "give an elevation from -90 to 90 degrees";
        const RADIANCE: &str = "give 0 to 1e6; 1 is a white sheet in full light";
        const FINITE: &str = "give a number from -1e6 to 1e6";
        let check = |part, number, values: &[(&'static str, f64, f64, f64, &'static str)]| {
            let bad = values.iter().find(|(_, value, least, most, _)| !(least..=most).contains(&value));
            bad.map_or(Ok(()), |&(key, value, .., wanted)| {
                Err(LightError::Value { part, number: number + 1, key, value, wanted })
            })
        };
        let elevation = |key, value| (key, value, -90.0, 90.0, ELEVATION);
        let angle = |key, value| (key, value, 0.5, 180.0, ANGLE);
        let radiance = |key, value| (key, value, 0.0, 1e6, RADIANCE);
        let finite = |key, value| (key, value, -1e6, 1e6, FINITE);
        check("light", 0, &[("head", self.head, 0.0, 89.0, "give 0 to 89 degrees")])?;
        for (k, d) in self.dome.iter().enumerate() {
            let soft = ("soft", d.soft, 0.0, 180.0, WIDTH);
            let end = radiance("end", d.end.unwrap_or(0.0));
            let edges = [elevation("from", d.from), elevation("to", d.to)];
            check("dome", k, &[edges[0], edges[1], soft, radiance("radiance", d.radiance), end])?;
            check("dome", k, &[("to", d.to, d.from, 90.0, "it must not lie below `from`")])?;
        }
        for (k, b) in self.boxes.iter().enumerate() {
            let place =
                [finite("azimuth", b.azimuth), elevation("elevation", b.elevation), finite("turn", b.turn)];
            let size =
                [angle("width", b.width), angle("height", b.height), ("soft", b.soft, 0.0, 180.0, WIDTH)];
            check("box", k, &place).and(check("box", k, &size))?;
            check("box", k, &[radiance("radiance", b.radiance)])?;
        }
        for (k, l) in self.lamp.iter().enumerate() {
            let place = [finite("azimuth", l.azimuth), elevation("elevation", l.elevation)];
            check("lamp", k, &place)?;
            check("lamp", k, &[("radius", l.radius, 1e-3, 90.0, RADIUS), radiance("radiance", l.radiance)])?;
        }
        for (k, f) in self.field.iter().enumerate() {
            check("field", k, &[elevation("from", f.from), elevation("to", f.to)])?;
            check("field", k, &[("to", f.to, f.from, 90.0, "it must not lie below `from`")])?;
            check("field", k, &[("radius", f.radius, 1e-3, 90.0, RADIUS), radiance("radiance", f.radiance)])?;
        }
        if let Some(p) = &self.panorama {
            check("panorama", 0, &[("exposure", p.exposure, -40.0, 40.0, "give stops from -40 to 40")])?;
            check("panorama", 0, &[finite("turn", p.turn)])?;
        }
        let count = self.lamp.len() as u64 + self.field.iter().map(|f| u64::from(f.count)).sum::<u64>();
        if count > MOST_LAMPS as u64 {
            return Err(LightError::TooManyLamps { count, most: MOST_LAMPS });
        }
        let shines = count > 0 || !self.dome.is_empty() || !self.boxes.is_empty() || self.panorama.is_some();
        if shines { Ok(()) } else { Err(LightError::Dark) }
    }
}

impl LampField {
    /// Its lamps, on a spiral of equal areas by the golden angle.
    fn lamps(&self) -> impl Iterator<Item = Lamp> {
        let golden = 180.0 * (3.0 - 5.0_f64.sqrt());
        let (low, high) = (self.from.to_radians().sin(), self.to.to_radians().sin());
        (0..self.count).map(move |k| Lamp {
            azimuth: (f64::from(k) * golden).rem_euclid(360.0),
            elevation: (low + (high - low) * (f64::from(k) + 0.5) / f64::from(self.count))
                .asin()
                .to_degrees(),
            radius: self.radius,
            radiance: self.radiance,
            colour: self.colour,
        })
    }
}
