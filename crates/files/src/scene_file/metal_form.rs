//! The keys of a table `[[metal]]` of a scene file.

use super::super::cut_file::values::{Numbers, TomlTable};
use super::super::toml_text::line_at;
use super::MetalEntry;
use super::shared::{metal, place_mm, roughness, within};
use brillianteer_base::Fault;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;
use toml::Spanned;

/// The most bodies of metal that a scene may have.
const MOST_METALS: usize = 256;

/// The range of a metal's scale, mm for a unit of its file.
const SCALES: RangeInclusive<f64> = 1e-6..=1e6;

/// A table `[[metal]]` of a scene file, as serde reads and writes it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MetalForm {
    mesh: String,
    metal: String,
    roughness: Option<f64>,
    scale: Option<f64>,
    #[serde(default)]
    turn: f64,
    #[serde(default)]
    tilt: f64,
    #[serde(default)]
    azimuth: f64,
    at: Option<Numbers<3>>,
}

impl MetalForm {
    /// Returns the form in which a body of metal is written.
    pub fn of(entry: &MetalEntry) -> Self {
        Self {
            mesh: entry.mesh.clone(),
            metal: entry.metal.name().to_owned(),
            roughness: Some(entry.roughness),
            scale: Some(entry.scale),
            turn: entry.turn,
            tilt: entry.tilt,
            azimuth: entry.azimuth,
            at: Some(Numbers(entry.at_mm.to_array())),
        }
    }

    fn entry(self, line: usize) -> Result<MetalEntry, Fault> {
        let (metal, roughness) = (metal(&self.metal)?, roughness(self.roughness)?);
        let scale = self.scale.unwrap_or(1.0);
        within("scale", "scale", scale, SCALES, "mm for a unit of the file")?;
        let at_mm = place_mm([self.turn, self.tilt, self.azimuth], self.at)?;
        let Self { mesh, turn, tilt, azimuth, .. } = self;
        Ok(MetalEntry { mesh, metal, roughness, scale, turn, tilt, azimuth, at_mm, line })
    }
}

/// Returns the bodies of metal that the tables of a text describe.
pub(super) fn metals(
    forms: Vec<Spanned<TomlTable<MetalForm>>>,
    text: &str,
) -> Result<Vec<MetalEntry>, Fault> {
    if forms.len() > MOST_METALS {
        let message = format!("metal: {} are given, and {MOST_METALS} at most are read", forms.len());
        return Err(Fault::key(format!("metal/{MOST_METALS}"), message));
    }
    let entry = |(index, form): (usize, Spanned<TomlTable<MetalForm>>)| {
        let line = line_at(text, form.span().start);
        let TomlTable(form) = form.into_inner();
        form.entry(line)
            .map_err(|fault| fault.within(&format!("metal/{index}/"), &format!("metal {}: ", index + 1)))
    };
    forms.into_iter().enumerate().map(entry).collect()
}
