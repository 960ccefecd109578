//! Parts that the tables of a scene file share: sizes, ranges, names and rotations.

use super::super::cut_file::material_form::{MaterialForm, path_of};
use super::super::cut_file::values::{Numbers, OneOf, Pairs};
use brillianteer_base::{Fault, nearest};
use brillianteer_cut::{MaterialRef, Size, SizeError};
use brillianteer_optics::Metal;
use brillianteer_scene::POLISHED;
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

pub(super) const DEGREES: RangeInclusive<f64> = -1e6..=1e6;
const LEANING: RangeInclusive<f64> = -180.0..=180.0;
const PLACES_MM: RangeInclusive<f64> = -10_000.0..=10_000.0;
const ROUGHNESSES: RangeInclusive<f64> = 0.0..=1.0;

/// A size, written as text with its unit.
#[derive(Clone, Serialize, Deserialize)]
#[serde(try_from = "OneOf<Pairs>", into = "String")]
pub(super) struct SizeForm(pub Size);

impl TryFrom<OneOf<Pairs>> for SizeForm {
    type Error = Fault;

    fn try_from(form: OneOf<Pairs>) -> Result<Self, Fault> {
        let text = match form {
            OneOf::Text(text) => text,
            // The number goes on without a unit, which the size's own parser refuses.
            OneOf::Number(number) => number.to_string(),
            OneOf::Rest(_) => {
                return Err("a list is not a size; write a number and mm or ct in quotes".into());
            }
        };
        text.parse().map(Self).map_err(|error: SizeError| Fault::whole(error))
    }
}

impl From<SizeForm> for String {
    fn from(SizeForm(size): SizeForm) -> Self {
        size.to_string()
    }
}

/// Checks that the value of a key at a path lies in a range.
pub(super) fn within(
    path: &str,
    key: &str,
    value: f64,
    range: RangeInclusive<f64>,
    unit: &str,
) -> Result<(), Fault> {
    if range.contains(&value) {
        return Ok(());
    }
    let (least, most) = range.into_inner();
    Err(Fault::key(path, format!("{key}: {value} must be from {least} to {most} {unit}")))
}

/// Checks the turn, tilt and azimuth of a body, in degrees, and its place. Returns the place in mm, by default the
/// origin.
pub(super) fn place_mm([turn, tilt, azimuth]: [f64; 3], at: Option<Numbers<3>>) -> Result<DVec3, Fault> {
    within("turn", "turn", turn, DEGREES, "degrees")?;
    within("tilt", "tilt", tilt, LEANING, "degrees")?;
    within("azimuth", "azimuth", azimuth, DEGREES, "degrees")?;
    let at_mm = at.map_or(DVec3::ZERO, |Numbers(at)| at.into());
    for (axis, value) in at_mm.to_array().into_iter().enumerate() {
        within(&format!("at/{axis}"), "at", value, PLACES_MM, "mm")?;
    }
    Ok(at_mm)
}

/// Returns the material that a form describes, checked.
pub(super) fn material(form: MaterialForm) -> Result<MaterialRef, Fault> {
    let material = form.material()?;
    material.check().map_err(|error| Fault::key(path_of(&error, &material), error))?;
    Ok(material)
}

/// Returns the metal of a name.
pub(super) fn metal(given: &str) -> Result<Metal, Fault> {
    let found = Metal::NAMES.iter().find(|(name, _)| *name == given).map(|(_, metal)| *metal);
    let names = Metal::NAMES.map(|(name, _)| name);
    let unknown = || format!("metal: '{}' is unknown{}", shown(given), likely(given, &names));
    found.ok_or_else(|| Fault::key("metal", unknown()))
}

/// Returns the roughness of a metal, checked; by default that of a polished one.
pub(super) fn roughness(given: Option<f64>) -> Result<f64, Fault> {
    let roughness = given.unwrap_or(POLISHED);
    if ROUGHNESSES.contains(&roughness) {
        return Ok(roughness);
    }
    Err(Fault::key("roughness", format!("roughness: {roughness} must be from 0, a mirror, to 1")))
}

/// Returns the hint at the known name that is most like an unknown one, and the list of all known names.
pub(super) fn likely(asked: &str, known: &[&str]) -> String {
    let meant = nearest(asked, known).map_or(";".to_owned(), |name| format!("; did you mean '{name}'?"));
    format!("{meant} known: {}", known.join(", "))
}

/// Returns a text, cut to a readable length.
pub(super) fn shown(text: &str) -> String {
    text.chars().take(80).collect()
}

/// Returns the rotation that turns about z and then leans z toward an azimuth, all in degrees.
pub(super) fn leaning(turn: f64, tilt: f64, azimuth: f64) -> DQuat {
    let azimuth = azimuth.to_radians();
    let axis = DVec3::new(-azimuth.sin(), azimuth.cos(), 0.0);
    DQuat::from_axis_angle(axis, tilt.to_radians()) * DQuat::from_rotation_z(turn.to_radians())
}

/// A rotation in the form of scene files: first a turn about z, then a lean of z toward an azimuth, in degrees.
pub(super) struct Angles {
    pub turn: f64,
    pub tilt: f64,
    pub azimuth: f64,
}

impl Angles {
    /// Returns the angles of a rotation.
    pub fn of(turned: DQuat) -> Self {
        let axis = turned * DVec3::Z;
        let tilt = axis.truncate().length().atan2(axis.z).to_degrees();
        let azimuth = axis.y.atan2(axis.x).to_degrees();
        // The rest of the rotation is about the body's own axis.
        let about = leaning(0.0, tilt, azimuth).inverse() * turned;
        Self { turn: 2.0 * about.z.atan2(about.w).to_degrees(), tilt, azimuth }
    }
}
