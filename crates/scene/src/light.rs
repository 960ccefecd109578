//! Light from all directions as data: domes, soft boxes, lamps, a panorama, a world.
//!
//! Directions are given by azimuth and elevation. All angles are degrees. Elevations are counted from the plane square to
//! the light's axis; 90 lies along the axis. Radiance 1 is that of a white sheet in full light. A part with a colour of its
//! own sheds light in the smooth spectra of red, green and blue; one without sheds the light's spectrum.

use super::worlds::World;
use brillianteer_optics::Illuminant;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The range of the half angle of an observer's head, degrees: a head of 90 would hide all light.
pub const HEADS_DEG: [f64; 2] = [0.0, 89.0];

/// Light from all around, as the sum of its parts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Light {
    /// The light's name.
    pub name: String,
    /// The purpose of the light, in one line.
    #[serde(default)]
    pub description: String,
    /// The spectrum of parts without a colour.
    #[serde(default = "daylight")]
    pub spectrum: Illuminant,
    /// The half angle of the observer's head around the axis to the eye, degrees. No light comes from within it; 0 for no
    /// head.
    #[serde(default)]
    pub head: f64,
    /// A world that the program draws. The middle of its photograph lies opposite the axis, behind the stones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub world: Option<World>,
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

/// A belt of the sky between two elevations. With an `end`, the radiance changes from `radiance` to `end` in
/// proportion to the sine of the elevation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dome {
    /// The elevation at which the belt begins, degrees.
    #[serde(default = "nadir")]
    pub from: f64,
    /// The elevation at which the belt ends, degrees.
    #[serde(default = "zenith")]
    pub to: f64,
    /// The width of its soft edges, degrees.
    #[serde(default)]
    pub soft: f64,
    /// The radiance; where there is an `end`, that at `from`.
    pub radiance: f64,
    /// The radiance at `to`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<f64>,
    /// The colour of the part's light, sRGB; `None` for the light's spectrum.
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
    /// The azimuth of its middle, degrees.
    pub azimuth: f64,
    /// The elevation of its middle, degrees.
    pub elevation: f64,
    /// The width along the horizon, degrees.
    pub width: f64,
    /// The height upward, degrees.
    pub height: f64,
    /// The angle by which it is turned about its middle, degrees.
    #[serde(default)]
    pub turn: f64,
    /// The width of its soft edges, degrees.
    #[serde(default = "soft_edge")]
    pub soft: f64,
    /// The radiance, 0 to 1e6; 1 is a white sheet in full light.
    pub radiance: f64,
    /// The colour of the part's light, sRGB; `None` for the light's spectrum.
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
    /// The azimuth of its middle, degrees.
    pub azimuth: f64,
    /// The elevation of its middle, degrees.
    pub elevation: f64,
    /// The angle from its middle to its edge, degrees.
    pub radius: f64,
    /// The radiance, 0 to 1e6; 1 is a white sheet in full light.
    pub radiance: f64,
    /// The colour of the part's light, sRGB; `None` for the light's spectrum.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<[u8; 3]>,
}

/// Equal lamps, evenly spread between two elevations.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LampField {
    /// The number of lamps.
    pub count: u32,
    /// The elevation where the lamps begin, degrees.
    pub from: f64,
    /// The elevation where the lamps end, degrees.
    pub to: f64,
    /// The angle from the middle of each lamp to its edge, degrees.
    pub radius: f64,
    /// The radiance, 0 to 1e6; 1 is a white sheet in full light.
    pub radiance: f64,
    /// The colour of the lamps, sRGB; `None` for the light's spectrum.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<[u8; 3]>,
}

/// An HDR picture of the surroundings, with its exposure and its turn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PanoramaRef {
    /// The picture's file, .hdr or .exr.
    pub file: PathBuf,
    /// The exposure in stops: the picture is made brighter by 2 to this power.
    #[serde(default)]
    pub exposure: f64,
    /// The angle by which the picture is turned about the axis, counter-clockwise, degrees.
    #[serde(default)]
    pub turn: f64,
}

/// The fault in a light.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LightError {
    /// A number that is out of its key's range.
    #[error("{part} {number}: {key} is {value}; {wanted}")]
    Value {
        /// The kind of the part.
        part: &'static str,
        /// The number of the part among those of its kind, from 1.
        number: usize,
        /// The key at fault.
        key: &'static str,
        /// The value as given.
        value: f64,
        /// The expected range.
        wanted: &'static str,
    },
    /// More lamps than [`MOST_LAMPS`].
    #[error("{count} lamps in all; a light can have {most} at most")]
    TooManyLamps {
        /// The number of lamps in all.
        count: u64,
        /// The most lamps that a light can have.
        most: usize,
    },
    /// A light without any part that shines.
    #[error("nothing shines: give a dome, a box, a lamp, a field of lamps, a panorama or a world")]
    Dark,
}

/// The most lamps that a light may have, those of its fields included.
pub const MOST_LAMPS: usize = 256;

/// Returns the unit vector to an azimuth and elevation, degrees.
pub fn toward(azimuth: f64, elevation: f64) -> DVec3 {
    let ((sin_a, cos_a), (sin_e, cos_e)) = (azimuth.to_radians().sin_cos(), elevation.to_radians().sin_cos());
    DVec3::new(cos_e * cos_a, cos_e * sin_a, sin_e)
}

impl Light {
    /// Returns all lamps, those of the fields included.
    pub fn lamps(&self) -> Vec<Lamp> {
        self.lamp.iter().cloned().chain(self.field.iter().flat_map(LampField::lamps)).collect()
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The error names the first number that is wrong, or says that there are too many lamps or that no part shines.
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
        let [least, most] = HEADS_DEG;
        check("light", 0, &[("head", self.head, least, most, "give 0 to 89 degrees")])?;
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
        let is_broad = !self.dome.is_empty() || !self.boxes.is_empty();
        let shines = count > 0 || is_broad || self.panorama.is_some() || self.world.is_some();
        if shines { Ok(()) } else { Err(LightError::Dark) }
    }
}

impl LampField {
    /// Returns the field's lamps, on a spiral of equal areas by the golden angle.
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
