//! The keys of the table `[ring]` of a scene file.

use super::super::cut_file::material_form::MaterialForm;
use super::super::cut_file::values::{Numbers, TomlTable};
use super::super::file_error::Fault;
use super::super::toml_text::line_at;
use super::form::{DEGREES, LEANING, PLACES_MM, SizeForm, material, within};
use super::metal_form::{metal, roughness};
use super::{RingEntry, likely, shown};
use crate::scene::{OuterShape, Ring, RingStyle};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use toml::Spanned;

/// The table `[ring]`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RingForm {
    style: String,
    metal: String,
    roughness: Option<f64>,
    stone: Option<String>,
    material: Option<MaterialForm>,
    size: Option<SizeForm>,
    small_stone: Option<String>,
    small_material: Option<MaterialForm>,
    outside: Option<String>,
    inner_diameter_mm: Option<f64>,
    width_mm: Option<f64>,
    thickness_mm: Option<f64>,
    comfort_mm: Option<f64>,
    taper: Option<f64>,
    prong_diameter_mm: Option<f64>,
    notch: Option<f64>,
    grip_mm: Option<f64>,
    culet_gap_mm: Option<f64>,
    rail_diameter_mm: Option<f64>,
    small_diameter_mm: Option<f64>,
    small_gap_mm: Option<f64>,
    #[serde(default)]
    turn: f64,
    #[serde(default)]
    tilt: f64,
    #[serde(default)]
    azimuth: f64,
    at: Option<Numbers<3>>,
}

impl RingForm {
    /// Returns the form in which a ring is written.
    pub fn of(entry: &RingEntry) -> Self {
        let ring = &entry.ring;
        let material = |given: &Option<_>| given.as_ref().map(MaterialForm::of);
        Self {
            style: ring.style.name().to_owned(),
            metal: entry.metal.name().to_owned(),
            roughness: Some(entry.roughness),
            stone: entry.stone.clone(),
            material: material(&entry.material),
            size: entry.size.map(SizeForm),
            small_stone: entry.small_stone.clone(),
            small_material: material(&entry.small_material),
            outside: Some(ring.outside.name().to_owned()),
            inner_diameter_mm: Some(ring.inner_diameter_mm),
            width_mm: Some(ring.width_mm),
            thickness_mm: Some(ring.thickness_mm),
            comfort_mm: Some(ring.comfort_mm),
            taper: Some(ring.taper),
            prong_diameter_mm: Some(ring.prong_diameter_mm),
            notch: Some(ring.notch),
            grip_mm: Some(ring.grip_mm),
            culet_gap_mm: Some(ring.culet_gap_mm),
            rail_diameter_mm: Some(ring.rail_diameter_mm),
            small_diameter_mm: Some(ring.small_diameter_mm),
            small_gap_mm: Some(ring.small_gap_mm),
            turn: entry.turn,
            tilt: entry.tilt,
            azimuth: entry.azimuth,
            at: Some(Numbers(entry.at_mm.to_array())),
        }
    }

    /// Returns the ring's numbers; those that are not given are the usual ones.
    fn ring(&self) -> Result<Ring, Fault> {
        let outside = self.outside.as_deref().map(|name| named("outside", name, &OuterShape::NAMES));
        let usual = Ring::default();
        Ok(Ring {
            style: named("style", &self.style, &RingStyle::NAMES)?,
            outside: outside.transpose()?.unwrap_or(usual.outside),
            inner_diameter_mm: self.inner_diameter_mm.unwrap_or(usual.inner_diameter_mm),
            width_mm: self.width_mm.unwrap_or(usual.width_mm),
            thickness_mm: self.thickness_mm.unwrap_or(usual.thickness_mm),
            comfort_mm: self.comfort_mm.unwrap_or(usual.comfort_mm),
            taper: self.taper.unwrap_or(usual.taper),
            prong_diameter_mm: self.prong_diameter_mm.unwrap_or(usual.prong_diameter_mm),
            notch: self.notch.unwrap_or(usual.notch),
            grip_mm: self.grip_mm.unwrap_or(usual.grip_mm),
            culet_gap_mm: self.culet_gap_mm.unwrap_or(usual.culet_gap_mm),
            rail_diameter_mm: self.rail_diameter_mm.unwrap_or(usual.rail_diameter_mm),
            small_diameter_mm: self.small_diameter_mm.unwrap_or(usual.small_diameter_mm),
            small_gap_mm: self.small_gap_mm.unwrap_or(usual.small_gap_mm),
        })
    }

    fn entry(self, line: usize) -> Result<RingEntry, Fault> {
        let ring = self.ring()?;
        ring.check(self.stone.is_some(), self.small_stone.is_some())
            .map_err(|error| Fault::key(error.key(), error))?;
        let idle = [
            ("material", self.material.is_some() && self.stone.is_none()),
            ("size", self.size.is_some() && self.stone.is_none()),
            ("small_material", self.small_material.is_some() && self.small_stone.is_none()),
        ];
        if let Some((key, _)) = idle.into_iter().find(|(_, is_idle)| *is_idle) {
            return Err(Fault::key(key, format!("{key}: there is no stone for it; leave it out")));
        }
        within("turn", "turn", self.turn, DEGREES, "degrees")?;
        within("tilt", "tilt", self.tilt, LEANING, "degrees")?;
        within("azimuth", "azimuth", self.azimuth, DEGREES, "degrees")?;
        let at_mm = self.at.map_or(DVec3::ZERO, |Numbers(at)| at.into());
        for (axis, value) in at_mm.to_array().into_iter().enumerate() {
            within(&format!("at/{axis}"), "at", value, PLACES_MM, "mm")?;
        }
        let small = |fault: Fault| Fault { key: Some("small_material".to_owned()), ..fault };
        Ok(RingEntry {
            ring,
            metal: metal(&self.metal)?,
            roughness: roughness(self.roughness)?,
            stone: self.stone,
            material: self.material.map(material).transpose()?,
            size: self.size.map(|SizeForm(size)| size),
            small_stone: self.small_stone,
            small_material: self.small_material.map(material).transpose().map_err(small)?,
            turn: self.turn,
            tilt: self.tilt,
            azimuth: self.azimuth,
            at_mm,
            line,
        })
    }
}

/// Returns the ring that the table of a text describes.
pub(super) fn ring(form: Spanned<TomlTable<RingForm>>, text: &str) -> Result<RingEntry, Fault> {
    let line = line_at(text, form.span().start);
    let TomlTable(form) = form.into_inner();
    form.entry(line).map_err(|fault| fault.within("ring/", "ring: "))
}

/// Returns what a name stands for.
fn named<T: Copy>(key: &str, given: &str, known: &[(&'static str, T)]) -> Result<T, Fault> {
    let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
    let unknown = || format!("{key}: '{}' is unknown{}", shown(given), likely(given, &names));
    let found = known.iter().find(|(name, _)| *name == given).map(|(_, meant)| *meant);
    found.ok_or_else(|| Fault::key(key, unknown()))
}
